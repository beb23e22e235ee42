# blender -b --python-exit-code 1 --python blender.py -- FILE EXPECTED: imports an exported scene; what EXPECTED (JSON) says must be there.
import json
import math
import sys

import bpy
import numpy

if "bool" not in numpy.__dict__:
    numpy.bool = bool  # Blender 3.4's importer uses the name that numpy 1.24 dropped

file, expected = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=file)


def surface(mesh):
    """Triangles by material, and how far the steepest normal is from Blender's up, in whole degrees."""
    mesh.calc_normals_split()
    names = [material.name for material in mesh.materials]
    counts = {name: 0 for name in names}
    for polygon in mesh.polygons:
        counts[names[polygon.material_index]] += 1
    steepest = min(loop.normal.z for loop in mesh.loops)
    return {"triangles": counts, "custom normals": mesh.has_custom_normals,
            "steepest": round(math.degrees(math.acos(max(-1.0, min(1.0, steepest)))))}


found = {o.name: surface(o.data) if o.type == "MESH" else {"type": o.type} for o in bpy.data.objects}
found["targets"] = sorted(m.name for m in bpy.data.materials if m.get("meniscus_target") == 1)
print(json.dumps(found, indent=1))
for name, value in json.loads(expected).items():
    if found.get(name) != value:
        sys.exit(f"{name}: expected {value}, found {found.get(name)}")
