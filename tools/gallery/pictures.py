"""What the gallery shows: rows of its sheet, in order. Data alone; to add a picture, add an entry."""
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Picture:
    """A rendering of scenes/SCENE.gltf."""
    name: str     # of its files
    caption: str
    scene: str
    options: tuple = ()                         # of `meniscal render`
    liquid: dict = field(default_factory=dict)  # properties of all liquids, instead of the scene's
    window: tuple = (0, 0, 1, 1)                # the part that is shown: left, top, right, bottom in the camera's view


@dataclass(frozen=True)
class Difference:
    """How two tone-mapped pictures of the gallery differ: grey where they agree."""
    name: str
    caption: str
    of: tuple
    amplification: int


PAPER = ("--meniscus", "paper")
SPIDER = (0.27, 0.33, 0.69, 0.75)  # the middle of the collection


def profile(name, caption):
    return Picture(f"profile_{name}", caption, "collection", PAPER, {"meniscus_profile": name}, SPIDER)


ROWS = [
    [
        Picture("collection", "Figure 11: a vase, a spider, a heart, a bird and an umbrella in slightly wavy water", "collection"),
        Picture("teapot", "Figure 8: a teapot half under water. Handle and spout throw caustics", "teapot"),
    ],
    [
        Picture("shadow_sausage", "Figure 2: the shadow of a tilted rod, broken by the light of its meniscus", "shadow_sausage"),
        Picture("shadow_sausage_level", "The same without menisci", "shadow_sausage", ("--meniscus", "none")),
        Picture("paper_clip", "Figure 9: a floating paper clip. Its inner bend does not touch the water", "paper_clip"),
        Picture("curled_hair", "Figure 10: a curled hair floats, and touches the water in places", "curled_hair"),
    ],
    [
        profile("sine", "Figure 12: four profiles of the paper's meniscus. Sine"),
        profile("exponential", "Exponential"),
        profile("circular", "Circular"),
        profile("bessel", "Bessel"),
    ],
    [
        Picture("displaced", "Figure 13: menisci raised", "collection", PAPER, window=SPIDER),
        Picture("flattened", "Level, with the normals of raised menisci", "collection", PAPER, {"meniscus_flatten": 1}, SPIDER),
        Difference("flattened_difference", "The difference of both pictures, four times as strong", ("displaced", "flattened"), 4),
    ],
    [
        Picture("two_rods", "The light of two leaning rods meets", "two_rods"),
        Picture("rod_end", "The end of a tilted rod at the water: its caustic closes in cusps", "rod_end"),
        Picture("glass_of_water", "A glass of water", "glass_of_water"),
        Picture("hair_three_liquids", "A hair in water, ethanol and olive oil", "hair_three_liquids"),
    ],
]
