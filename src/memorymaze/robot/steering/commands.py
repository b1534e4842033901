"""What the arguments of calls mean: words for ways, distances, angles and speeds.

Angles are relative to the way the robot faces, left positive.
"""

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np

from memorymaze.basics.errors import CommandError, did_you_mean
from memorymaze.basics.input_files import LONGEST_SHOWN
from memorymaze.robot.api.control import DIRECTIONS, Direction
from memorymaze.robot.steering.settings import TICK, RobotSettings

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
    """Return a direction that the control API knows."""
    for known in DIRECTIONS:
        if isinstance(direction, str) and direction == known:
            return known
    raise CommandError(
        f"turn: expected one of {', '.join(DIRECTIONS)}; got {_told(direction)}"
        f"{did_you_mean(direction, DIRECTIONS)}"
    )


def words_to_look_for(words: object) -> str:
    """Return words that name a thing, and refuse what is no text or an empty one."""
    if isinstance(words, str) and words.strip():
        return words
    raise CommandError(
        "detect_from_RGB_image: expected what to look for in a few words, "
        f"got {_told(words)}"
    )


def metres_ahead(call: str, distance: object) -> float:
    """Return a distance to drive, as the call of this name takes it."""
    metres = _finite(distance)
    if metres is not None and metres > 0:
        return metres
    raise CommandError(
        f"{call}: expected a distance in metres greater than 0, got {_told(distance)}"
    )


def seconds_to_stand(seconds: object) -> float:
    """Return a time to stand still."""
    number = _finite(seconds)
    if number is not None and number >= 0:
        return number
    raise CommandError(f"wait: expected 0 or more seconds, got {_told(seconds)}")


def radians_to_turn(angle: object) -> float:
    """Return an angle to turn by."""
    radians = _finite(angle)
    # A full turn in whole steps may be a rounding error more.
    if radians is not None and 0 < abs(radians) <= 2 * math.pi + 1e-9:
        return radians
    raise CommandError(
        "rotate: expected an angle in radians, left positive, not 0 and at most a "
        f"full turn (2 pi), got {_told(angle)}"
    )


def degrees_to_turn(degrees: object) -> float:
    """Return the radians of an angle that `turn_by` is given, 0 among them.

    Raises:
        CommandError: It is none.
    """
    number = _finite(degrees)
    if number is not None and abs(number) <= 360:
        return math.radians(number)
    raise CommandError(
        "turn_by: expected an angle in degrees, left positive, from -360 to 360, "
        f"got {_told(degrees)}"
    )


def check_speeds(settings: RobotSettings, asked: Mapping[str, object]) -> None:
    """Refuse `speed`, `turn_rate` and `seconds` that the robot cannot drive by."""
    bounds = {
        "speed": (-settings.max_speed, settings.max_speed),
        "turn_rate": (-settings.max_turn_rate, settings.max_turn_rate),
        "seconds": (TICK, math.inf),
    }
    for name, value in asked.items():
        lowest, highest = bounds[name]
        number = _finite(value)
        # Speeds often come as 32-bit numbers, which are a rounding error off.
        slack = 0.0 if math.isinf(highest) else 1e-6 * highest
        if number is None or not lowest - slack <= number <= highest + slack:
            raise CommandError(
                f"drive: expected {name} from {lowest} to {highest}, got {_told(value)}"
            )


def _finite(value: object) -> float | None:
    # bool is an int to Python, but no measure.
    if isinstance(value, int | float | np.number) and not isinstance(value, bool):
        with suppress(OverflowError):
            number = float(value)
            return number if math.isfinite(number) else None
    return None


def _told(value: object) -> str:
    """Return what came, cut to a length that fits a message, whatever it is."""
    try:
        text = repr(value)
    except Exception:
        text = f"one {type(value).__name__}"
    return text if len(text) <= LONGEST_SHOWN else f"{text[:LONGEST_SHOWN]}…"
