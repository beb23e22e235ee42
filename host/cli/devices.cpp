// meniscal devices: what `--device` may name.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/cli/commands.h"
#include "host/error.h"
#include "host/passes/fetch_probe.h"

namespace meniscal {
namespace {

std::string api_version(uint32_t packed) {
  return fmt::format("{}.{}.{}", packed >> 22 & 0x7f, packed >> 12 & 0x3ff, packed & 0xfff);
}

// A device, and how the renderer would work on it; or why it cannot be opened.
struct Listed {
  gpu::DeviceInfo info;
  gpu::Limits limits{};
  gpu::Choices choices{};
  std::optional<gpu::FetchSeconds> measured;
  std::string failure;
};

Listed inspect(const gpu::DeviceInfo& info, bool measure) {
  Listed listed{info, {}, {}, {}, {}};
  try {
    const gpu::Device device = gpu::Device::open(std::to_string(info.index));
    listed.limits = device.limits();
    listed.choices = device.choices();
    if (!measure) return listed;
    listed.measured = passes::probe_fetch(device).seconds;
    listed.choices = gpu::choose(info, listed.limits, *listed.measured);
  } catch (const Error& error) {
    listed.failure = error.what();
  }
  return listed;
}

std::string choices_text(const Listed& d) {
  if (!d.failure.empty()) return fmt::format("       cannot be used: {}\n", d.failure);
  std::string text =
      d.choices.texel_elements == 0
          ? "       tables: storage buffers"
          : fmt::format("       tables: texel buffers, over {} elements storage buffers", d.choices.texel_elements);
  if (d.measured)
    text += fmt::format(" (measured: texel {:.2f} ms, storage {:.2f} ms)", 1e3 * d.measured->texel,
                        1e3 * d.measured->storage);
  return text +
         fmt::format(
             "\n       workgroups of {}, subgroups of {}; dispatches of {} s: first {}, at most {} invocations\n",
             gpu::Choices::workgroup, d.limits.subgroup_size, d.choices.batch_seconds, d.choices.first_batch,
             d.choices.largest_batch);
}

std::string table(const std::vector<Listed>& devices) {
  std::string text;
  for (const Listed& d : devices)
    text += fmt::format("{:>5}  {} ({}, {}, Vulkan {})\n{}", d.info.index, d.info.name, d.info.type, d.info.driver,
                        api_version(d.info.api_version), choices_text(d));
  if (devices.empty()) text += "No Vulkan device; install a driver, for example the package mesa-vulkan-drivers.\n";
  return text + "  cpu  reference path: serial, double precision\n";
}

nlohmann::ordered_json as_json(const std::vector<Listed>& devices) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Listed& d : devices) {
    nlohmann::ordered_json& entry = list.emplace_back();
    entry = {{"index", d.info.index},
             {"name", d.info.name},
             {"type", d.info.type},
             {"driver", d.info.driver},
             {"vulkan", api_version(d.info.api_version)}};
    if (!d.failure.empty()) {
      entry["failure"] = d.failure;
      continue;
    }
    entry["choices"] = {{"texel_elements", d.choices.texel_elements}, {"workgroup", gpu::Choices::workgroup},
                        {"subgroup", d.limits.subgroup_size},         {"batch_seconds", d.choices.batch_seconds},
                        {"first_batch", d.choices.first_batch},       {"largest_batch", d.choices.largest_batch}};
    if (d.measured) entry["measured"] = {{"texel_s", d.measured->texel}, {"storage_s", d.measured->storage}};
  }
  return {{"devices", list}};
}

}  // namespace

void add_devices(CLI::App& app) {
  auto json = std::make_shared<bool>(false), measure = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand(
      "devices", "List the Vulkan devices that can render, with the index that --device takes, and how they are used");
  command->add_flag("--json", *json, "Print JSON");
  command->add_flag("--measure", *measure,
                    "Time how each device reads tables, and choose by it; a GPU's rendering does");
  command->footer("Example: meniscal devices");
  command->callback([json, measure] {
    std::vector<Listed> devices;
    for (const gpu::DeviceInfo& info : gpu::list_devices()) devices.push_back(inspect(info, *measure));
    std::fputs((*json ? as_json(devices).dump(2) + "\n" : table(devices)).c_str(), stdout);
  });
}

}  // namespace meniscal
