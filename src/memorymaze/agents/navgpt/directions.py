"""Directions as NavGPT tells them: compass degrees, eight sectors, left and right."""

import math

from memorymaze.geometry.pose import wrap_angle

DIRECTION_NAMES = (
    "Front",
    "Front Right",
    "Right",
    "Rear Right",
    "Rear",
    "Rear Left",
    "Left",
    "Front Left",
)
"""Relative to the robot, in the order in which they are told: clockwise."""

SECTORS = len(DIRECTION_NAMES)
SECTOR_WIDTH = 360.0 / SECTORS
ALMOST_NORTH = 1e-6
"""Radians; a heading so little short of a full circle is 0."""


def compass_degrees(heading: float) -> float:
    """Return a heading in degrees clockwise from north, in [0, 360).

    Args:
        heading: Radians counter-clockwise from east.

    >>> compass_degrees(0.0)
    90.0
    >>> compass_degrees(math.pi / 2 + 1e-9)
    0.0
    """
    clockwise = (math.pi / 2 - heading) % (2 * math.pi)
    if 2 * math.pi - clockwise < ALMOST_NORTH:
        return 0.0
    return math.degrees(clockwise)


def sector_of(degrees: float, *, faithful: bool = False) -> int | None:
    """Return the sector of a compass heading, 0 (north) to 7, clockwise.

    The released code does not close the circle: from 337.5 degrees on it finds a ninth
    sector, which is never told. `faithful` keeps that.

    >>> sector_of(359.999)
    0
    >>> sector_of(359.999, faithful=True) is None
    True
    """
    sector = math.floor((degrees + SECTOR_WIDTH / 2) / SECTOR_WIDTH)
    if faithful:
        return sector if 0 <= sector < SECTORS else None
    return sector % SECTORS


def sector_bounds(sector: int, heading: float) -> tuple[float, float]:
    """Return where a sector begins and ends, seen by a robot.

    Args:
        sector: 0 to 7.
        heading: The robot's, degrees clockwise from north.

    Returns:
        Degrees clockwise from the robot's heading, in (-180, 180].
    """
    middle = sector * SECTOR_WIDTH - heading
    return (
        _wrapped(middle - SECTOR_WIDTH / 2),
        _wrapped(middle + SECTOR_WIDTH / 2),
    )


def relative_words(degrees: float, heading: float) -> str:
    """Return where a compass heading lies from another: `left 12.00`, `right 3.50`.

    Args:
        degrees: Clockwise from north.
        heading: The robot's, degrees clockwise from north.
    """
    return turn_words(_wrapped(degrees - heading))


def turn_words(degrees: float) -> str:
    """Return an angle in words, clockwise positive: `left 12.00`, `right 3.50`.

    >>> turn_words(-0.001)
    'right 0.00'
    """
    side = "left" if round(degrees, 2) < 0 else "right"
    return f"{side} {abs(degrees):.2f}"


def _wrapped(degrees: float) -> float:
    return math.degrees(wrap_angle(math.radians(degrees)))
