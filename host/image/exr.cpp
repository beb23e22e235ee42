#include "host/image/exr.h"

#include <ImathBox.h>
#include <ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>

#include "host/error.h"
#include "host/image/atomic_file.h"
#include "host/image/exr_guard.h"

namespace meniscal {
namespace {

// A header may claim any size: 2^28 pixels (16k x 16k) is four times what renderings need, and 1 GiB a channel.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;

// How many bytes of pixels a byte of file may stand for, at most: zlib makes 1032 of one, PXR24 a third more; DWA
// keeps one number of 64 before that.
std::uint64_t greatest_expansion(Imf::Compression compression) {
  return compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION ? 1u << 17 : 2048;
}

std::string channel_name(const Layer& layer, const std::string& channel) {
  return layer.name.empty() ? channel : layer.name + "." + channel;
}

Imath::Box2i data_window(const Image& image) {
  return {{image.x0, image.y0}, {image.x0 + image.width - 1, image.y0 + image.height - 1}};
}

// Maps one of a layer's interleaved channels onto the file's data window. OpenEXR wants mutable pixels, but only reads
// them when writing.
Imf::Slice slice(const Layer& layer, std::size_t channel, const Imath::Box2i& window) {
  const std::size_t x_stride = layer.channels.size() * sizeof(float);
  const std::size_t y_stride = x_stride * static_cast<std::size_t>(window.max.x - window.min.x + 1);
  return Imf::Slice::Make(Imf::FLOAT, const_cast<float*>(layer.pixels.data()) + channel, window, x_stride, y_stride);
}

Imf::Header make_header(const Image& image) {
  const int full_width = image.full_width > 0 ? image.full_width : image.width;
  const int full_height = image.full_height > 0 ? image.full_height : image.height;
  Imf::Header header(Imath::Box2i({0, 0}, {full_width - 1, full_height - 1}), data_window(image));
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // OpenEXR's default is Rec. 709 with a D65 white point
  for (const auto& [name, value] : image.text) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, value] : image.numbers) header.insert(name, Imf::DoubleAttribute(value));
  for (const auto& [name, m] : image.matrices)
    header.insert(name, Imf::M44fAttribute(Imath::M44f(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9],
                                                       m[10], m[11], m[12], m[13], m[14], m[15])));
  return header;
}

void require_consistent(const std::string& path, const Image& image) {
  if (image.width <= 0 || image.height <= 0 || image.layers.empty())
    throw Error(ExitCode::failed, fmt::format("{}: the image to write is empty", path));
  for (const Layer& layer : image.layers)
    if (layer.channels.empty() || layer.pixels.size() != image.pixel_count() * layer.channels.size())
      throw Error(ExitCode::failed,
                  fmt::format("{}: layer \"{}\" holds {} numbers, {} x {} pixels of {} channels need others", path,
                              layer.name, layer.pixels.size(), image.width, image.height, layer.channels.size()));
}

void encode(std::ofstream& stream, const std::string& path, const Image& image) {
  Imf::Header header = make_header(image);
  Imf::FrameBuffer frame;
  for (const Layer& layer : image.layers)
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
      const std::string name = channel_name(layer, layer.channels[c]);
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, slice(layer, c, data_window(image)));
    }
  Imf::StdOFStream output(stream, path.c_str());
  Imf::OutputFile file(output, header);
  file.setFrameBuffer(frame);
  file.writePixels(image.height);
}

// Rank of a channel within its layer; OpenEXR itself keeps them by name, that is A, B, G, R.
std::size_t channel_rank(const std::string& channel) {
  static const std::vector<std::string> order{"R", "G", "B", "A", "X", "Y", "Z"};
  return static_cast<std::size_t>(std::find(order.begin(), order.end(), channel) - order.begin());
}

// Splits "layer.sub.R" at its last point and groups the channels, layers in order of first appearance, the beauty
// first.
std::vector<Layer> list_layers(const Imf::ChannelList& channels) {
  std::vector<Layer> layers;
  for (auto i = channels.begin(); i != channels.end(); ++i) {
    if (i.channel().xSampling != 1 || i.channel().ySampling != 1) continue;
    const std::string full = i.name();
    const std::size_t point = full.rfind('.');
    const std::string name = point == std::string::npos ? "" : full.substr(0, point);
    auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    if (layer == layers.end()) layer = layers.insert(name.empty() ? layers.begin() : layers.end(), Layer{name, {}, {}});
    layer->channels.push_back(point == std::string::npos ? full : full.substr(point + 1));
  }
  for (Layer& layer : layers)
    std::stable_sort(layer.channels.begin(), layer.channels.end(),
                     [](const std::string& a, const std::string& b) { return channel_rank(a) < channel_rank(b); });
  return layers;
}

