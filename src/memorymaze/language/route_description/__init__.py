"""Reading English route descriptions: text in, a typed plan out."""

from memorymaze.language.route_description.describing import describe
from memorymaze.language.route_description.floors import (
    ANY_FLOOR,
    floor_phrase,
    is_floor,
)
from memorymaze.language.route_description.parsing import parse_route_description
from memorymaze.language.route_description.plan import (
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
from memorymaze.language.route_description.things import is_common

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
