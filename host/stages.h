// Stages of the host that ran, and their wall-clock seconds: none of one that did not.
#pragma once

#include <map>
#include <string>
#include <type_traits>

#include "host/stopwatch.h"

namespace meniscal {

class Stages {
 public:
  void add(const std::string& stage, double seconds) { seconds_[stage] += seconds; }
  void add(const Stages& others) {
    for (const auto& [stage, seconds] : others.seconds_) add(stage, seconds);
  }
  // What `work` returns; it was the stage.
  template <class Work>
  auto run(const std::string& stage, const Work& work) {
    const Stopwatch watch;
    if constexpr (std::is_void_v<decltype(work())>) {
      work();
      add(stage, watch.seconds());
    } else {
      auto result = work();
      add(stage, watch.seconds());
      return result;
    }
  }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace meniscal
