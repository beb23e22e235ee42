// A scene file as it was read: the validated document and all bytes it refers to.
#pragma once

#include <tiny_gltf.h>

#include <string>

#include "host/scene/messages.h"
#include "host/scene/scene.h"

namespace meniscal::gltf {

struct Source {
  std::string file;       // as given, for messages
  std::string json;       // its text; of buffers that stood in it only names are left
  tinygltf::Model model;  // validated; an image outside buffers holds its file's bytes, undecoded
  std::optional<Environment> environment;
  std::string environment_file;  // as the scene names it, beside itself; empty: none
  std::string hash;              // of all bytes read, hexadecimal
  Stages stages;
};

// guard -> embedded buffers -> schema -> tinygltf -> validate. Throws Error(ExitCode::scene).
Source read_source(const std::string& path, Messages& messages);

// The scene that it describes; takes the warnings over from `messages`.
Scene make_scene(const Source& source, Messages& messages);

}  // namespace meniscal::gltf
