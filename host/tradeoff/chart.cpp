#include "host/tradeoff/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscal {
namespace {

constexpr double kLeft = 62, kRight = 18, kTop = 30, kBottom = 46;

bool is_shown(double value) { return value > 0 && std::isfinite(value); }
bool is_shown(const Mark& m) { return is_shown(m.x) && is_shown(m.y); }

// One logarithmic axis, on the screen from `from` to `to`.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  double from = 0, to = 1;

  void hold(double value) { low = std::min(low, value), high = std::max(high, value); }
  // Room at both ends; also where there is but one value, or none.
  void finish() {
    if (high == 0) low = high = 1;
    const double room = std::max(std::pow(high / low, 0.06), 1.15);
    low /= room, high *= room;
  }
  double at(double value) const { return from + (to - from) * std::log(value / low) / std::log(high / low); }

  // 1, 2 and 5 times powers of ten, or less of them where they would crowd.
  std::vector<double> ticks() const {
    const double decades = std::log10(high / low);
    std::vector<double> values;
    for (int e = static_cast<int>(std::floor(std::log10(low))); std::pow(10, e) <= high; ++e)
      for (const int digit : {1, 2, 5}) {
        const double value = digit * std::pow(10, e);
        if ((digit == 1 || decades < 2.5) && value >= low && value <= high) values.push_back(value);
      }
    return values;
  }
};

std::string line(double x0, double y0, double x1, double y1, const char* style) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", style, x0, y0, x1,
                     y1);
}

std::string text(double x, double y, const char* anchor, const std::string& content, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, more,
                     escaped(content));
}

std::string frame(const Chart& chart, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double v : x.ticks())
    svg +=
        line(x.at(v), y.from, x.at(v), y.to, "grid") + text(x.at(v), y.from + 15, "middle", fmt::format("{:.4g}", v));
  for (const double v : y.ticks())
    svg +=
        line(x.from, y.at(v), x.to, y.at(v), "grid") + text(x.from - 6, y.at(v) + 4, "end", fmt::format("{:.4g}", v));
  const double middle = (y.from + y.to) / 2;
  svg += text((x.from + x.to) / 2, y.from + 34, "middle", chart.x);
  svg += text(14, middle, "middle", chart.y, fmt::format(" transform=\"rotate(-90 14 {:.1f})\"", middle));
  svg += text((x.from + x.to) / 2, 18, "middle", chart.title, " class=\"title\"");
  return svg;
}

std::string path(const Series& series, const Axis& x, const Axis& y) {
  std::string points;
  double before = 0;
  for (const Mark& m : series.marks) {
    if (!is_shown(m)) continue;
    if (series.steps && !points.empty()) points += fmt::format(" {:.1f},{:.1f}", x.at(m.x), before);
    before = y.at(m.y);
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", x.at(m.x), before);
  }
  return fmt::format("<polyline points=\"{}\"/>", points);
}

std::string drawn(const Series& series, const Axis& x, const Axis& y) {
  std::string svg = fmt::format("<g class=\"{}\">", escaped(series.style));
  if (series.line || series.steps) svg += path(series, x, y);
  for (const Mark& m : series.marks) {
    if (!is_shown(m)) continue;
    if (series.radius > 0)
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}</title></circle>", x.at(m.x),
                         y.at(m.y), series.radius, escaped(m.title));
    if (!m.label.empty()) svg += text(x.at(m.x) + 6, y.at(m.y) - 5, "start", m.label);
  }
  return svg + "</g>\n";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string as_svg(const Chart& chart) {
  Axis x, y;
  for (const Series& s : chart.series)
    for (const Mark& m : s.marks)
      if (is_shown(m)) x.hold(m.x), y.hold(m.y);
  x.finish(), y.finish();
  x.from = kLeft, x.to = chart.width - kRight;
  y.from = chart.height - kBottom, y.to = kTop;
  std::string svg =
      fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n",
                  chart.width, chart.height);
  svg += frame(chart, x, y) + "\n";
  for (const Series& s : chart.series) svg += drawn(s, x, y);
  return svg + "</svg>\n";
}

}  // namespace meniscal
