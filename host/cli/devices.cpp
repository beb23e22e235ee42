// meniscal devices: what `--device` may name.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.h"
#include "host/gpu/device.h"

namespace meniscal {
namespace {

std::string api_version(uint32_t packed) {
  return fmt::format("{}.{}.{}", packed >> 22 & 0x7f, packed >> 12 & 0x3ff, packed & 0xfff);
}

std::string table(const std::vector<gpu::DeviceInfo>& devices) {
  std::string text;
  for (const gpu::DeviceInfo& d : devices)
    text +=
        fmt::format("{:>5}  {} ({}, {}, Vulkan {})\n", d.index, d.name, d.type, d.driver, api_version(d.api_version));
  if (devices.empty()) text += "No Vulkan device; install a driver, for example the package mesa-vulkan-drivers.\n";
  return text + "  cpu  reference path: serial, double precision\n";
}

nlohmann::ordered_json as_json(const std::vector<gpu::DeviceInfo>& devices) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const gpu::DeviceInfo& d : devices)
    list.push_back({{"index", d.index},
                    {"name", d.name},
                    {"type", d.type},
                    {"driver", d.driver},
                    {"vulkan", api_version(d.api_version)}});
  return {{"devices", list}};
}

}  // namespace

void add_devices(CLI::App& app) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("devices", "List the Vulkan devices that can render, with the index that --device takes");
  command->add_flag("--json", *json, "Print JSON");
  command->footer("Example: meniscal devices");
  command->callback([json] {
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
    std::fputs((*json ? as_json(devices).dump(2) + "\n" : table(devices)).c_str(), stdout);
  });
}

}  // namespace meniscal
