// The built program: exit codes and messages.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "gtest/gtest.h"
#include "host/image/exr.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::meniscal;
using test::Outcome;
using test::TemporaryFolder;

const std::string kPool = "render \"" SCENES "/flat_water.gltf\"";

void write_grey(const std::string& path, float value, int width = 2) {
  Image image;
  image.width = width, image.height = 1;
  image.layers = {{"", {"R", "G", "B"}, std::vector<float>(3 * image.pixel_count(), value)}};
  write_exr(path, image);
}

TEST(Program, SaysItsVersion) {
  const TemporaryFolder folder;
  const Outcome o = meniscal(folder, "--version");
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(o.output.rfind("meniscal ", 0), 0u) << o.output;
}

TEST(Program, EveryCommandHasHelpWithAnExample) {
  const TemporaryFolder folder;
  for (const std::string command : {"", "render", "info", "mesh", "devices", "merge", "compare", "tradeoff"}) {
    const Outcome o = meniscal(folder, command + " --help");
    EXPECT_EQ(o.code, 0) << command;
    EXPECT_NE(o.output.find("Example: meniscal " + command), std::string::npos) << o.output;
  }
}

TEST(Program, WrongUsageIsTwoAndNamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::pair<std::string, std::string> cases[] = {{"", "subcommand"},
                                                       {"rendr scene.gltf", "rendr"},
                                                       {"render", "SCENE"},
                                                       {"render a.gltf --resolution 3", "--resolution"},
                                                       {"render a.gltf --unknown", "--unknown"},
                                                       {"mesh a.gltf", "--output"},
                                                       {"mesh a.gltf -o ./a.gltf", "the scene itself"},
                                                       {"mesh a.gltf -o a.obj", "a.obj"},
                                                       {"mesh a.gltf -o a.glb --meniscus round", "--meniscus"},
                                                       {"merge -o c.exr", "IMAGE"},
                                                       {"merge a.exr b.exr", "--output"},
                                                       {"compare a.exr", "B"},
                                                       {"compare a.exr b.exr --max-rmse nan", "--max-rmse"}};
  for (const auto& [arguments, named] : cases) {
    const Outcome o = meniscal(folder, arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_NE(o.error.find(named), std::string::npos) << o.error;
    EXPECT_NE(o.error.find("--help"), std::string::npos) << o.error;
    EXPECT_TRUE(o.output.empty()) << o.output;
  }
}

TEST(Program, AMissingSceneIsThreeAndNamed) {
  const TemporaryFolder folder;
  for (const std::string& command :
       {std::string("render"), std::string("info"), "mesh -o \"" + folder / "a.glb" + "\""}) {
    const Outcome o = meniscal(folder, command + " \"" + folder / "missing.gltf" + "\"");
    EXPECT_EQ(o.code, 3) << command;
    EXPECT_NE(o.error.find("missing.gltf"), std::string::npos) << o.error;
  }
}

TEST(Program, AnOutputThatCannotBeWrittenIsOneBeforeRendering) {
  const TemporaryFolder folder;
  const Outcome o = meniscal(folder, kPool + " --passes 2000000000 -o \"" + folder / "missing/a.exr" + "\"");
  EXPECT_EQ(o.code, 1);
  EXPECT_NE(o.error.find("missing/a.exr"), std::string::npos) << o.error;
}

TEST(Program, WritesASceneWithItsMenisciWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const std::string mesh = "mesh \"" SCENES "/post.gltf\" -o \"";
  EXPECT_EQ(meniscal(folder, mesh + folder / "missing/a.glb" + "\"").code, 1);
  const Outcome o = meniscal(folder, mesh + folder / "a.glb" + "\"");
  EXPECT_EQ(o.code, 0) << o.error;
  EXPECT_NE(o.output.find("1 meniscus"), std::string::npos) << o.output;
  const auto targets = [&](const std::string& scene) {
    const std::string text = meniscal(folder, "info \"" + scene + "\"").output;
    const std::size_t line = text.find("targeted map");
    return text.substr(line, text.find('\n', line) - line);
  };
  EXPECT_NE(targets(folder / "a.glb").find(" on "), std::string::npos);
  EXPECT_EQ(targets(folder / "a.glb"), targets(SCENES "/post.gltf"));

  const std::string before = test::read_bytes(folder / "a.glb");
  const Outcome small =
      meniscal(folder, mesh + folder / "a.glb" + "\"", "ulimit -f 8; trap '' XFSZ; ");  // blocks of 512
  EXPECT_EQ(small.code, 1) << small.error;
  EXPECT_EQ(test::read_bytes(folder / "a.glb"), before);
}

// Whatever the container: glTF itself knows no environment.
TEST(Program, WritesAScenesEnvironmentBesideIt) {
  const TemporaryFolder folder;
  nlohmann::json scene = nlohmann::json::parse(test::read_bytes(SCENES "/post.gltf"));
  scene["scenes"][0]["extras"]["environment"] = "skies/grey.exr";
  for (const char* name : {"a/skies", "b", "c/skies"}) std::filesystem::create_directories(folder / name);
  test::write_bytes(folder / "a/scene.gltf", scene.dump());
  write_grey(folder / "a/skies/grey.exr", 0.5f);
  const std::string sky = test::read_bytes(folder / "a/skies/grey.exr");
  const auto written = [&](const std::string& name) {
    return meniscal(folder, "mesh \"" + folder / "a/scene.gltf" + "\" -o \"" + folder / name + "\"");
  };
  for (const char* name : {"a/new.gltf", "b/new.gltf", "b/new.glb"}) {
    const Outcome o = written(name);
    EXPECT_EQ(o.code, 0) << o.error;
    EXPECT_EQ(o.error.find("environment"), std::string::npos) << o.error;
    const Outcome read = meniscal(folder, "info \"" + folder / name + "\"");
    EXPECT_EQ(read.code, 0) << read.error;
    EXPECT_NE(read.output.find("2 x 1 pixels"), std::string::npos) << read.output;
  }
  EXPECT_EQ(test::read_bytes(folder / "b/skies/grey.exr"), sky);

  test::write_bytes(folder / "c/skies/grey.exr", "another's");
  const Outcome refused = written("c/new.gltf");
  EXPECT_EQ(refused.code, 1);
  EXPECT_NE(refused.error.find("c/skies/grey.exr"), std::string::npos) << refused.error;
  EXPECT_EQ(test::read_bytes(folder / "c/skies/grey.exr"), "another's");
  EXPECT_FALSE(std::filesystem::exists(folder / "c/new.gltf"));
}

TEST(Program, AMissingDeviceIsFourAndNamed) {
  const TemporaryFolder folder;
  const Outcome o = meniscal(folder, kPool + " --device abacus -o \"" + folder / "a.exr" + "\"");
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.error.find("abacus"), std::string::npos) << o.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
}

