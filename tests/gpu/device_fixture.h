// What tests on a device share. They skip where there is no driver, but not on CI, where one is installed for them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>

#include "host/error.h"
#include "host/gpu/device.h"

namespace meniscal::gpu {

inline bool on_ci() { return std::getenv("CI") != nullptr; }

#define REQUIRE_DEVICE()                                                                                     \
  if (meniscal::gpu::list_devices().empty()) {                                                               \
    if (meniscal::gpu::on_ci()) FAIL() << "no Vulkan device on CI: mesa-vulkan-drivers should be installed"; \
    GTEST_SKIP() << "no Vulkan device: install mesa-vulkan-drivers to run this test";                        \
  }

inline std::string error_text(const std::function<void()>& action, ExitCode code) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code, code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

inline void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is missing in: " << text;
}

inline std::vector<uint32_t> counting(size_t n) {
  std::vector<uint32_t> values(n);
  std::iota(values.begin(), values.end(), 0u);
  return values;
}

// A device with validation, which must have had nothing to say by the test's end.
class GpuTest : public testing::Test {
 protected:
  void SetUp() override {
    REQUIRE_DEVICE();
    device = std::make_unique<Device>(Device::open("auto", true));
  }
  void TearDown() override {
    if (!device) return;
    for (const auto& message : device->validation_messages()) ADD_FAILURE() << message;
  }
  std::unique_ptr<Device> device;
};

}  // namespace meniscal::gpu
