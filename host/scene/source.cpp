#include "host/scene/source.h"

#include <stdexcept>

#include "host/scene/embedded.h"
#include "host/scene/environment.h"
#include "host/scene/guard.h"
#include "host/scene/schema.h"
#include "host/scene/validate.h"

namespace meniscal::gltf {
namespace {

// No image is decoded here (images.h). Those that are part of a buffer are there already.
bool keep_image_file(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                     int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

// `file`: a .glb; or the text of a .gltf, without the buffers that `folder` has taken over.
tinygltf::Model parse(std::string_view file, bool binary, AssetFolder& folder, const Messages& messages) {
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks(folder.callbacks());
  parser.SetImageLoader(keep_image_file, nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  bool done = false;
  const auto size = static_cast<unsigned>(file.size());  // max_bytes is less
  try {
    done = binary ? parser.LoadBinaryFromMemory(&model, &errors, &warnings,
                                                reinterpret_cast<const unsigned char*>(file.data()), size, "")
                  : parser.LoadASCIIFromString(&model, &errors, &warnings, file.data(), size, "");
  } catch (const std::out_of_range& error) {  // for instance an empty buffer
    errors = error.what();
  }
  if (!done) messages.fail("glTF", errors, "export the scene again");
  return model;
}

}  // namespace

Source read_source(const std::string& path, Messages& messages) {
  AssetFolder folder(path, messages);
  const std::vector<unsigned char> file = folder.read_scene();
  const bool binary = is_binary(file);
  std::string_view json = json_text(file, messages);
  Embedded embedded;
  if (!binary) {
    embedded = take_out_buffers(json);
    json = embedded.json;
    folder.add_embedded(std::move(embedded.buffers));
  }
  check_depth(json, messages);
  check_schema(json, messages);
  const std::string_view whole(reinterpret_cast<const char*>(file.data()), file.size());
  Source source{path, std::string(json), parse(binary ? whole : json, binary, folder, messages), {}, {}, {}, {}};
  validate(source.model, binary, messages);
  source.environment = read_environment(source.model, folder, messages, source.environment_file, source.stages);
  source.hash = folder.hash();
  return source;
}

}  // namespace meniscal::gltf
