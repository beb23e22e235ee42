// How far the rendering is, on standard error: standard output is for results.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace meniscal {

enum class ProgressStyle { none, bar, json };

// A bar on a terminal, JSON lines elsewhere or where `--json-progress` asks for them, nothing with `--quiet`.
ProgressStyle progress_style(bool quiet, bool json, bool terminal);

struct ProgressState {
  std::string stage;         // "menisci", "photons": what is being done
  long done = 0, total = 0;  // passes, or any other unit
  double elapsed = 0;        // seconds since the stage began
};

// Seconds that remain if the rest takes as long as what is done; negative while unknown.
double remaining_seconds(const ProgressState& state);

// One line of at most `columns` characters: "photons  [=====>    ]  50 %  8/16  2 s, 2 s to go".
std::string progress_bar(const ProgressState& state, int columns);

// {"stage":"photons","done":8,"total":16,"elapsed_s":2.0,"remaining_s":2.0}; remaining_s is null while unknown.
std::string progress_json(const ProgressState& state);

// Says what it is told, at most ten times a second on a terminal and once a second in JSON lines; first and last of a
// stage always.
class Progress {
 public:
  explicit Progress(ProgressStyle style, std::FILE* stream = stderr);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void begin(const std::string& stage, long total);
  void expect(long total);  // otherwise than at the beginning
  void update(long done);
  void clear();  // wipes a terminal's line for what is said next

 private:
  using Clock = std::chrono::steady_clock;
  void show();

  const ProgressStyle style_;
  std::FILE* const stream_;
  ProgressState state_;
  Clock::time_point begun_, shown_;
};

}  // namespace meniscal
