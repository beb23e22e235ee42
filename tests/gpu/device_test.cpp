// Devices and buffers, on whatever driver there is.
#include <algorithm>

#include "device_fixture.h"
#include "host/gpu/buffer.h"

namespace meniscal::gpu {
namespace {

TEST_F(GpuTest, ListsDevices) {
  const auto devices = list_devices();
  const std::vector<std::string> types{"discrete", "integrated", "virtual", "cpu", "other"};
  for (size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].driver.empty());
    EXPECT_TRUE(std::ranges::find(types, devices[i].type) != types.end()) << devices[i].type;
    EXPECT_GE(devices[i].api_version, VK_API_VERSION_1_2);
  }
}

TEST_F(GpuTest, OpensByIndexAndPartOfName) {
  for (const DeviceInfo& info : list_devices()) {
    EXPECT_EQ(Device::open(std::to_string(info.index)).info().name, info.name);
    std::string part = info.name.substr(0, 5);
    std::ranges::transform(part, part.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    EXPECT_EQ(Device::open(part).info().name.substr(0, 5), info.name.substr(0, 5));
  }
}

TEST_F(GpuTest, RefusesAnUnknownDeviceAndNamesTheKnown) {
  for (const std::string selector : {"no such device", "999", ""}) {
    const std::string text = error_text([&] { Device::open(selector); }, ExitCode::device);
    expect_contains(text, "'" + selector + "'");
    for (const DeviceInfo& info : list_devices()) expect_contains(text, info.name);
    expect_contains(text, "cpu");
  }
}

// The loader looks for drivers anew for each instance; each test runs in a process of its own.
TEST(GpuWithoutDriver, ListsNothingAndSaysWhatToInstall) {
  ASSERT_EQ(setenv("VK_DRIVER_FILES", "/nonexistent", 1), 0);
  ASSERT_EQ(setenv("VK_ICD_FILENAMES", "/nonexistent", 1), 0);
  EXPECT_TRUE(list_devices().empty());
  const std::string text = error_text([] { Device::open("auto"); }, ExitCode::device);
  unsetenv("VK_DRIVER_FILES");
  unsetenv("VK_ICD_FILENAMES");
  expect_contains(text, "mesa-vulkan-drivers");
  expect_contains(text, "--device cpu");
}

TEST_F(GpuTest, KnowsLimitsThatVulkanGuarantees) {
  const Limits& limits = device->limits();
  EXPECT_GE(limits.max_storage_range, size_t{1} << 27);
  EXPECT_GE(limits.max_texel_elements, 65536u);
  EXPECT_GE(limits.max_workgroup_size, 128u);
  EXPECT_GE(limits.max_shared_memory, 16384u);
  EXPECT_GE(limits.max_push_bytes, 128u);
  EXPECT_GE(limits.max_storage_buffers, 4u);
  EXPECT_GE(limits.max_texel_buffers, 16u);
  EXPECT_GT(limits.heap, 0u);
}

TEST_F(GpuTest, ReturnsWhatWasWritten) {
  for (const Memory memory : {Memory::device, Memory::host, Memory::staged}) {
    for (const size_t bytes : {size_t{0}, size_t{1}, size_t{1000003}, size_t{40000001}}) {
      SCOPED_TRACE(bytes);
      std::vector<uint8_t> values(bytes);
      for (size_t i = 0; i < bytes; ++i) values[i] = static_cast<uint8_t>(i * 7 + i / 256 + i / 65536);
      Buffer buffer(*device, "round trip", bytes, memory);
      EXPECT_EQ(buffer.bytes(), bytes);
      buffer.upload(values);
      EXPECT_TRUE(buffer.download<uint8_t>() == values);
    }
  }
}

TEST_F(GpuTest, WritesAndReadsParts) {
  for (const Memory memory : {Memory::device, Memory::staged}) {
    Buffer buffer(*device, "parts", 4000, memory);
    buffer.upload(counting(1000));
    buffer.upload(std::vector<uint32_t>{7, 8, 9}, 400);
    EXPECT_EQ(buffer.download<uint32_t>(99, 5), (std::vector<uint32_t>{99, 7, 8, 9, 103}));
    expect_contains(error_text([&] { buffer.upload(counting(1000), 4); }, ExitCode::failed), "'parts'");
    expect_contains(error_text([&] { buffer.download<uint32_t>(999, 2); }, ExitCode::failed), "'parts'");
    error_text([&] { buffer.download<uint8_t>(~size_t{0}, 2); }, ExitCode::failed);
  }
}

TEST_F(GpuTest, CountsBytes) {
  EXPECT_EQ(device->bytes_now(), 0u);
  {
    Buffer first(*device, "first", 1 << 20);
    const Buffer second(*device, "second", 2 << 20);
    EXPECT_GE(device->bytes_now(), size_t{3} << 20);
    first = Buffer(*device, "third", 16);
    EXPECT_LT(device->bytes_now(), (size_t{2} << 20) + 4096);
    EXPECT_EQ(first.name(), "third");
  }
  EXPECT_EQ(device->bytes_now(), 0u);
  EXPECT_GE(device->bytes_peak(), size_t{3} << 20);
  EXPECT_LT(device->bytes_peak(), size_t{4} << 20);
}

TEST_F(GpuTest, RefusesBuffersThatAreTooLarge) {
  const size_t bytes = device->limits().max_buffer + 1;
  const std::string text = error_text([&] { Buffer(*device, "huge", bytes); }, ExitCode::device);
  expect_contains(text, "'huge'");
  expect_contains(text, std::to_string(bytes));
  expect_contains(text, std::to_string(bytes - 1));
  EXPECT_EQ(device->bytes_now(), 0u);
}

// Large tables may be read through texel buffers where they exceed what a storage buffer may hold.
TEST_F(GpuTest, BindsWhatIsTooLargeForAStorageBufferAsTexels) {
  const Limits& limits = device->limits();
  if (limits.max_texel_elements <= limits.max_storage_range / 16 || limits.max_buffer <= limits.max_storage_range)
    GTEST_SKIP() << "texel buffers hold no more than storage buffers on this device";
  const Buffer large(*device, "large", limits.max_storage_range + 16);
  EXPECT_NO_THROW(large.view(Format::rgba32ui));
  const std::string text = error_text([&] { (void)large.storage(); }, ExitCode::device);
  expect_contains(text, "'large'");
  expect_contains(text, "storage buffer range");
}

TEST_F(GpuTest, OutlivesTheDeviceHandle) {
  Buffer values(*device, "values", 400);
  values.upload(counting(100));
  auto other = std::make_unique<Device>(Device::open("auto"));
  Buffer elsewhere(*other, "elsewhere", 400, Memory::staged);
  other.reset();
  elsewhere.upload(counting(100));
  EXPECT_EQ(elsewhere.download<uint32_t>(), values.download<uint32_t>());
}

}  // namespace
}  // namespace meniscal::gpu
