"""How far ahead the robot may drive without coming into people's way."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from memorymaze.simulation.motion.wheeled_base import ROBOT_RADIUS
from memorymaze.simulation.obstacles.crowd import Crowd
from memorymaze.simulation.obstacles.person import Person

LANE_STEP = 0.2
"""Metres between the places of a lane that are looked at."""
KEPT = 0.2
"""Metres kept between the robot's shell and people, while it goes towards them."""
STAND_OFF = 0.6
"""Metres before the first place too close at which the robot halts; from nearer it
could not go round."""
FORESIGHT = 1.6
"""Seconds ahead to which people's motion is foretold."""
MOMENT = 0.2
"""Seconds between the moments looked at."""
LEAST_SPEED = 0.4
"""Speed in metres per second for which a robot looks ahead that stands."""
REACH = 4.5
"""Metres around the robot within which people are looked at."""
STANDING = 0.15
"""Speed in metres per second below which a person stands."""


class Hindrance(NamedTuple):
    """Somebody the robot would come too close to if it drove on."""

    person: Person
    ahead: float
    """Metres the robot may still drive."""


def find_hindrance(
    crowd: Crowd, places: Sequence[tuple[float, float, float]], speed: float
) -> Hindrance | None:
    """Return the first person in the way, foretelling everyone's motion.

    People are taken to keep their velocity for a while; those behind the robot are
    left to keep away themselves.

    Args:
        crowd: Who there is.
        places: Where the robot will be, `LANE_STEP` apart, from where it is now:
            x, y in metres and heading in radians.
        speed: Of the robot now, metres per second.
    """
    x, y, _ = places[0]
    first: Hindrance | None = None
    pace = max(speed, LEAST_SPEED)
    for person in crowd.near(x, y, REACH):
        limit = ROBOT_RADIUS + person.radius + KEPT
        ahead = _conflict(person, places, pace, limit)
        if ahead is not None and (first is None or ahead < first.ahead):
            first = Hindrance(person, ahead)
    return first


def _conflict(
    person: Person,
    places: Sequence[tuple[float, float, float]],
    pace: float,
    limit: float,
) -> float | None:
    """Return the metres to drive to the first place that comes too close."""
    last = len(places) - 1
    found: float | None = None
    for moment in range(round(FORESIGHT / MOMENT) + 1):
        later = moment * MOMENT
        number = round(pace * later / LANE_STEP)
        if number > last:
            break
        x, y, heading = places[number]
        dx, dy = person.x + person.vx * later - x, person.y + person.vy * later - y
        if dx * dx + dy * dy >= limit * limit:
            continue
        if dx * math.cos(heading) + dy * math.sin(heading) <= 0:
            continue
        found = max(0.0, (number - 1) * LANE_STEP - STAND_OFF)
        break
    return found
