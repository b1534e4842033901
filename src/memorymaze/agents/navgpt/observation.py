"""What the model is told of a viewpoint: all round in full, or in a line of history."""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from memorymaze.agents.navgpt.directions import (
    DIRECTION_NAMES,
    compass_degrees,
    relative_words,
    sector_bounds,
    sector_of,
    turn_words,
)
from memorymaze.robot.viewpoints import Panorama, SeenThing, WayOn

SECTORS = len(DIRECTION_NAMES)


@dataclass(frozen=True, slots=True)
class Place:
    """Where the robot is on the graph, and what there is."""

    viewpoint: str
    heading: float
    """Of the way it came, degrees clockwise from north."""
    panorama: Panorama
    ways: tuple[WayOn, ...]


def observation_text(place: Place, *, faithful: bool = False) -> str:
    """Return a full observation: eight directions, the robot's front first.

    For each: its range relative to the robot, what is seen there, things within 3 m, and
    viewpoints one can go to. The eight are fixed to the compass, so the front is centred
    on the robot's heading only to within 22.5 degrees.

    Args:
        place: Where.
        faithful: Whether the released code's faults are kept; see `NavGPTOptions`.
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


def summary_text(place: Place) -> str:
    """Return an observation in two lines: which viewpoint, and what the place is like."""
    return f"{_where(place)}\n{place.panorama.summary}"


def history_line(before: Place, after: Place) -> str:
    """Return a move in short: the turn, the way, where it led, and what is there."""
    turn = relative_words(after.heading, before.heading)
    return (
        f"You turned {turn} degrees, from heading {before.heading:.2f} to "
        f"{after.heading:.2f}, and went from viewpoint {before.viewpoint} to "
        f"{after.viewpoint}. {after.panorama.summary}"
    )


def ways_text(place: Place) -> str:
    """Return the viewpoints one can go to, for a robot that wanted elsewhere."""
    return _listed(place.ways, place) or "none"


def _where(place: Place) -> str:
    return f"You are at viewpoint {place.viewpoint}, heading {place.heading:.2f}."


def _listed(ways: Iterable[WayOn], place: Place) -> str:
    return "; ".join(
        f"{way.viewpoint} ({_relative(way.heading, place)}, {way.distance:.2f} m)"
        for way in ways
    )


def _relative(heading: float, place: Place) -> str:
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