TEST(Program, AnInterruptWritesTheImageSoFar) {
  const TemporaryFolder folder;
  const std::string image = folder / "a.exr";
  const Outcome o =
      meniscal(folder, kPool + " --device cpu --resolution 4x3 --photons 10 --passes 2000000000 -o \"" + image + "\"",
               "timeout --foreground --preserve-status --signal=INT 2 ");
  EXPECT_EQ(o.code, 130) << o.error;
  EXPECT_NE(o.error.find("a.exr"), std::string::npos) << o.error;
  EXPECT_EQ(read_exr(image).width, 4);
}

TEST(Program, CompareTellsEqualFromDifferent) {
  const TemporaryFolder folder;
  write_grey(folder / "one.exr", 1);
  write_grey(folder / "more.exr", 1.25f);
  write_grey(folder / "wide.exr", 1, 3);
  const std::string both = "compare \"" + folder / "more.exr" + "\" \"" + folder / "one.exr" + "\"";
  EXPECT_EQ(meniscal(folder, both).code, 0);
  EXPECT_EQ(meniscal(folder, both + " --max-rmse 0.26").code, 0);
  const Outcome above = meniscal(folder, both + " --max-rmse 0.24");
  EXPECT_EQ(above.code, 1);
  EXPECT_NE(above.error.find("0.25"), std::string::npos) << above.error;

  const nlohmann::json json = nlohmann::json::parse(meniscal(folder, both + " --json").output);
  EXPECT_EQ(json.at("layers").at(0).at("layer"), "beauty");
  EXPECT_EQ(json.at("layers").at(0).at("relative_rmse"), 0.25);
  EXPECT_EQ(json.at("layers").at(0).at("mean_ratio"), 1.25);

  const Outcome sizes = meniscal(folder, "compare \"" + folder / "one.exr" + "\" \"" + folder / "wide.exr" + "\"");
  EXPECT_EQ(sizes.code, 3);
  EXPECT_NE(sizes.error.find("3 x 1"), std::string::npos) << sizes.error;
  const Outcome missing = meniscal(folder, "compare \"" + folder / "none.exr" + "\" \"" + folder / "one.exr" + "\"");
  EXPECT_EQ(missing.code, 3);
  EXPECT_NE(missing.error.find("none.exr"), std::string::npos) << missing.error;
}

TEST(Program, CompareFindsNoBoundForWhatIsNotANumber) {
  const TemporaryFolder folder;
  write_grey(folder / "nan.exr", std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(
      meniscal(folder, "compare \"" + folder / "nan.exr" + "\" \"" + folder / "nan.exr" + "\" --max-rmse 1e9").code, 1);
}

TEST(Program, SwallowedOutputIsAFailure) {
  const int status = std::system("\"" MENISCAL_PROGRAM "\" devices >/dev/full 2>/dev/null");
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

TEST(Program, ListsDevicesAndTheReferencePath) {
  const TemporaryFolder folder;
  const Outcome o = meniscal(folder, "devices");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.output.find("cpu"), std::string::npos) << o.output;
  EXPECT_TRUE(nlohmann::json::parse(meniscal(folder, "devices --json").output).at("devices").is_array());
}

}  // namespace
}  // namespace meniscal
