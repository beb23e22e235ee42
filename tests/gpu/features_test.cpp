// What the plan leaves out of shaders where a scene has no need of it.
#include "tests/support/textured_scene.h"

namespace meniscal {
namespace {

// One of these.
struct Feature {
  const char* name;
  std::function<void(Scene&)> edit;  // both force it on, and change nothing that is seen
  std::function<void(test::Setup&)> force;
  std::function<std::size_t(const test::Setup&)> buffers;  // more than without, bytes
};
constexpr std::size_t kEmpty = 16;  // bytes of a buffer that holds nothing

// White, and straight up.
void add_plain_textures(Scene& scene) {
  const auto image = [](bool deep, const glm::uvec4& texel) {
    return test::make_image(2, 2, deep, [&](std::uint32_t, std::uint32_t) { return texel; });
  };
  const auto white = image(false, glm::uvec4(255)), up = image(true, {32768, 32768, 65535, 65535});
  for (Material& m : scene.materials) {
    if (m.liquid) continue;
    m.base_color_texture = m.emissive_texture = test::make_texture(white, true);
    m.metallic_roughness_texture = test::make_texture(white, false);
    m.normal_texture = test::make_texture(up, false);
    m.normal_scale = 0;  // texels have no exact 0
  }
  const CornerCoordinates corners{glm::vec4(0), glm::vec4(1, 0, 1, 0), glm::vec4(0, 1, 0, 1)};
  for (Object& o : scene.objects) o.coordinates.assign(o.mesh.triangles.size(), corners);
}

// Of materials that no triangle has.
void add_surfaces(World& world) {
  for (const std::uint32_t kind : {shared::SPECULAR_MIRROR, shared::SPECULAR_DIELECTRIC, shared::SPECULAR_THIN}) {
    shared::Surface surface = world.surfaces.front();
    surface.kind = kind;
    surface.specular = 1;
    surface.alpha = 0.3f;
    surface.absorption = glm::vec3(1);
    world.surfaces.push_back(surface);
    world.material_names.push_back("unused");
  }
}

const std::vector<Feature>& features() {
  const auto no_edit = [](Scene&) {};
  const auto no_force = [](test::Setup&) {};
  const auto none = [](const test::Setup&) -> std::size_t { return 0; };
  static const std::vector<Feature> list = {
      {"gloss", no_edit, [](test::Setup& s) { s.world.glossy = true; },
       [](const test::Setup& s) {
         return s.settings.crop.pixels() * sizeof(shared::PixelGloss) + 4 * s.settings.caustics.count() - 2 * kEmpty;
       }},
      {"nested dielectrics", no_edit, [](test::Setup& s) { s.world.nested = "forced"; }, none},
      {"emission and scattering", no_edit, [](test::Setup& s) { s.settings.diffuse_bounces = 1; }, none},
      {"sun", no_edit, [](test::Setup& s) { s.world.suns = 1; }, none},
      {"sky", no_edit,
       [](test::Setup& s) {
         s.world.environment.columns = 64, s.world.environment.rows = 32;
         s.world.environment.pixels = std::vector<glm::vec4>(64 * 32);
       },
       [](const test::Setup& s) { return s.world.environment.pixels.size() * sizeof(glm::vec4) - kEmpty; }},
      {"frosted glass, mirrors, absorption", no_edit, [](test::Setup& s) { add_surfaces(s.world); },
       [](const test::Setup&) { return 3 * sizeof(shared::Surface); }},
      {"textures", add_plain_textures, no_force,
       [](const test::Setup& s) {
         constexpr std::size_t images = 4 * 4 + 4 * 8;
         return images - kEmpty + s.world.coordinates.size() * sizeof(CornerCoordinates) +
                s.world.textured.size() * sizeof(shared::MaterialTextures) +
                s.world.textures.size() * sizeof(shared::Texture) - kEmpty;
       }},
  };
  return list;
}

class Features : public testing::TestWithParam<const char*> {};

// What a scene does not need costs memory and time where it is forced on, and changes nothing.
TEST_P(Features, ForcedOnGiveTheSamePicture) {
  REQUIRE_DEVICE();
  struct Picture {
    std::vector<glm::dvec3> pixels;
    std::size_t bytes, buffers;
  };
  const auto picture = [](const std::vector<Feature>& forced) {
    const auto setup = test::make_setup(GetParam(), test::small_options(40000, 80, 60), [&](Scene& scene) {
      for (const Feature& f : forced) f.edit(scene);
    });
    for (const Feature& f : forced) f.force(*setup);
    GpuBackend gpu(gpu::Device::open("auto", true), setup->world, setup->settings);
    const test::PassResult result = test::render_pass(gpu, 1);
    Picture made{{}, gpu.statistics().bytes_peak, 0};
    for (std::size_t i = 0; i < result.samples.size(); ++i) made.pixels.push_back(test::radiance(result, i));
    for (const Feature& f : forced) made.buffers += f.buffers(*setup);
    return made;
  };
  const auto setup = test::make_setup(GetParam(), test::small_options(1, 8, 8));
  ASSERT_TRUE(!setup->world.glossy && setup->world.nested.empty() && setup->world.suns == 0 &&
              setup->world.environment.columns == 0 && setup->world.textures.empty());
  const Picture plain = picture({});
  const auto expect_same = [&](const char* name, const std::vector<Feature>& forced) {
    SCOPED_TRACE(name);
    const Picture other = picture(forced);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
      difference += glm::length(other.pixels[i] - plain.pixels[i]);
      sum += glm::length(plain.pixels[i]);
    }
    std::printf("%s: %zu bytes, differs by %.1e\n", name, other.bytes - plain.bytes, difference / sum);
    EXPECT_LT(difference, 1e-4 * sum);
    EXPECT_EQ(other.bytes - plain.bytes, other.buffers);
  };
  for (const Feature& f : features()) expect_same(f.name, {f});
  expect_same("all", features());
}
INSTANTIATE_TEST_SUITE_P(Scenes, Features, testing::Values("behind_glass", "area_light"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace meniscal
