"""The benchmark's scenes in POV-Ray 3.7, whose photon map can be aimed at an object as ours is: the same mesh with the same normals, an
orthographic camera below the surface, parallel light."""
import os
import shutil

import numpy

import depression
from process import least_cpu_seconds
from score import SIDE

MM = 1e-3
BRIGHTEST = 60  # relative irradiance that white stands for in a 16-bit picture: caustics reach 12, noisy estimates more
# Of water at normal incidence, 4 n / (n + 1)^2, by which the picture is scaled; at the steepest part of the depression it is 1 % less.
TRANSMITTANCE = 4 * 1.333 / 2.333 ** 2


def program():
    return shutil.which("povray")


def mesh2(mesh, *modifiers):
    """Of (positions, normals, triangles) in metres. Millimetres, for POV-Ray's absolute epsilons; its left-handed axes
    mirror the picture, which is symmetric."""
    positions, normals, triangles = mesh

    def vectors(values, scale):
        return f"{{ {len(values)}, " + ", ".join(f"<{v[0] * scale:.9g},{v[1] * scale:.9g},{v[2] * scale:.9g}>" for v in values) + " }"

    faces = f"{{ {len(triangles)}, " + ", ".join("<%d,%d,%d>" % t for t in triangles) + " }"
    return "\n".join(["mesh2 {", "vertex_vectors " + vectors(positions, 1 / MM), "normal_vectors " + vectors(normals, 1),
                      "face_indices " + faces, *modifiers, "}"])


def scene(name, photons):
    """Text of a scene. A diffuse surface of `diffuse 1` shows the irradiance itself; a light of 1/BRIGHTEST keeps it below white."""
    parts = depression.SCENES[name]()
    half_width = parts.half_width / MM
    matte = "texture { pigment { rgb 1 } finish { ambient 0 diffuse 1 } }"
    water = "interior { ior 1.333 }"
    clear = "texture { pigment { rgbf 1 } finish { ambient 0 diffuse 0 } }"
    return "\n".join([
        "#version 3.7;",
        f"global_settings {{ assumed_gamma 1 max_trace_level 8 photons {{ count {photons} }} }}",
        f"camera {{ orthographic location <0,-4,0> direction <0,-1,0> right <{2 * half_width},0,0> up <0,0,{2 * half_width}> }}",
        f"light_source {{ <0,100,0> rgb {1 / BRIGHTEST} parallel point_at <0,0,0> photons {{ refraction on reflection off }} }}",
        mesh2(parts.floor, matte, "photons { collect on }"),
        mesh2(parts.post, matte),
        mesh2(parts.rest, clear, water, "photons { pass_through }"),
        mesh2(parts.meniscus, clear, water, "photons { target refraction on reflection off collect off }"), ""])


def read_ppm(path):
    """16-bit PPM as an array of height x width, mean of the channels, white 1."""
    with open(path, "rb") as file:
        data = file.read()
    fields, at = [], 0
    while len(fields) < 4:
        end = at
        while not data[end:end + 1].isspace():
            end += 1
        if data[at:at + 1] == b"#":
            at = data.index(b"\n", at) + 1
            continue
        if end > at:
            fields.append(data[at:end])
        at = end + 1
    width, height, white = map(int, fields[1:])
    if fields[0] != b"P6" or white != 65535:
        raise ValueError(f"{path}: no 16-bit PPM; is this POV-Ray 3.7?")
    return numpy.frombuffer(data, ">u2", width * height * 3, at).reshape(height, width, 3).mean(2) / white


def render(name, photons, folder, antialias=True, repeats=1):
    """CPU seconds, the least of several runs, and the irradiance relative to a horizontal plane's."""
    source, picture = (os.path.join(folder, f"{name}_povray.{ending}") for ending in ("pov", "ppm"))
    with open(source, "w", encoding="ascii") as file:
        file.write(scene(name, photons))
    seconds = least_cpu_seconds([program(), f"+I{source}", f"+O{picture}", f"+W{SIDE}", f"+H{SIDE}", "+FP16", "File_Gamma=1", "Dither=off",
                           "-D", *(["+A0.0", "+AM1", "+R3", "-J"] if antialias else ["-A"]), "Verbose=off"], repeats)
    return seconds, read_ppm(picture) * BRIGHTEST * TRANSMITTANCE
