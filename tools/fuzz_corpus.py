#!/usr/bin/env python3
"""Writes the seeds of the fuzz targets, small files of every kind they read: tools/fuzz_corpus.py tests/fuzz/corpus"""
import base64
import json
import struct
import sys
import zlib
from pathlib import Path


def png(width, height, colour=2, depth=8):
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    row = b"\0" + bytes(range(1, width * channels * depth // 8 + 1))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(row * height)) + chunk(b"IEND", b""))


# A grey square of 8 x 8 texels.
JPEG = base64.b64decode(
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAP//////////////////////////////////////////////////////////////////////////////////"
    "////wAALCAAIAAgBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAA//EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAIAQEAAD8AN//Z")


def exr(width, height, channels, attributes, compression=0):
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    names = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for n in sorted(channels)) + b"\0"
    header = b"".join([
        attribute("channels", "chlist", names), attribute("compression", "compression", bytes([compression])),
        attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1))] +
        [attribute(name, kind, value) for name, (kind, value) in attributes.items()]) + b"\0"
    lines = 16 if compression == 3 else 1
    start = 8 + len(header) + 8 * -(-height // lines)
    offsets, chunks = b"", b""
    for y in range(0, height, lines):
        rows = min(lines, height - y)
        data = struct.pack(f"<{rows * width * len(channels)}f", *[0.5 + i for i in range(rows * width * len(channels))])
        if compression:
            spread = data[0::2] + data[1::2]
            packed = zlib.compress(bytes([spread[0]]) + bytes(
                (spread[i] - spread[i - 1] + 128) & 255 for i in range(1, len(spread))))
            data = packed if len(packed) < len(data) else data
        offsets += struct.pack("<Q", start + len(chunks))
        chunks += struct.pack("<iI", y, len(data)) + data
    return struct.pack("<II", 20000630, 2) + header + offsets + chunks


def text(value):
    return "string", value.encode()


def glb(document, data):
    document["asset"] = {"version": "2.0"}
    if data:
        document["buffers"] = [{"byteLength": len(data)}]
    body = json.dumps(document, separators=(",", ":")).encode()
    body += b" " * (-len(body) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(body), b"JSON") + body + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def scene(data, views, accessors, primitive, more=None, nodes=None):
    offsets = [sum(views[:i]) for i in range(len(views))]
    document = {
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes or [{"mesh": 0}],
        "bufferViews": [{"buffer": 0, "byteOffset": o, "byteLength": n} for o, n in zip(offsets, views)],
        "accessors": accessors, "meshes": [{"primitives": [primitive]}], **(more or {})}
    return document, data


def vec3(view, count):
    return {"bufferView": view, "componentType": 5126, "count": count, "type": "VEC3"}


def scenes():
    position = {"attributes": {"POSITION": 0}}
    plain = scene(TRIANGLE, [36], [vec3(0, 3)], position)
    yield "triangle.glb", glb(*plain)
    document, data = scene(TRIANGLE, [36], [vec3(0, 3)], position)
    document["asset"] = {"version": "2.0"}
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    document["buffers"] = [{"byteLength": len(data), "uri": uri}]
    yield "triangle.gltf", json.dumps(document).encode()
    cube = struct.pack("<24f", *[c for x in (-1, 1) for y in (-1, 1) for z in (-1, 1) for c in (x, y, z)])
    faces = bytes([0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3])
    indices = {"bufferView": 1, "componentType": 5121, "count": 36, "type": "SCALAR"}
    yield "lit_water.glb", glb(*scene(
        cube + faces, [96, 36], [vec3(0, 8), indices], {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
        {"materials": [{"name": "water", "extras": {"meniscus_liquid": "water", "meniscus_flatten": 1},
                        "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                                       "KHR_materials_ior": {"ior": 1.33},
                                       "KHR_materials_volume": {"attenuationDistance": 1, "attenuationColor": [1, 1, 1]}}}],
         "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.01}}],
         "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
         "extensionsUsed": ["KHR_lights_punctual"]},
        [{"mesh": 0, "children": [1, 2], "rotation": [0, 0, 0, 1]}, {"camera": 0, "translation": [0, 1, 5]},
         {"extensions": {"KHR_lights_punctual": {"light": 0}}, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 9, 0, 1]}]))
    sparse = {"count": 3, "componentType": 5126, "type": "VEC3", "sparse": {
        "count": 2, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}}}
    yield "sparse.glb", glb(*scene(TRIANGLE + struct.pack("<2H6f", 1, 2, 5, 0, 0, 0, 7, 0), [36, 4, 24], [sparse], position))
    shorts = {"bufferView": 0, "componentType": 5122, "count": 4, "type": "VEC3", "normalized": True}
    document, data = scene(
        struct.pack("<16h", 0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0, 9, 9, 9, 0), [32], [shorts],
        {"attributes": {"POSITION": 0}, "mode": 5},
        {"extensionsRequired": ["KHR_mesh_quantization"], "extensionsUsed": ["KHR_mesh_quantization"]})
    document["bufferViews"][0]["byteStride"] = 8
    yield "quantised_strip.glb", glb(document, data)
    coordinates = {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}
    for name, image, kind in (("png", png(2, 2), "image/png"), ("jpeg", JPEG, "image/jpeg")):
        yield f"textured_{name}.glb", glb(*scene(
            TRIANGLE + struct.pack("<6f", 0, 0, 1, 0, 0, 1) + image, [36, 24, len(image)], [vec3(0, 3), coordinates],
            {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0},
            {"images": [{"bufferView": 2, "mimeType": kind}], "samplers": [{"wrapS": 33071}],
             "textures": [{"source": 0, "sampler": 0}],
             "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {
                 "KHR_texture_transform": {"scale": [2, 2], "rotation": 1}}}}, "emissiveFactor": [1, 1, 1]}]}))


