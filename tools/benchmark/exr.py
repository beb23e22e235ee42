"""Reads what `meniscal` writes: OpenEXR scan lines of 32-bit floats, ZIP-compressed or not."""
import struct
import zlib

import numpy

LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
FLOAT = 2


def read(path):
    """The image's channels: name -> array of height x width."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630 or version & 0xFFFFFF00:
        raise ValueError(f"{path}: no single-part scan-line OpenEXR file; render it with meniscal")
    header, at = read_header(data, 8)
    compression = header["compression"][0]
    channels = read_channels(header["channels"])
    if compression not in LINES_PER_BLOCK or any(kind != FLOAT for _, kind in channels):
        raise ValueError(f"{path}: compression {compression}, or channels that are not 32-bit float, are not read here")
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES_PER_BLOCK[compression]
    image = numpy.empty((height, len(channels), width), "<f4")
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        block = image[y - y0:y - y0 + lines]
        packed = data[offset + 8:offset + 8 + size]
        block[...] = numpy.frombuffer(packed if size == block.nbytes else unzip(packed), "<f4").reshape(block.shape)
    return {name: image[:, i].astype(float) for i, (name, _) in enumerate(channels)}


def read_header(data, at):
    """Attributes, name -> bytes, and where the table of offsets begins."""
    header = {}
    while data[at]:
        name, kind, rest = data[at:at + 600].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        header[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    return header, at + 1


def read_channels(listed):
    """(name, pixel type) in the order of the file."""
    channels = []
    while listed[0]:
        name, listed = listed.split(b"\0", 1)
        channels.append((name.decode(), struct.unpack_from("<i", listed)[0]))
        listed = listed[16:]
    return channels


def unzip(packed):
    """OpenEXR stores the even bytes, then the odd ones, each as the difference from the last, plus 128."""
    stored = numpy.frombuffer(zlib.decompress(packed), numpy.uint8).copy()
    stored[1:] -= 128
    stored = numpy.cumsum(stored, dtype=numpy.uint8)
    raw, half = numpy.empty_like(stored), (len(stored) + 1) // 2
    raw[0::2], raw[1::2] = stored[:half], stored[half:]
    return raw.tobytes()