void read_attributes(const Imf::Header& header, Image& image) {
  const Imf::Header defaults;
  for (auto i = header.begin(); i != header.end(); ++i) {
    const std::string name = i.name();
    if (defaults.find(name) != defaults.end() || name == "type" || name == "name") continue;  // the format's own
    const Imf::Attribute* attribute = &i.attribute();
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(attribute)) image.text[name] = text->value();
    if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(attribute))
      image.numbers[name] = number->value();
    if (const auto* number = dynamic_cast<const Imf::FloatAttribute*>(attribute))
      image.numbers[name] = static_cast<double>(number->value());
    if (const auto* number = dynamic_cast<const Imf::IntAttribute*>(attribute)) image.numbers[name] = number->value();
    if (const auto* matrix = dynamic_cast<const Imf::M44fAttribute*>(attribute))
      std::copy_n(matrix->value().getValue(), 16, image.matrices[name].begin());
  }
}

Image read_windows(const Imf::Header& header) {
  const Imath::Box2i data = header.dataWindow(), display = header.displayWindow();
  const std::int64_t width = std::int64_t{data.max.x} - data.min.x + 1,
                     height = std::int64_t{data.max.y} - data.min.y + 1;
  if (width <= 0 || height <= 0 || width > kMaxPixels / height)
    throw std::runtime_error(fmt::format("its data window of {} x {} pixels is beyond what is read", width, height));
  Image image;
  image.width = static_cast<int>(width), image.height = static_cast<int>(height);
  // Image counts from the display window's corner.
  image.x0 = data.min.x - display.min.x, image.y0 = data.min.y - display.min.y;
  image.full_width = display.max.x - display.min.x + 1, image.full_height = display.max.y - display.min.y + 1;
  return image;
}

// Before OpenEXR makes room for pixels: a few bytes of file may claim gigabytes.
void require_plausible(const Imf::Header& header, const Image& image, std::uint64_t file_bytes) {
  std::uint64_t pixel_bytes = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    if (i.channel().xSampling == 1 && i.channel().ySampling == 1) pixel_bytes += i.channel().type == Imf::HALF ? 2 : 4;
  if (image.pixel_count() * pixel_bytes / greatest_expansion(header.compression()) > file_bytes)
    throw std::runtime_error(fmt::format("its header claims {} x {} pixels of {} bytes, which its {} bytes cannot hold",
                                         image.width, image.height, pixel_bytes, file_bytes));
}

Image decode(Imf::MultiPartInputFile& file, std::uint64_t file_bytes) {
  const Imf::Header& header = file.header(0);
  Image image = read_windows(header);
  image.layers = list_layers(header.channels());
  if (image.layers.empty()) throw std::runtime_error("it has no channel at full resolution");
  require_plausible(header, image, file_bytes);
  read_attributes(header, image);
  Imf::FrameBuffer frame;
  const Imath::Box2i window = header.dataWindow();
  for (Layer& layer : image.layers) {
    layer.pixels.resize(image.pixel_count() * layer.channels.size());
    for (std::size_t c = 0; c < layer.channels.size(); ++c)
      frame.insert(channel_name(layer, layer.channels[c]), slice(layer, c, window));
  }
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(frame);
  part.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

void write_exr(const std::string& path, const Image& image) {
  require_consistent(path, image);
  write_file(path, [&](std::ofstream& stream) {
    try {
      encode(stream, path, image);
    } catch (const std::exception& error) {
      // A stream that failed is reported by write_file, with the system's reason; the rest is OpenEXR's own.
      if (stream) throw Error(ExitCode::failed, fmt::format("{}: cannot be written: {}", path, error.what()));
    }
  });
}

Image read_exr(const std::string& path) {
  try {
    const std::uint64_t file_bytes = std::filesystem::file_size(path);
    std::ifstream stream(path, std::ios::binary);
    require_attributes_within(stream, file_bytes);
    Imf::MultiPartInputFile file(path.c_str());
    return decode(file, file_bytes);
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::scene, fmt::format("{}: needs more memory than there is; crop or scale the image", path));
  } catch (const std::exception& error) {
    throw Error(ExitCode::scene,
                fmt::format("{}: not a readable EXR image: {}; check the name and that the file is complete", path,
                            error.what()));
  }
}

Image decode_exr(std::string bytes) {
  Imf::StdISStream stream;
  const std::uint64_t file_bytes = bytes.size();
  std::istringstream plain(std::move(bytes));
  require_attributes_within(plain, file_bytes);
  stream.str(std::move(plain).str());
  Imf::MultiPartInputFile file(stream);
  return decode(file, file_bytes);
}

}  // namespace meniscal
