#include "host/export/export.h"

#include "host/export/compact.h"
#include "host/export/liquids.h"

namespace meniscal::gltf {

Exported export_with_menisci(const std::string& path, MeniscusModel model, double meniscus_tolerance) {
  Messages messages(path);
  const Source source = read_source(path, messages);
  const Scene scene = make_scene(source, messages);
  Exported result{open_document(source), {}, source.environment_file, scene.warnings};
  Stages stages;
  result.liquids = raise_menisci(scene, model, {meniscus_tolerance}, result.warnings, stages);
  if (result.liquids.empty())
    result.warnings.push_back(path + ": has no liquid (material extra meniscus_liquid): written as it is");
  Messages of_export(path);
  replace_liquids(result.document, source, scene, result.liquids, of_export);
  result.warnings.insert(result.warnings.end(), of_export.warnings().begin(), of_export.warnings().end());
  compact(result.document);
  result.document.json["asset"]["generator"] = "Meniscal " MENISCAL_VERSION;
  return result;
}

}  // namespace meniscal::gltf
