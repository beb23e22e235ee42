#include "host/render/contacts.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

namespace meniscal {

nlohmann::ordered_json contacts_json(const World& world) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const LiquidReport& l : world.liquids)
    for (const meniscus::Contact& c : l.contacts)
      list.push_back({{"liquid", l.liquid},
                      {"solid", c.solid},
                      {"closed", c.closed},
                      {"length_m", c.length},
                      {"contact_angle_deg", glm::degrees(c.contact_angle)},
                      {"rise_min_m", c.rise_min},
                      {"rise_max_m", c.rise_max},
                      {"shape", c.at_rest ? "young-laplace" : "profile"},
                      {"triangles", c.triangles},
                      {"coarseness", c.need.coarseness},
                      {"photon_target", c.need.target},
                      {"warnings", c.warnings}});
  return list;
}

}  // namespace meniscal
