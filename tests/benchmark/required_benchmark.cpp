// What a scene without a feature of the plan saves: CPU seconds of each pair of tests/support/feature_pairs.h, from the
// loaded scene to the last pass, shaders compiled anew. Prints a table in Markdown.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "host/cpu_seconds.h"
#include "tests/support/feature_pairs.h"

namespace meniscal::bench {
namespace {

constexpr std::uint32_t passes = 4;

double cpu_seconds_of_run(test::FeatureScene made) {
  made.options.resolution = Resolution{200, 200};
  made.options.photons = 200000;
  if (made.options.highlight_samples.value_or(0) > 0) made.options.highlight_samples = 16;
  return cpu_seconds_of([&] { test::run_feature(std::move(made), "auto", passes); });
}

// Other processes on the machine only ever add: the least of `runs` counts.
void measure(int runs) {
  std::printf("| feature | with it, CPU s | without it | saved | |\n|---|---:|---:|---:|---:|\n");
  for (const test::FeaturePair& pair : test::feature_pairs()) {
    double with = 1e9, without = 1e9;
    for (int i = 0; i < runs; ++i) {
      with = std::min(with, cpu_seconds_of_run(pair.make(true)));
      without = std::min(without, cpu_seconds_of_run(pair.make(false)));
    }
    std::printf("| %s | %.2f | %.2f | %.2f | %.0f %% |\n", pair.feature.c_str(), with, without, with - without,
                100 * (with - without) / with);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace meniscal::bench

int main(int argc, char** argv) {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // before a driver is loaded
  meniscal::bench::measure(argc > 1 ? std::max(std::atoi(argv[1]), 1) : 5);
}
