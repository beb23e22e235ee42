// Any bytes as an image: those of OpenEXR read, compared and merged, others decoded as a texture; or an error that says
// why not.
#include <string>

#include "host/error.h"
#include "host/image/compare.h"
#include "host/image/exr.h"
#include "host/render/header.h"
#include "host/render/merge.h"
#include "host/scene/images.h"
#include "tests/fuzz/bytes.h"

namespace {

using meniscal::Error;
using meniscal::Image;
using meniscal::fuzz::require;

void require_scene_error(const Error& error) { require(error.code == meniscal::ExitCode::scene); }

void merge(const Image& image) {
  meniscal::Merge merge;
  merge.add(image, "first.exr");
  bool refused = false;
  try {
    merge.add(image, "second.exr");  // the same passes again
  } catch (const Error& error) {
    require_scene_error(error);
    refused = true;
  }
  require(refused);
  Image later = image;
  const std::uint32_t last = meniscal::passes_of(image)->back().last;
  if (last < meniscal::most_passes) {
    meniscal::describe_passes(later, {{last, last + 1}}, 0);
    merge.add(later, "later.exr");
  }
  const Image merged = merge.result();
  require(merged.layers.size() == image.layers.size());
}

void read_exr(const std::uint8_t* data, std::size_t size) {
  Image image;
  try {
    image = meniscal::decode_exr({reinterpret_cast<const char*>(data), size});
  } catch (const std::exception&) {
    return;
  }
  require(image.width > 0 && image.height > 0 && !image.layers.empty());
  for (const meniscal::Layer& layer : image.layers)
    require(layer.pixels.size() == image.pixel_count() * layer.channels.size());
  meniscal::compare(image, "a.exr", image, "b.exr");
  try {
    merge(image);
  } catch (const Error& error) {
    require_scene_error(error);
  }
}

void read_texture(const std::uint8_t* data, std::size_t size) {
  tinygltf::Model model;
  model.images.emplace_back().image.assign(data, data + size);
  const meniscal::gltf::Messages messages("scene.gltf");
  try {
    const auto image = meniscal::gltf::Images(model, messages).decode(0);
    require(image->words.size() == std::size_t{image->width} * image->height * (image->deep ? 2 : 1));
  } catch (const Error& error) {
    require_scene_error(error);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size >= 4 && std::string(reinterpret_cast<const char*>(data), 4) == "\x76\x2f\x31\x01")
    read_exr(data, size);
  else
    read_texture(data, size);
  return 0;
}
