#include "host/export/compact.h"

#include <functional>
#include <vector>

#include "host/scene/validate.h"

namespace meniscal::gltf {
namespace {

using Visit = std::function<void(OrderedJson&)>;  // of one index

void each(OrderedJson& json, const char* key, const Visit& visit) {
  if (!json.contains(key)) return;
  for (OrderedJson& item : json[key]) visit(item);
}

void one(OrderedJson& json, const char* key, const Visit& visit) {
  if (json.contains(key)) visit(json[key]);
}

void each_mesh(OrderedJson& json, const Visit& visit) {
  each(json, "nodes", [&](OrderedJson& node) { one(node, "mesh", visit); });
}

void each_accessor(OrderedJson& json, const Visit& visit) {
  const auto attributes = [&](OrderedJson& set) {
    for (OrderedJson& accessor : set) visit(accessor);
  };
  each(json, "meshes", [&](OrderedJson& mesh) {
    each(mesh, "primitives", [&](OrderedJson& primitive) {
      one(primitive, "attributes", attributes);
      each(primitive, "targets", attributes);
      one(primitive, "indices", visit);
    });
  });
  each(json, "skins", [&](OrderedJson& skin) { one(skin, "inverseBindMatrices", visit); });
  each(json, "animations", [&](OrderedJson& animation) {
    each(animation, "samplers", [&](OrderedJson& sampler) {
      one(sampler, "input", visit);
      one(sampler, "output", visit);
    });
  });
}

void each_view(OrderedJson& json, const Visit& visit) {
  each(json, "accessors", [&](OrderedJson& accessor) {
    one(accessor, "bufferView", visit);
    one(accessor, "sparse", [&](OrderedJson& sparse) {
      for (const char* part : {"indices", "values"}) one(sparse[part], "bufferView", visit);
    });
  });
  each(json, "images", [&](OrderedJson& image) { one(image, "bufferView", visit); });
}

// Keeps the items of the root's array `key` to which `each_reference` leads, and numbers the references anew.
void keep_used(OrderedJson& json, const char* key, void (*each_reference)(OrderedJson&, const Visit&)) {
  if (!json.contains(key)) return;
  std::vector<bool> used(json[key].size(), false);
  each_reference(json, [&](OrderedJson& index) { used[index.get<std::size_t>()] = true; });
  std::vector<std::size_t> now(used.size());
  OrderedJson kept = OrderedJson::array();
  for (std::size_t i = 0; i < used.size(); ++i) {
    now[i] = kept.size();
    if (used[i]) kept.push_back(std::move(json[key][i]));
  }
  each_reference(json, [&](OrderedJson& index) { index = now[index.get<std::size_t>()]; });
  if (kept.empty())
    json.erase(key);
  else
    json[key] = std::move(kept);
}

void pack(Document& document) {
  std::string packed;
  each(document.json, "bufferViews", [&](OrderedJson& view) {
    const std::size_t from = view["byteOffset"].get<std::size_t>();
    while (packed.size() % 4 != from % 4) packed += '\0';  // what is aligned in it stays so
    view["byteOffset"] = packed.size();
    packed.append(document.bytes, from, view["byteLength"].get<std::size_t>());
  });
  document.bytes = std::move(packed);
}

}  // namespace

void compact(Document& document) {
  if (document.json.contains("extensionsUsed"))
    for (const OrderedJson& name : document.json["extensionsUsed"])
      if (!is_supported(name.get<std::string>())) return;
  keep_used(document.json, "meshes", each_mesh);
  keep_used(document.json, "accessors", each_accessor);
  keep_used(document.json, "bufferViews", each_view);
  pack(document);
}

}  // namespace meniscal::gltf
