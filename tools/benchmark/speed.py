"""CPU seconds and errors at the settings that people use, and what POV-Ray takes for errors as small."""
import povray
from tables import Table, count, percent, seconds

SETTINGS = ("--quality draft", "--quality final")
POVRAY_COUNTS = ((1000000, False), (10000000, True))  # photons; whether pixels are antialiased, which pays with many photons alone


def measure(cases, repeats, with_povray):
    table = Table("scene", "renderer and settings", "CPU s", "ring %", "pixel %", "flux", "CPU seconds against Meniscal's", words=2)
    for case in cases:
        ours = []
        for settings in SETTINGS:
            cost, errors = case.render(*settings.split(), repeats=repeats)
            ours.append((cost, errors, settings))
            table.row(case.name, f"`{settings}`", *numbers(cost, errors), "")
        for photons, antialias in POVRAY_COUNTS if with_povray else ():
            cost, image = povray.render(case.name, photons, case.folder, antialias, repeats)
            errors = case.scorer.score(image)
            table.row(case.name, f"POV-Ray, {count(photons)} photons", *numbers(cost, errors), against(cost, errors, ours))


def numbers(cost, errors):
    return seconds(cost), percent(errors["ring"]), percent(errors["pixel"]), f"{errors['flux']:.4f}"


def against(cost, errors, ours):
    """The ratio to the cheapest of our pictures that is at least as good in both errors."""
    as_good = [o for o in ours if all(o[1][e] <= errors[e] for e in ("ring", "pixel"))]
    if not as_good:
        return "none as good"
    cheapest, _, settings = min(as_good, key=lambda o: o[0])
    return f"{cost / cheapest:.1f} times `{settings}`"
