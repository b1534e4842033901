"""How the words on things face and how large their letters are, roughly.

How they are really painted is a matter of `looks/`; here are its rules of thumb, so
that runs which never draw need none of it.
"""

import math
from functools import lru_cache
from typing import NamedTuple

from memorymaze.simulation.scene import Scene
from memorymaze.sites.records import Door, Landmark

CAPITAL = 0.73
"""Height of a capital letter as a share of the font's size."""
BOARD_DEPTH = 0.15
"""Metres; thinner things are boards that their words fill."""
LARGEST_FIELD = 0.45
"""Metres; words fill no more of a board's height."""
STRIP = 0.12
"""Metres; height of the strip for words on things that are no boards."""
LABEL_HEIGHT = 0.15
"""Metres; of the plate on a door."""
PIXELS_PER_METRE = 300


class Inscription(NamedTuple):
    """What is written on a thing."""

    text: str
    letter_height: float
    """Of capital letters, metres."""
    both_sides: bool
    """Whether it can be read from behind as well."""
    fills_it: bool
    """Whether it is all over the thing, as on a board."""


@lru_cache(maxsize=4096)
def inscription(scene: Scene, geom: int) -> Inscription | None:
    """Return what is written on a door, landmark or thing; None where nothing is."""
    record = scene.objects[geom].record
    if isinstance(record, Door):
        if not record.label:
            return None
        (ax, ay), (bx, by) = [point[:2] for point in record.line.coords]
        room = math.hypot(bx - ax, by - ay) - 0.24
        width = min(0.062 * len(record.label) + 0.08, max(room, 0.3))
        height = _letter_height(record.label, width, LABEL_HEIGHT)
        return Inscription(record.label, height, both_sides=True, fills_it=False)
    text = getattr(record, "text", None)
    if not text:
        return None
    length, depth, tall = record.size  # type: ignore[union-attr]
    is_board = depth <= BOARD_DEPTH
    field = min(tall, LARGEST_FIELD) if is_board else STRIP
    both = not isinstance(record, Landmark) or (
        record.mount == "ceiling" and not _points(text)
    )
    height = _letter_height(text, 0.9 * length, 0.9 * field)
    return Inscription(text, height, both, is_board)


def _points(text: str) -> bool:
    from memorymaze.simulation.senses.signposts import signposts

    return any(post.arrow is not None for post in signposts(text))


def _letter_height(text: str, width: float, height: float) -> float:
    """Return the height of capitals where a text fills a field; metres."""
    # The font is loaded only where somebody reads.
    from memorymaze.simulation.senses.lettering import fitted
    from memorymaze.simulation.senses.signposts import signposts

    posts = signposts(text)
    if width > 2.2 * height:
        width /= len(posts)
    else:
        height /= len(posts)
    sizes = [
        fitted(
            post.words,
            max(1, round(PIXELS_PER_METRE * width * (0.76 if post.arrow else 1.0))),
            max(1, round(PIXELS_PER_METRE * height)),
        ).size
        for post in posts
        if post.words
    ]
    return CAPITAL * min(sizes, default=0) / PIXELS_PER_METRE
