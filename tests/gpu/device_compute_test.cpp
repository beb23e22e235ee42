// Passes and commands, with a shader that takes everything a pass can be given.
#include <algorithm>
#include <bit>

#include "device_fixture.h"
#include "device_test_spirv.h"
#include "host/gpu/commands.h"

namespace meniscal::gpu {
namespace {

struct Push {
  uint32_t count, offset;
};

// The test shader and the buffers it reads. Runs values -> 3 values + offset + 0.5 * numbers.z + bits.y.
struct TestPass {
  explicit TestPass(const Device& device)
      : pass(device, "test", device_test_spirv, {{0, Kind::texel}, {1, Kind::texel}, {2, Kind::storage}}, sizeof(Push),
             {3, 1, std::bit_cast<uint32_t>(0.5f)}),
        numbers(device, "numbers", 4 * 16),
        bits(device, "bits", 4 * 16) {
    std::vector<float> texels(16);
    std::vector<uint32_t> texel_bits(16);
    for (uint32_t i = 0; i < 4; ++i) {
      texels[4 * i + 2] = 20 * static_cast<float>(i);
      texel_bits[4 * i + 1] = 0x80000000u + 1000 * i;  // not a float that survives arithmetic
    }
    numbers.upload(texels);
    bits.upload(texel_bits);
  }
  BindingSet bind(const Buffer& values) const {
    return pass.bind({{0, numbers}, {1, bits, Format::rgba32ui}, {2, values}});
  }
  static uint32_t expected(uint32_t value, uint32_t i, uint32_t offset) {
    return 3 * value + offset + 10 * (i % 4) + 0x80000000u + 1000 * (i % 4);
  }
  ComputePass pass;
  Buffer numbers, bits;
};

TEST_F(GpuTest, RunsAShaderOnWhatItIsGiven) {
  const TestPass test(*device);
  const uint32_t n = 1000;
  Buffer values(*device, "values", 4 * n);
  values.upload(counting(n));
  const BindingSet set = test.bind(values);
  Commands commands(*device);
  commands.dispatch(test.pass, set, Push{n - 1, 5}, (n + 63) / 64);
  commands.submit_and_wait();
  const auto found = values.download<uint32_t>();
  for (uint32_t i = 0; i < n - 1; ++i) ASSERT_EQ(found[i], TestPass::expected(i, i, 5)) << i;
  EXPECT_EQ(found[n - 1], n - 1) << "beyond count";
  EXPECT_GT(commands.last_submit_seconds(), 0);
  const auto& seconds = commands.seconds_by_stage();
  ASSERT_EQ(seconds.size(), 1u);
  EXPECT_GT(seconds.at("test"), 0);
  EXPECT_LE(seconds.at("test"), 1.5 * commands.last_submit_seconds());
}

TEST_F(GpuTest, SpreadsManyWorkgroupsOverTwoDimensions) {
  const TestPass test(*device);
  const uint32_t groups = 2 * max_groups_x + 7, n = groups * 64;
  Buffer values(*device, "values", size_t{4} * n);
  values.upload(counting(n));
  const BindingSet set = test.bind(values);
  Commands commands(*device);
  commands.dispatch(test.pass, set, Push{n, 1}, groups);
  commands.submit_and_wait();
  const auto found = values.download<uint32_t>();
  for (uint32_t i = 0; i < n; ++i) ASSERT_EQ(found[i], TestPass::expected(i, i, 1)) << i;
}

TEST_F(GpuTest, KeepsOrderAcrossBarriersAndSubmissions) {
  const TestPass test(*device);
  const uint32_t n = 5000;
  Buffer values(*device, "values", 4 * n, Memory::staged), copy(*device, "copy", 4 * n + 8, Memory::staged);
  values.upload(counting(n));
  const BindingSet set = test.bind(values);
  Commands commands(*device);
  auto expected = counting(n);
  for (uint32_t submission = 0; submission < 3; ++submission) {
    for (uint32_t round = 0; round < 300; ++round) {  // more timestamps than one query pool holds
      commands.dispatch(test.pass, set, Push{n, round}, (n + 63) / 64);
      commands.barrier();
      for (uint32_t i = 0; i < n; ++i) expected[i] = TestPass::expected(expected[i], i, round);
    }
    commands.fill(copy, 0xABCDu);
    commands.barrier();
    commands.copy(values, copy, 4 * (n - 1), 4, 8);
    commands.submit_and_wait();
    EXPECT_TRUE(values.download<uint32_t>() == expected);
    const auto copied = copy.download<uint32_t>();
    EXPECT_EQ(copied[0], 0xABCDu);
    EXPECT_EQ(copied[1], 0xABCDu);
    EXPECT_TRUE(std::equal(expected.begin() + 1, expected.end(), copied.begin() + 2));
    EXPECT_EQ(copied.back(), 0xABCDu);
  }
  commands.submit_and_wait();  // nothing recorded: nothing happens
}

TEST_F(GpuTest, RefusesMisuse) {
  const TestPass test(*device);
  Buffer values(*device, "values", 400);
  const BindingSet set = test.bind(values);
  Commands commands(*device);
  const auto missing = [&] { test.pass.bind({{0, test.numbers}, {2, values}}); };
  expect_contains(error_text(missing, ExitCode::failed), "binding 1");
  error_text([&] { test.pass.bind({{0, values}, {0, values}, {1, values}, {2, values}}); }, ExitCode::failed);
  error_text([&] { test.pass.bind({{0, values}, {1, values}, {2, values}, {3, values}}); }, ExitCode::failed);
  expect_contains(error_text([&] { commands.dispatch(test.pass, set, 1); }, ExitCode::failed), "'test'");
  error_text([&] { commands.copy(values, values, 8, 396, 0); }, ExitCode::failed);
  commands.dispatch(test.pass, set, Push{100, 0}, 0);
  commands.submit_and_wait();
  EXPECT_EQ(commands.seconds_by_stage().count("test"), 0u);
}

// Proves that the silence of the other tests means something. The second dispatch reads, as texels, what the first
// wrote: layer 1.3.239 reports that, but not a storage buffer written by both.
TEST(GpuValidation, ReportsAMissingBarrier) {
  REQUIRE_DEVICE();
  const Device device = Device::open("auto", true);
  if (!device.has_validation()) {
    if (on_ci()) FAIL() << "no validation layer on CI: vulkan-validationlayers should be installed";
    GTEST_SKIP() << "no validation layer: install vulkan-validationlayers to run this test";
  }
  const TestPass test(device);
  const Buffer first(device, "first", 400), second(device, "second", 400);
  const BindingSet writes = test.bind(first);
  const BindingSet reads = test.pass.bind({{0, first}, {1, test.bits, Format::rgba32ui}, {2, second}});
  Commands commands(device);
  for (const bool with_barrier : {true, false}) {
    commands.dispatch(test.pass, writes, Push{100, 0}, 2);
    if (with_barrier) commands.barrier();
    commands.dispatch(test.pass, reads, Push{100, 0}, 2);
    commands.submit_and_wait();
    const auto& messages = device.validation_messages();
    EXPECT_EQ(messages.size(), with_barrier ? 0u : 1u);
    for (const auto& message : messages) {
      expect_contains(message, "SYNC-HAZARD-READ-AFTER-WRITE");
      expect_contains(message, "[first]");  // objects carry their names
    }
  }
}

}  // namespace
}  // namespace meniscal::gpu
