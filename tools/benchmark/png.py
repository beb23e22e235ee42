"""Writes PNG pictures."""
import struct
import zlib

import numpy


def display(radiance, white):
    """8-bit sRGB of channels x height x width, `white` shown as white."""
    linear = numpy.clip(numpy.moveaxis(radiance, 0, 2) / white, 0, 1)
    encoded = numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return numpy.round(255 * encoded).astype(numpy.uint8)


def write(path, pixels):
    """Of height x width x 3, 8 bits."""
    height, width, _ = pixels.shape
    lines = numpy.hstack([numpy.zeros((height, 1), numpy.uint8), pixels.reshape(height, 3 * width)])  # every line stored as it is

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(lines.tobytes(), 9)) + chunk(b"IEND", b""))
