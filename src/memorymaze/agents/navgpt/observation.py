"""What the model is told: the viewpoint in full or in a line, and its earlier steps.

Directions are compass degrees in eight sectors, left and right.
"""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.robot.api.viewpoints import Panorama, SeenThing, WayOn

LONGEST_FAILURE = 400
"""Characters of a reply that could not be used; the rest is not shown again."""


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
    """Return a heading in degrees clockwise from north, in [0, 360)."""
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
    """Return where a sector begins and ends, seen by a robot."""
    middle = sector * SECTOR_WIDTH - heading
    return (
        _wrapped(middle - SECTOR_WIDTH / 2),
        _wrapped(middle + SECTOR_WIDTH / 2),
    )


def relative_words(degrees: float, heading: float) -> str:
    """Return where a compass heading lies from another: `left 12.00`, `right 3.50`."""
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


@dataclass(frozen=True, slots=True)
class ObservedPlace:
    """Where the robot is on the graph, and what there is."""

    viewpoint: str
    heading: float
    """Of the way it came, degrees clockwise from north."""
    panorama: Panorama
    ways: tuple[WayOn, ...]


def observation_text(place: ObservedPlace, *, faithful: bool = False) -> str:
    """Return a full observation: eight directions, the robot's front first.

    For each: its range relative to the robot, what is seen there, things within 3 m, and
    viewpoints one can go to. The eight are fixed to the compass, so the front is centred
    on the robot's heading only to within 22.5 degrees.
    """
    front = sector_of(place.heading) or 0
    order = [(front + turn) % SECTORS for turn in range(SECTORS)]
    things = [place.panorama.outlooks[sector].things for sector in order]
    named = _one_of_each(things) if faithful else _numbered(things)
    lines = [_where(place)]
    for name, sector, seen in zip(DIRECTION_NAMES, order, named, strict=True):
        first, last = sector_bounds(sector, place.heading)
        ways = [
            way
            for way in place.ways
            if sector_of(compass_degrees(way.heading), faithful=faithful) == sector
        ]
        objects = [
            f"{called} ({_relative(thing.heading, place)}, {thing.distance:.2f} m)"
            for called, thing in seen
        ]
        lines += [
            f"{name}, from {turn_words(first)} to {turn_words(last)}:",
            f"  View: {place.panorama.outlooks[sector].scene}",
            f"  Objects within 3 m: {'; '.join(objects) or 'none'}",
            f"  Viewpoints: {_listed(ways, place) or 'none'}",
        ]
    return "\n".join(lines)


def summary_text(place: ObservedPlace) -> str:
    """Return an observation in two lines: which viewpoint, and what the place is like."""
    return f"{_where(place)}\n{place.panorama.summary}"


def history_line(before: ObservedPlace, after: ObservedPlace) -> str:
    """Return a move in short: the turn, the way, where it led, and what is there."""
    turn = relative_words(after.heading, before.heading)
    return (
        f"You turned {turn} degrees, from heading {before.heading:.2f} to "
        f"{after.heading:.2f}, and went from viewpoint {before.viewpoint} to "
        f"{after.viewpoint}. {after.panorama.summary}"
    )


def ways_text(place: ObservedPlace) -> str:
    """Return the viewpoints one can go to, for a robot that wanted elsewhere."""
    return _listed(place.ways, place) or "none"


def _where(place: ObservedPlace) -> str:
    return f"You are at viewpoint {place.viewpoint}, heading {place.heading:.2f}."


def _listed(ways: Iterable[WayOn], place: ObservedPlace) -> str:
    return "; ".join(
        f"{way.viewpoint} ({_relative(way.heading, place)}, {way.distance:.2f} m)"
        for way in ways
    )


def _relative(heading: float, place: ObservedPlace) -> str:
    return relative_words(compass_degrees(heading), place.heading)


_Named = list[tuple[str, SeenThing]]


def _numbered(things: Sequence[Sequence[SeenThing]]) -> list[_Named]:
    """Name things; those of one name are numbered through all directions."""
    counts = Counter(thing.name for seen in things for thing in seen)
    met: Counter[str] = Counter()
    named: list[_Named] = []
    for seen in things:
        row: _Named = []
        for thing in seen:
            met[thing.name] += 1
            number = f" {met[thing.name]}" if counts[thing.name] > 1 else ""
            row.append((thing.name + number, thing))
        named.append(row)
    return named


def _one_of_each(things: Sequence[Sequence[SeenThing]]) -> list[_Named]:
    """Name things; of one name in a direction only the nearest."""
    return [
        list({thing.name: thing for thing in reversed(seen)}.items()) for seen in things
    ]


@dataclass(frozen=True, slots=True)
class _Step:
    said: str
    """The model's words."""
    told: str
    """What came of them."""
    short: str | None = None
    """What stays of `told` after the next move; None for all of it."""


class Scratchpad:
    """The steps of one episode.

    Only the observation of the place where the robot is now is told in full.
    """

    def __init__(self, limit: int, *, whole_steps: bool = True) -> None:
        """Begin without steps."""
        self._limit = limit
        self._whole_steps = whole_steps
        self._steps: list[_Step] = []

    def add_move(self, said: str, observation: str, short: str) -> None:
        """Add a move that was made; earlier ones are told in short from now on."""
        self._steps.append(_Step(said.strip(), observation, short))

    def add_failure(self, said: str, told: str) -> None:
        """Add a reply that led nowhere."""
        said = said.strip()
        if len(said) > LONGEST_FAILURE:
            said = said[:LONGEST_FAILURE].rstrip() + " …"
        self._steps.append(_Step(said, told))

    def text(self) -> str:
        """Return what is shown: the last characters of all steps."""
        steps = list(self._steps)
        here = next((step for step in reversed(steps) if step.short), None)
        whole = _written(steps, here)
        while self._whole_steps and len(steps) > 1 and len(whole) > self._limit:
            del steps[1 if steps[0] is here else 0]
            whole = _written(steps, here)
        return whole[-self._limit :]


def _written(steps: list[_Step], here: _Step | None) -> str:
    told = [each.told if each is here else each.short or each.told for each in steps]
    return "\n".join(
        f"{step.said}\nObservation: {each}\n"
        for step, each in zip(steps, told, strict=True)
    )
