"""Reading English route descriptions: text in, a typed plan out."""

from memorymaze.routes.plan import (
    Arrival,
    Leg,
    Length,
    Mention,
    Outlook,
    Passing,
    RoutePlan,
    Side,
    Turn,
)
from memorymaze.understanding.describing import describe
from memorymaze.understanding.reading import parse_route_description
from memorymaze.understanding.things import (
    ANY_FLOOR,
    floor_phrase,
    is_common,
    is_floor,
)

__all__ = [
    "ANY_FLOOR",
    "Arrival",
    "Leg",
    "Length",
    "Mention",
    "Outlook",
    "Passing",
    "RoutePlan",
    "Side",
    "Turn",
    "describe",
    "floor_phrase",
    "is_common",
    "is_floor",
    "parse_route_description",
]
