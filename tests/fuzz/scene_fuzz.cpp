// Any bytes as a scene file: a scene whose numbers are usable, or an Error of exit code 3.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "host/error.h"
#include "host/scene/scene.h"
#include "tests/fuzz/bytes.h"

namespace {

namespace fs = std::filesystem;
using meniscal::fuzz::require;

// A folder with the scene alone: what a scene may name lies beside it.
const fs::path& folder() {
  static const fs::path path = [] {
    const fs::path made = fs::temp_directory_path() / ("meniscal-fuzz-" + std::to_string(getpid()));
    fs::create_directories(made);
    std::atexit([] {
      std::error_code ignored;
      fs::remove_all(folder(), ignored);
    });
    return made;
  }();
  return path;
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_usable(const meniscal::Scene& scene) {
  require(!scene.objects.empty() && !scene.cameras.empty() && is_finite(scene.origin));
  for (const meniscal::Object& object : scene.objects) {
    const auto& mesh = object.mesh;
    require(static_cast<std::size_t>(object.material) < scene.materials.size());
    require(mesh.normals.size() == mesh.positions.size() && !mesh.triangles.empty());
    require(object.coordinates.empty() || object.coordinates.size() == mesh.triangles.size());
    for (const glm::dvec3& p : mesh.positions) require(is_finite(p));
    for (const glm::dvec3& n : mesh.normals) require(std::abs(glm::length(n) - 1) < 1e-6);
    for (const glm::uvec3& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) require(t[k] < mesh.positions.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = (folder() / "scene.gltf").string();
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    require_usable(meniscal::load_gltf(path));
  } catch (const meniscal::Error& error) {
    require(error.code == meniscal::ExitCode::scene);
  }
  return 0;
}
