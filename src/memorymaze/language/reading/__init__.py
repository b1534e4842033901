"""Reading English route descriptions: text in, a plan out.

Holds the grammar and the words of descriptions (`data`). Does not hold what a plan is
(`plans`), how one walks with it (`agents`) or how texts are made (`writing`).
"""

from memorymaze.language.reading.reading import parse_route_description
from memorymaze.language.reading.things import (
    ANY_FLOOR,
    floor_phrase,
    is_common,
    is_floor,
    kind_of,
    place_on_sign,
)

__all__ = [
    "ANY_FLOOR",
    "floor_phrase",
    "is_common",
    "is_floor",
    "kind_of",
    "parse_route_description",
    "place_on_sign",
]
