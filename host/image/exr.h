// OpenEXR files: 32-bit float, ZIP-compressed scan lines, one channel per layer and component.
#pragma once

#include <string>

#include "host/image/layers.h"

namespace meniscal {

// Writes all layers and attributes, with Rec. 709 primaries as the chromaticities. The same image gives the same bytes.
// Throws Error(ExitCode::failed) where the file cannot be written (see write_file) or the image contradicts itself.
void write_exr(const std::string& path, const Image& image);

// Reads the first part of any scan-line or tiled file, half and unsigned integers turned into float. Subsampled
// channels are left out. Channels come in the order R, G, B, A, then X, Y, Z, then by name. Throws
// Error(ExitCode::scene) where it is not a readable image.
Image read_exr(const std::string& path);

// The same from a file's bytes. Throws std::exception that says why it is not readable.
Image decode_exr(std::string bytes);

}  // namespace meniscal
