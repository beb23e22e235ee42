"""Writes glTF 2.0 scenes with all buffers as data URIs. Y up, lengths in metres or a scene's unit. Output depends on the arguments alone."""
import base64
import json
import math
import struct

MM = 1e-3
ASPECT = 4 / 3  # of pictures in perspective
FLOAT, UINT, USHORT = 5126, 5125, 5123
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def rotation(axis, degrees):
    """Quaternion [x, y, z, w] of a rotation about a unit axis, counter-clockwise."""
    half = math.radians(degrees) / 2
    return [a * math.sin(half) for a in axis] + [math.cos(half)]


def look_at(eye, target):
    """Quaternion of a camera or light at `eye` whose -Z looks at `target`: pitch about X, then yaw about Y, no roll."""
    x, y, z = (e - t for e, t in zip(eye, target))
    yaw = math.atan2(x, z) / 2
    pitch = -math.atan2(y, math.hypot(x, z)) / 2
    return [math.cos(yaw) * math.sin(pitch), math.sin(yaw) * math.cos(pitch),
            -math.sin(yaw) * math.sin(pitch), math.cos(yaw) * math.cos(pitch)]


class Scene:
    """Collects materials, meshes, lights and cameras; `write` makes the file."""

    def __init__(self, unit=1, short_indices=False):
        """`unit`: that of all lengths, in metres; `short_indices`: two bytes each where a mesh has few enough vertices."""
        self.unit = unit
        self._short = short_indices
        self._bytes = bytearray()
        self._extensions = set()
        self._gltf = {"nodes": [], "materials": [], "meshes": [], "accessors": [], "bufferViews": []}

    def material(self, name, color=(1, 1, 1), roughness=1, metallic=0, extensions=None, emissive=None, **extras):
        """Returns the material's index. `extensions`: name -> values, `emissive`: radiance, or one for each channel; `extras`:
        custom properties."""
        material = {"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}}
        extensions = dict(extensions or {})
        if emissive is not None:
            strength = max(emissive) if isinstance(emissive, tuple) else emissive
            material["emissiveFactor"] = [r / strength for r in emissive] if isinstance(emissive, tuple) else [1, 1, 1]
            extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
        if extensions:
            material["extensions"] = extensions
            self._extensions.update(extensions)
        if extras:
            material["extras"] = extras
        return self._append("materials", material)

    def mesh(self, name, mesh, material, at=None, **node):
        """Adds a mesh (positions, normals, triangles) and a node with its name; `at`: translation; `node`: rotation, scale."""
        positions, normals, triangles = mesh
        if at is not None:
            node = {"translation": self._metres(at), **node}
        indices = USHORT if self._short and len(positions) < 65535 else UINT
        positions = [self._metres(p) for p in positions]
        primitive = {"attributes": {"POSITION": self._accessor(positions, FLOAT), "NORMAL": self._accessor(normals, FLOAT)},
                     "indices": self._accessor([i for t in triangles for i in t], indices), "material": material}
        self._append("nodes", {"name": name, "mesh": self._append("meshes", {"name": name, "primitives": [primitive]}), **node})

    def light(self, name, kind, intensity, eye, target=(0, 0, 0), **values):
        """A punctual light of `kind` at `eye` that shines towards `target`: lx if directional, else cd."""
        light = {"name": name, "type": kind, "intensity": intensity, **values}
        self._extensions.add("KHR_lights_punctual")
        lights = self._gltf.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append(light)
        self._append("nodes", {"name": name, **self._placed(eye, target),
                               "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})

    def camera(self, eye, target, half_width=None, yfov=None):
        """Orthographic and square with `half_width`, or perspective with `yfov` in degrees."""
        if half_width is not None:
            half_width *= self.unit
            camera = {"type": "orthographic", "orthographic": {"xmag": half_width, "ymag": half_width, "znear": 1e-5, "zfar": 10}}
        else:
            camera = {"type": "perspective",
                      "perspective": {"yfov": math.radians(yfov), "aspectRatio": ASPECT, "znear": 0.001, "zfar": 10}}
        camera["name"] = "camera"
        self._append("nodes", {"name": "camera", "camera": self._append("cameras", camera), **self._placed(eye, target)})

    def write(self, path):
        gltf = {"asset": {"version": "2.0", "generator": "Meniscal tools/scenes/make_scenes.py"},
                "extensionsUsed": sorted(self._extensions), "scene": 0,
                "scenes": [{"name": "scene", "nodes": list(range(len(self._gltf["nodes"])))}], **self._gltf}
        data = base64.b64encode(bytes(self._bytes)).decode("ascii")
        gltf["buffers"] = [{"byteLength": len(self._bytes), "uri": "data:application/octet-stream;base64," + data}]
        with open(path, "w", encoding="ascii", newline="\n") as file:
            json.dump(gltf, file, indent=1)
            file.write("\n")

    def _metres(self, position):
        return [self.unit * c for c in position]

    def _placed(self, eye, target):
        """Properties of a node at `eye` that looks at `target`."""
        return {"translation": self._metres(eye), "rotation": look_at(self._metres(eye), self._metres(target))}

    def _append(self, kind, value):
        items = self._gltf.setdefault(kind, [])
        items.append(value)
        return len(items) - 1

    def _accessor(self, values, component):
        vectors = component == FLOAT
        flat = [c for v in values for c in v] if vectors else values
        packed = struct.pack(f"<{len(flat)}{ {FLOAT: 'f', UINT: 'I', USHORT: 'H'}[component]}", *flat)
        self._bytes += bytes(-len(self._bytes) % 4)
        view = self._append("bufferViews", {"buffer": 0, "byteOffset": len(self._bytes), "byteLength": len(packed),
                                            "target": ARRAY_BUFFER if vectors else ELEMENT_ARRAY_BUFFER})
        self._bytes += packed
        accessor = {"bufferView": view, "componentType": component, "count": len(values),
                    "type": "VEC3" if vectors else "SCALAR"}
        if vectors:
            stored = struct.unpack(f"<{len(flat)}f", packed)  # bounds are those of the rounded numbers
            accessor["min"] = [min(stored[k::3]) for k in range(3)]
            accessor["max"] = [max(stored[k::3]) for k in range(3)]
        return self._append("accessors", accessor)
