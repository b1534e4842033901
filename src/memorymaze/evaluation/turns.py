"""Which of a route's turns a walk took, in their order."""

from memorymaze.geometry.trajectory import Trajectory
from memorymaze.metrics import turns
from memorymaze.metrics.turns import TurnAtPlace
from memorymaze.sites import Route, Site


def site_turns_taken(site: Site, walk: Trajectory) -> list[TurnAtPlace]:
    """Return the turns of a walk in the site's turning points, in their order.

    See `metrics.turns` for what a turn is.
    """
    places = [(place.id, place.polygon) for place in site.turning_points]
    return turns.turns_taken(places, walk)


def route_turns_in_order(site: Site, route: Route, walk: Trajectory) -> float:
    """Return the share of a route's turns that a walk took, in their order.

    Slight and sharp turns count as left or right. 1 for a route without turns.
    """
    wanted = [
        TurnAtPlace(turn.at, "left" if turn.direction.endswith("left") else "right")
        for turn in route.turns
    ]
    return turns.turns_in_order(wanted, site_turns_taken(site, walk))
