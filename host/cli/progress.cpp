#include "host/cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace meniscal {
namespace {

std::string duration(double seconds) {
  const auto s = static_cast<long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

double fraction(const ProgressState& state) {
  return state.total > 0 ? std::clamp(static_cast<double>(state.done) / static_cast<double>(state.total), 0.0, 1.0) : 0;
}

int terminal_columns(std::FILE* stream) {
  winsize size{};
  return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressStyle progress_style(bool quiet, bool json, bool terminal) {
  if (quiet) return ProgressStyle::none;
  return json || !terminal ? ProgressStyle::json : ProgressStyle::bar;
}

double remaining_seconds(const ProgressState& state) {
  const double f = fraction(state);
  return f > 0 ? state.elapsed * (1 - f) / f : -1;
}

std::string progress_bar(const ProgressState& state, int columns) {
  const double f = fraction(state), remaining = remaining_seconds(state);
  std::string figures =
      fmt::format("{:3.0f} %  {}/{}  {}", std::floor(100 * f), state.done, state.total, duration(state.elapsed));
  if (remaining >= 0 && f < 1) figures += ", " + duration(remaining) + " to go";
  const std::string head = fmt::format("{:<8} ", state.stage);
  const int width =
      std::min(40, columns - static_cast<int>(head.size() + figures.size()) - 5);  // brackets, gap, the cursor's column
  std::string line = head;
  if (width >= 4) {
    const auto filled = static_cast<std::size_t>(f * width), size = static_cast<std::size_t>(width);
    std::string bar(filled, '=');
    if (filled < size) bar += '>';
    bar.resize(size, ' ');
    line += "[" + bar + "]  ";
  }
  line += figures;
  return line.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

std::string progress_json(const ProgressState& state) {
  nlohmann::ordered_json line{
      {"stage", state.stage}, {"done", state.done}, {"total", state.total}, {"elapsed_s", state.elapsed}};
  const double remaining = remaining_seconds(state);
  line["remaining_s"] = remaining >= 0 ? nlohmann::ordered_json(remaining) : nlohmann::ordered_json();
  return line.dump();
}

Progress::Progress(ProgressStyle style, std::FILE* stream) : style_(style), stream_(stream) {}

// Leaves a clean line for what is said next.
Progress::~Progress() { clear(); }

void Progress::begin(const std::string& stage, long total) {
  state_ = {stage, 0, total, 0};
  begun_ = Clock::now();
  show();
}

void Progress::expect(long total) { state_.total = total; }

void Progress::update(long done) {
  state_.done = done;
  const auto interval = style_ == ProgressStyle::bar ? std::chrono::milliseconds(100) : std::chrono::seconds(1);
  if ((done >= state_.total && state_.total > 0) || Clock::now() - shown_ >= interval) show();
}

void Progress::show() {
  shown_ = Clock::now();
  state_.elapsed = std::chrono::duration<double>(shown_ - begun_).count();
  if (style_ == ProgressStyle::none) return;
  if (style_ == ProgressStyle::json)
    fmt::print(stream_, "{}\n", progress_json(state_));
  else
    fmt::print(stream_, "\r{}\033[K", progress_bar(state_, terminal_columns(stream_)));
  std::fflush(stream_);
}

void Progress::clear() {
  if (style_ != ProgressStyle::bar || state_.stage.empty()) return;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
}

}  // namespace meniscal
