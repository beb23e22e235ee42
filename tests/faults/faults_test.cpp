// The program on devices that fail, disks that are full, folders that may not be written, and without any driver.
#include <vulkan/vulkan_core.h>

#include "gtest/gtest.h"
#include "host/image/exr.h"
#include "tests/gpu/device_fixture.h"
#include "tests/unit/program.h"

namespace meniscal {
namespace {

using test::Outcome;
using test::TemporaryFolder;

std::string render_post(const std::string& output, const std::string& options = "--passes 2 --resolution 16x12") {
  return "render \"" SCENES "/post.gltf\" -o \"" + output + "\" --quiet --meniscus paper --photons 2000 --samples 1 " +
         options;
}

// `result`: VkResult of the call-th call.
std::string faulty(const std::string& function, int call, VkResult result) {
  return "VK_LAYER_PATH=\"" FAULT_LAYER "\" VK_INSTANCE_LAYERS=VK_LAYER_MENISCAL_fault MENISCAL_TEST_FAULT=\"" +
         function + " " + std::to_string(call) + " " + std::to_string(static_cast<int>(result)) + "\" ";
}

struct Failing {
  const char* function;
  VkResult result;
  const char* message;
};
void PrintTo(const Failing& f, std::ostream* out) { *out << f.function << "_" << f.result; }
class DeviceFault : public testing::TestWithParam<Failing> {};

// At the first call, the second, the fourth and so on, until there are no more.
TEST_P(DeviceFault, IsToldAndLeavesNothingHalfWritten) {
  REQUIRE_DEVICE();
  const Failing& f = GetParam();
  for (int call = 1;; call *= 2) {
    ASSERT_LT(call, 1 << 20) << "fails whatever is called";
    const TemporaryFolder folder;
    const Outcome o = test::meniscal(folder, render_post(folder / "a.exr"), faulty(f.function, call, f.result));
    if (o.code == 0) {
      EXPECT_GT(call, 1) << "never called";
      break;
    }
    EXPECT_EQ(o.code, 4) << o.error;
    EXPECT_NE(o.error.find(f.message), std::string::npos) << o.error;
    EXPECT_NE(o.error.find("try"), std::string::npos) << "no remedy: " << o.error;
    EXPECT_EQ(folder.files(), 2u) << "beside stdout and stderr";
  }
}
constexpr const char *lost = "device was lost", *full = "out of device memory", *host = "out of host memory";
INSTANTIATE_TEST_SUITE_P(Calls, DeviceFault,
                         testing::Values(Failing{"vkCreateDevice", VK_ERROR_DEVICE_LOST, lost},
                                         Failing{"vkCreateDevice", VK_ERROR_OUT_OF_HOST_MEMORY, host},
                                         Failing{"vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkAllocateMemory", VK_ERROR_OUT_OF_HOST_MEMORY, host},
                                         Failing{"vkMapMemory", VK_ERROR_OUT_OF_HOST_MEMORY, host},
                                         Failing{"vkCreateBuffer", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkCreateBufferView", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkCreateComputePipelines", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkCreateDescriptorPool", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkAllocateDescriptorSets", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkBeginCommandBuffer", VK_ERROR_OUT_OF_HOST_MEMORY, host},
                                         Failing{"vkQueueSubmit", VK_ERROR_DEVICE_LOST, lost},
                                         Failing{"vkQueueSubmit", VK_ERROR_OUT_OF_DEVICE_MEMORY, full},
                                         Failing{"vkWaitForFences", VK_ERROR_DEVICE_LOST, lost}));

TEST(DeviceLost, CostsNoPassThatACheckpointHolds) {
  REQUIRE_DEVICE();
  const TemporaryFolder folder;
  const std::string options = " --passes 6 --resolution 16x12 --checkpoint \"" + (folder / "kept") + "\" --resume";
  ASSERT_EQ(test::meniscal(folder, render_post(folder / "whole.exr", "--passes 6 --resolution 16x12")).code, 0);
  bool kept = false;
  for (int call = 8; !kept && call < 4096; call *= 2) {
    const Outcome o = test::meniscal(folder, render_post(folder / "a.exr", options),
                                     faulty("vkQueueSubmit", call, VK_ERROR_DEVICE_LOST));
    ASSERT_EQ(o.code, 4) << "lost in no pass";
    kept = std::filesystem::exists(folder / "kept");
  }
  ASSERT_TRUE(kept);
  ASSERT_EQ(test::meniscal(folder, render_post(folder / "a.exr", options)).code, 0);
  EXPECT_EQ(read_exr(folder / "a.exr").layers[0].pixels, read_exr(folder / "whole.exr").layers[0].pixels);
}

TEST(Driver, ThatIsMissingIsTold) {
  const TemporaryFolder folder;
  const Outcome o = test::meniscal(folder, render_post(folder / "a.exr"),
                                   "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent ");
  EXPECT_EQ(o.code, 4) << o.error;
  EXPECT_NE(o.error.find("--device cpu"), std::string::npos) << o.error;
  EXPECT_EQ(folder.files(), 2u);
}

// Files may not grow past some kilobytes: an image, statistics or checkpoint that is written when all is rendered.
TEST(FullDisk, IsToldAndLeavesNothingHalfWritten) {
  for (const std::string name : {"a.exr", "a.png", "a.json", "kept"}) {
    const TemporaryFolder folder;
    std::string options = " --device cpu --aov all --passes 2 --resolution 64x48";
    if (name == "a.png") options += " --preview \"" + (folder / name) + "\"";
    if (name == "a.json") options += " --stats \"" + (folder / name) + "\"";
    if (name == "kept") options += " --checkpoint \"" + (folder / name) + "\"";
    const Outcome o = test::meniscal(folder, render_post(folder / "a.exr", options), "ulimit -f 4; ");
    EXPECT_EQ(o.code, 1) << name << ": " << o.error;
    EXPECT_NE(o.error.find(folder.path()), std::string::npos) << o.error;
    EXPECT_NE(o.error.find("make room"), std::string::npos) << o.error;
    EXPECT_EQ(folder.files(), 2u) << name;
  }
}

TEST(UnwritableFolder, IsToldBeforeAnythingIsRendered) {
  const TemporaryFolder folder;
  for (const std::string name : {"/proc/a.exr", "/proc/none/a.exr"}) {
    const Outcome o = test::meniscal(folder, render_post(name, "--passes 1000000 --device cpu"), "timeout 60 ");
    EXPECT_EQ(o.code, 1) << o.error;
    EXPECT_NE(o.error.find(name), std::string::npos) << o.error;
  }
}

}  // namespace
}  // namespace meniscal