def images():
    passes = {"passRange": text("0:1"), "sceneHash": text("00"), "renderTime": ("double", struct.pack("<d", 1))}
    yield "plain.exr", exr(2, 2, ["R", "G", "B"], passes)
    yield "layers.exr", exr(2, 1, ["R", "G", "B", "depth.Z", "variance.R", "variance.G", "variance.B"],
                            {**passes, "passRange": text("0:2,4:6")})
    yield "zip.exr", exr(8, 20, ["Y"], passes, 3)
    yield "rgb.png", png(2, 2)
    yield "grey.png", png(3, 2, 0)
    yield "deep.png", png(2, 2, 6, 16)
    yield "grey.jpg", JPEG


def menisci():
    # A liquid of 9 bytes at most, then solids; see meniscus_fuzz.cpp. 128 is the middle of each range.
    liquid = bytes([0, 2, 60, 0, 0, 0])
    middle = bytes([128, 20, 128, 20, 128, 128, 128, 0, 0])
    post = bytes([2, 5, 128]) + bytes([60, 200, 60, 128, 128, 128, 0, 0, 60])
    yield "post", liquid + post
    yield "leaning", liquid + bytes([2, 3, 128, 60, 200, 60, 128, 128, 128, 40, 30, 200])
    yield "cone_and_post", liquid + bytes([1, 5, 0, 60, 200, 60, 60, 128, 60, 0, 0, 90]) + bytes(
        [2, 1, 128, 80, 200, 60, 200, 128, 180, 0, 9, 10])
    yield "soup", liquid + bytes([0, 5, 9]) + bytes(range(0, 250, 3)) + middle
    yield "closed_liquid", bytes([1, 7, 128, 60, 1, 2, 1]) + post
    yield "touching", liquid + bytes([1, 1, 128, 60, 80, 60, 100, 228, 128, 0, 0, 60]) + bytes(
        [1, 1, 128, 60, 80, 60, 130, 228, 128, 0, 0, 60])
    yield "uneven", bytes([2, 3, 2, 5, 1, 200, 6, 1, 90, 60, 2, 3, 0]) + post


def main():
    root = Path(sys.argv[1])
    for folder, files in (("scene", scenes()), ("image", images()), ("meniscus", menisci())):
        (root / folder).mkdir(parents=True, exist_ok=True)
        for name, data in files:
            (root / folder / name).write_bytes(data)


main()
