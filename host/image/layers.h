// A picture in memory: named layers of floating-point channels and what the header says of them.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace meniscal {

struct Layer {
  std::string name;  // "" is the beauty
  std::vector<std::string>
      channels;               // {"R", "G", "B"}, {"Z"}, ...; the file's channel is "layer.R", or "R" in the beauty
  std::vector<float> pixels;  // interleaved, row by row, the top row first: width * height * channels.size()
};

// Pixel windows as in OpenEXR: the data window is what is stored, the display window what the camera sees. A crop
// stores less.
struct Image {
  int width = 0, height = 0;            // data window
  int x0 = 0, y0 = 0;                   // its upper left pixel in the display window
  int full_width = 0, full_height = 0;  // display window, upper left pixel 0, 0; 0: as the data window

  std::vector<Layer> layers;

  // Header attributes, by name.
  std::map<std::string, std::string> text;
  std::map<std::string, double> numbers;
  std::map<std::string, std::array<float, 16>> matrices;  // OpenEXR's M44f: row vectors, v' = v M, row by row

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

  // The layer of that name, or null.
  const Layer* find(const std::string& name) const {
    for (const Layer& layer : layers)
      if (layer.name == name) return &layer;
    return nullptr;
  }
};

}  // namespace meniscal
