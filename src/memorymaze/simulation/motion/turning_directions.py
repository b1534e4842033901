"""Words for ways: which direction an exit lies in, and which exit a word means.

Angles are relative to the way the robot faces, left positive.
"""

import difflib
import math
from collections.abc import Mapping, Sequence

from memorymaze.errors import CommandError
from memorymaze.robot.api import DIRECTIONS, Direction

# Upper end of each sector, degrees to either side.
FORWARD, SLIGHT, SIDE, SHARP = 15, 60, 120, 160

MEANING: Mapping[str, tuple[float, float, float]] = {
    "forward": (-60, 60, 0),
    "slight_left": (10, 75, 40),
    "left": (30, 150, 90),
    "sharp_left": (105, 165, 140),
    "slight_right": (-75, -10, -40),
    "right": (-150, -30, -90),
    "sharp_right": (-165, -105, -140),
}
"""Degrees between which `turn` accepts a way, and where it wants it most."""


def direction_of(angle: float) -> Direction | None:
    """Return the word for a way, or None for one that leads back.

    Straight on up to 15 degrees, slight to 60, left or right to 120, sharp to 160.

    >>> direction_of(math.radians(-40)), direction_of(math.pi)
    ('slight_right', None)
    """
    degrees = abs(math.degrees(angle))
    left = angle > 0
    if degrees <= FORWARD:
        return "forward"
    if degrees <= SLIGHT:
        return "slight_left" if left else "slight_right"
    if degrees <= SIDE:
        return "left" if left else "right"
    if degrees <= SHARP:
        return "sharp_left" if left else "sharp_right"
    return None


def exit_meant(direction: Direction, angles: Sequence[float]) -> int | None:
    """Return the index of the way a word means, or None when none fits.

    The way that carries the word itself comes first; without one, the way nearest to
    the middle of the word's sector within a wider range: `left` finds ways from 30 to
    150 degrees, `forward` the one that bends least up to 60 degrees.
    """
    lowest, highest, middle = MEANING[direction]
    fitting = [
        (direction_of(angle) != direction, abs(math.degrees(angle) - middle), index)
        for index, angle in enumerate(angles)
        if lowest - 1e-6 <= math.degrees(angle) <= highest + 1e-6
        or direction_of(angle) == direction
    ]
    return min(fitting)[2] if fitting else None


def parse_direction(direction: object) -> Direction:
    """Return a direction that the control API knows.

    Raises:
        CommandError: It is none; the message names those there are.
    """
    for known in DIRECTIONS:
        if isinstance(direction, str) and direction == known:
            return known
    close = difflib.get_close_matches(str(direction), DIRECTIONS, n=1)
    hint = f" (did you mean {close[0]!r}?)" if close else ""
    raise CommandError(
        f"turn: expected one of {', '.join(DIRECTIONS)}; got {direction!r}{hint}"
    )
