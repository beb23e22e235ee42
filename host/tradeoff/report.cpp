#include "host/tradeoff/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/tradeoff/chart.h"
#include "host/tradeoff/pictures.h"

namespace meniscal {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1400px; margin: 2em auto; padding: 0 1em; color: #1c1c1c; background: #fff }
h1 { font-size: 1.5em } h2 { font-size: 1.2em; margin-top: 2em }
code { font-size: .92em; background: #f0f0ee; padding: .05em .3em }
table { border-collapse: collapse } td, th { padding: .25em .8em; text-align: left; border-bottom: 1px solid #ddd }
td.n { text-align: right; font-variant-numeric: tabular-nums }
.row { display: flex; flex-wrap: wrap; gap: 12px }
figure { margin: 0 } figure img { display: block; width: 320px; image-rendering: pixelated } figcaption { font-size: .85em }
svg { background: #fff } svg text { font: 11px system-ui, sans-serif; fill: #333 } svg text.title { font-size: 13px; font-weight: 600 }
svg .grid { stroke: #e4e4e4 } svg polyline { fill: none; stroke-width: 1.6 }
svg .all circle { fill: #c4c4c4 } svg .front polyline { stroke: #111 } svg .front circle { fill: #111 }
svg .pale polyline { stroke: #aaa; stroke-dasharray: 4 3 }
svg .draft polyline { stroke: #d9730d } svg .draft circle { fill: #d9730d }
svg .preview polyline { stroke: #0b6bcb } svg .preview circle { fill: #0b6bcb }
svg .final polyline { stroke: #0f7b3f } svg .final circle { fill: #0f7b3f }
.draft { color: #d9730d } .preview { color: #0b6bcb } .final { color: #0f7b3f }
.scale { display: inline-block; width: 160px; height: .8em; vertical-align: middle }
)";

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-"; }

Mark mark_of(const Point& p, Clock clock, const Measure& measure, const std::string& label = "") {
  const double seconds = seconds_of(p, clock), error = p.errors.*measure.value;
  return {seconds, error,
          fmt::format("{}: {} s, {} {}", command_line(p.setting), number(seconds), measure.name, number(error)), label};
}

Series front_of(const Report& report, const Measure& measure) {
  Series series{"front", {}, false, true, 3.5};
  for (const std::size_t i : pareto_front(trades_of(report.points, report.clock, measure)))
    series.marks.push_back(mark_of(report.points[i], report.clock, measure));
  return series;
}

Series all_points(const Report& report, const Measure& measure) {
  Series series{"all", {}, false, false, 2.2};
  for (const Point& p : report.points) series.marks.push_back(mark_of(p, report.clock, measure));
  return series;
}

bool is_known(const Report& report, const Measure& measure) {
  return std::any_of(report.points.begin(), report.points.end(),
                     [&](const Point& p) { return std::isfinite(p.errors.*measure.value); });
}

std::string fronts(const Report& report) {
  std::string html;
  for (const Measure& m : measures) {
    if (!is_known(report, m)) continue;
    Chart chart{m.name, name_of(report.clock), m.name, {all_points(report, m), front_of(report, m)}};
    for (const Point& p : report.points)
      if (p.setting.knob == "preset")
        chart.series.push_back({p.setting.preset, {mark_of(p, report.clock, m, p.setting.preset)}, false, false, 5});
    html += as_svg(chart);
  }
  return html;
}

std::vector<std::string> knobs_of(const Sweep& sweep) {
  std::vector<std::string> knobs;
  for (const Curve& c : sweep.curves)
    if (std::find(knobs.begin(), knobs.end(), c.knob) == knobs.end()) knobs.push_back(c.knob);
  return knobs;
}

std::string curves(const Report& report) {
  std::string html;
  for (const std::string& knob : knobs_of(report.sweep)) {
    html += fmt::format("<h3>{}</h3>\n<div class=\"row\">\n", escaped(knob));
    for (const Measure& m : measures) {
      if (!is_known(report, m)) continue;
      Series front = front_of(report, m);
      front.style = "pale", front.radius = 0;
      Chart chart{knob, name_of(report.clock), m.name, {all_points(report, m), front}};
      for (const Curve& c : report.sweep.curves) {
        if (c.knob != knob) continue;
        Series series{c.preset, {}, true, false, 3.5};
        for (std::size_t i = 0; i < c.settings.size(); ++i)
          if (c.settings[i] < report.points.size())
            series.marks.push_back(mark_of(report.points[c.settings[i]], report.clock, m, c.values[i]));
        chart.series.push_back(std::move(series));
      }
      html += as_svg(chart);
    }
    html += "</div>\n";
  }
  return html;
}

std::string advice_table(const Report& report, const Measure& measure) {
  std::string html = fmt::format(
      "<h3>By {}</h3>\n<table>\n<tr><th>preset</th><th>{}</th><th>error</th><th>should be</th><th>{}</th>"
      "<th>error</th><th>preset's error over the front's</th></tr>\n",
      measure.name, name_of(report.clock), name_of(report.clock));
  for (const Advice& a : advice(report.points, report.clock, measure)) {
    const Point &own = report.points[a.preset], &best = report.points[a.best];
    const auto cells = [&](const Point& p) {
      return fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td>", number(seconds_of(p, report.clock)),
                         number(p.errors.*measure.value));
    };
    html += fmt::format(
        "<tr><td class=\"{0}\">{0}</td>{1}<td>{2}</td>{3}<td class=\"n\">{4}</td></tr>\n", own.setting.preset,
        cells(own),
        a.best == a.preset ? "as it is" : fmt::format("<code>{}</code>", escaped(command_line(best.setting))),
        cells(best), number(a.ratio));
  }
  return html + "</table>\n";
}

std::string figure(const std::vector<std::uint8_t>& srgb, const Image& size, const std::string& caption) {
  return fmt::format("<figure><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>\n", escaped(caption),
                     data_uri(srgb, size.width, size.height));
}

std::string colour_scale() {
  std::vector<float> ramp;
  for (int i = 0; i < 64; ++i) ramp.push_back(static_cast<float>(i) / 63);
  return fmt::format("<img class=\"scale\" alt=\"scale of colours\" src=\"{}\">", data_uri(false_colours(ramp), 64, 1));
}

std::string pictures(const Report& report, const Reference& reference) {
  const Image& size = reference.image();
  std::string html = "<div class=\"row\">\n" + figure(reference.srgb(), size, "reference");
  if (reference.caustic_pixels() > 0)
    html += figure(caustic_alone(reference), size, fmt::format("its caustic: {} pixels", reference.caustic_pixels()));
  html += "</div>\n";
  for (const ShownPicture& p : report.pictures) {
    const Point& point = report.points[p.point];
    html +=
        "<div class=\"row\">\n" +
        figure(p.srgb, size, fmt::format("{} ({}): {} s", p.name, p.command, number(seconds_of(point, report.clock)))) +
        figure(false_colours(p.error), size,
               fmt::format("error map of {}: relative RMSE {}", p.name, number(point.errors.image))) +
        figure(false_colours(p.flip), size, fmt::format("FLIP map of {}: mean {}", p.name, number(point.errors.flip))) +
        "</div>\n";
  }
  return html;
}

}  // namespace

std::vector<Advice> advice(const std::vector<Point>& points, Clock clock, const Measure& measure) {
  const std::vector<Trade> trades = trades_of(points, clock, measure);
  const std::vector<std::size_t> front = pareto_front(trades);
  std::vector<Advice> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].setting.knob != "preset") continue;
    const auto best = best_within(trades, front, trades[i].seconds);
    if (!best) continue;
    const double own = trades[i].error, least = trades[*best].error;
    result.push_back({i, *best, own == least ? 1 : own / least});
  }
  return result;
}

std::string as_html(const Report& report, const Reference& reference) {
  const Image& image = reference.image();
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Speed and accuracy: "
      "{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>Speed and accuracy: {0}</h1>\n",
      escaped(report.scene), kStyle);
  html += fmt::format(
      "<p>{} settings at {}x{} pixels on {}, Meniscal {}. Errors are against <code>{}</code>{}. Seconds are {} of "
      "menisci, tables, shaders compiled anew, and all passes; reading the scene and writing the picture are not "
      "counted.</p>\n",
      report.points.size(), image.width, image.height, escaped(report.device), escaped(report.version),
      escaped(report.reference_command),
      report.reference_error >= 0 ? fmt::format(", whose own error is estimated at {}: what is less says little",
                                                number(report.reference_error))
                                  : "",
      report.clock == Clock::cpu ? "CPU seconds, user and system," : "those on the clock, as the device is a GPU,");
  if (report.points.size() < report.sweep.settings.size())
    html += fmt::format("<p><strong>Interrupted: {} of {} settings.</strong></p>\n", report.points.size(),
                        report.sweep.settings.size());
  html +=
      "<h2>The front</h2>\n<p>The line joins the settings that no other beats in both; grey ones are beaten. Rest "
      "the pointer on a point for its options. The same as a table: " +
      escaped(report.csv_name) + ".</p>\n<div class=\"row\">\n" + fronts(report) + "</div>\n";
  html +=
      "<h2>What the presets should be, by this scene</h2>\n<p>The nearest point of the front that takes no more "
      "seconds than the preset.</p>\n";
  for (const Measure& m : measures)
    if (is_known(report, m)) html += advice_table(report, m);
  html += fmt::format(
      "<h2>Pictures</h2>\n<p>{0} Error maps: luminance's difference over the reference's RMS, from {1} to 1, "
      "logarithmic. FLIP maps: from 0 to 1, linear. The caustic is where targeted and caustic photons bring more than "
      "{2} of the brightest.</p>\n",
      colour_scale(), least_shown_error, caustic_part);
  html += pictures(report, reference);
  html +=
      "<h2>Knob by knob</h2>\n<p>Each curve turns one knob of <span class=\"draft\">draft</span>, <span "
      "class=\"preview\">preview</span> or <span class=\"final\">final</span>; dashed: the front of all.</p>\n";
  return html + curves(report) + "</body>\n</html>\n";
}

}  // namespace meniscal
