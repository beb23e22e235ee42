#include "host/passes/fetch_probe.h"

#include <algorithm>

#include "host/gpu/commands.h"
#include "host/passes/batch.h"
#include "shaders/shaders.h"
#include "shaders/shared/structs.h"

namespace meniscal::passes {
namespace {

constexpr std::uint32_t elements = 1u << 16;  // as many as every device can read through a texel buffer
constexpr std::uint32_t invocations = 1u << 14;
constexpr int runs = 3;  // the first compiles

double probe(const gpu::Device& device, const gpu::Buffer& table, bool texel, std::vector<std::uint32_t>& read) {
  const gpu::Buffer sums(device, "fetch probe sums", invocations * sizeof(std::uint32_t));
  const gpu::ComputePass pass(device, "fetch_probe", shader("fetch_probe", texel),
                              {{0, texel ? gpu::Kind::texel : gpu::Kind::storage}, {1, gpu::Kind::storage}},
                              sizeof(shared::ProbePush));
  const gpu::BindingSet buffers = pass.bind({{0, table, gpu::Format::rgba32ui}, {1, sums}});
  gpu::Commands commands(device);
  double least = 0;
  for (int run = 0; run < runs; ++run) {
    commands.dispatch(pass, buffers, shared::ProbePush{elements - 1, invocations}, groups_of_64(invocations));
    commands.submit_and_wait();
    const double seconds = commands.last_submit_seconds();
    if (run == 1 || (run > 1 && seconds < least)) least = seconds;
  }
  read = sums.download<std::uint32_t>();
  return least;
}

}  // namespace

FetchProbe probe_fetch(const gpu::Device& device) {
  std::vector<std::uint32_t> values(4 * elements);
  for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i * 2654435761u;
  gpu::Buffer table(device, "fetch probe", values.size() * sizeof(std::uint32_t));
  table.upload(values);
  FetchProbe result;
  result.seconds.texel = probe(device, table, true, result.texel);
  result.seconds.storage = probe(device, table, false, result.storage);
  return result;
}

void choose_by_measurement(gpu::Device& device) {
  if (device.info().type != "cpu")
    device.set_choices(gpu::choose(device.info(), device.limits(), probe_fetch(device).seconds));
}

}  // namespace meniscal::passes
