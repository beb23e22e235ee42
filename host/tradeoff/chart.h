// Charts with both axes logarithmic, as SVG that stands in a page.
#pragma once

#include <string>
#include <vector>

namespace meniscal {

// Text as it may stand in HTML and SVG, in attributes, too.
std::string escaped(const std::string& text);

struct Mark {
  double x, y;        // what is not positive and finite is left out
  std::string title;  // shown where the pointer rests
  std::string label;  // beside the mark; may be empty
};

struct Series {
  std::string style;  // CSS class
  std::vector<Mark> marks;
  bool line = false;   // through the marks, in their order
  bool steps = false;  // down in steps, as a front falls
  double radius = 3;   // of the marks, pixels; 0: none
};

struct Chart {
  std::string title, x, y;
  std::vector<Series> series;
  int width = 440, height = 330;  // pixels
};

std::string as_svg(const Chart& chart);

}  // namespace meniscal
