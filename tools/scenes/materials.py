"""Materials of the scenes. Each returns its index; `extras` are custom properties as in README.md."""
WATER = 1.333  # index of refraction


def matte(scene, name, color, **values):
    """Lambertian: a dielectric that reflects nothing at its face. `color`: one for each channel, or a number for all."""
    channels = color if isinstance(color, tuple) else (color,) * 3
    return scene.material(name, channels, extensions={"KHR_materials_specular": {"specularFactor": 0}}, **values)


def clear(scene, name, ior, thickness, volume={}, **extras):
    """Smooth glass or liquid; `volume`: its absorption in glTF's terms, in metres."""
    return scene.material(name, roughness=0, **extras, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": ior},
        "KHR_materials_volume": {"thicknessFactor": thickness * scene.unit, **volume}})


def water(scene, depth, volume={}, **extras):
    return clear(scene, "water", WATER, depth, volume, meniscus_liquid="water", **extras)
