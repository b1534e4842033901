"""Reading English route descriptions: text in, a typed plan out."""

from memorymaze.language.route_description.describing import describe
from memorymaze.language.route_description.parsing import parse_route_description
from memorymaze.language.route_description.plan import (
    Arrival,
    Leg,
    Length,
    Mention,
    Passing,
    RoutePlan,
    Side,
    Turn,
)
from memorymaze.language.route_description.things import is_common

__all__ = [
    "Arrival",
    "Leg",
    "Length",
    "Mention",
    "Passing",
    "RoutePlan",
    "Side",
    "Turn",
    "describe",
    "is_common",
    "parse_route_description",
]
