"""The log of a walk in words, as a language model is told of it: one line a place.

What was seen stands at the way along which it was seen, with metres from the place and
the side of one who goes that way.
"""

import math
from collections.abc import Iterable, Iterator
from operator import itemgetter

from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting
from memorymaze.basics.geometry.pose import wrap_angle

DOOR = "door"
"""Looked for along every way, whatever the text tells."""
IN_THE_WAY = 0.7
"""Metres beside the line of a way within which a thing lies ahead."""
SURE_FIT = 0.8
"""Score of a detection from which on it is told without the score."""
_DIRECTIONS = ((15, "ahead"), (60, "slight {}"), (120, "{}"), (160, "sharp {}"))
"""Degrees up to which an angle has a name; as the control API names directions."""


def direction_words(angle: float) -> str:
    """Name an angle, radians, left positive.

    >>> direction_words(math.radians(-40)), direction_words(math.pi)
    ('slight right', 'back')
    """
    side = "left" if angle > 0 else "right"
    degrees = abs(math.degrees(angle))
    return next((n.format(side) for most, n in _DIRECTIONS if degrees <= most), "back")


def way_name(exit: int) -> str:
    """Name a way out of a place: A for the first, and so on."""
    return chr(ord("A") + exit)


class WalkLog:
    """What a model is told of a walk: the places on the map, and the steps so far."""

    def __init__(self, floor: FloorMap, *, any_heading: bool = False) -> None:
        """Tell of a map, which the walk goes on drawing.

        Of the start it is told where the robot may face any way there.
        """
        self._floor = floor
        self._start = "the start" + ", facing any way" * any_heading
        self._headings: dict[int, float] = {}
        self._steps: list[str] = []

    def arrive(self, number: int, heading: float, *, again: bool = False) -> None:
        """Note by which heading a place was come to: its ways are told from it.

        Coming again by a known way turns round nothing that was told.
        """
        if not again or number not in self._headings:
            self._headings[number] = heading

    @property
    def numbers(self) -> tuple[int, ...]:
        """The places that are told of."""
        return tuple(self._headings)

    def add_step(self, words: str) -> None:
        """Add what was decided."""
        self._steps.append(" ".join(words.split()))

    def add_outcome(self, words: str) -> None:
        """Add what came of the last step."""
        self._steps[-1] += f" {words}."

    @property
    def steps(self) -> str:
        """What was decided and what came of it, one line each."""
        lines = (f"{number}. {step}" for number, step in enumerate(self._steps, 1))
        return "\n".join(lines) or "(none yet)"

    @property
    def places(self) -> str:
        """All places that were come to, one line each, as they were met."""
        return "\n".join(map(self._place_line, self._headings))

    def angle(self, number: int, exit: int) -> float:
        """Return how far one turns into a way who has come to the place, radians."""
        heading = self._floor.crossings[number].exits[exit]
        return wrap_angle(heading - self._headings[number])

    def way_words(self, number: int, exit: int) -> str:
        """Name a way with its direction, in degrees too where another shares the word."""
        words = direction_words(self.angle(number, exit))
        others = (
            direction_words(self.angle(number, other))
            for other in range(len(self._floor.crossings[number].exits))
            if other != exit
        )
        if words in others:
            words += f" {math.degrees(self.angle(number, exit)):+.0f}°"
        return f"{way_name(exit)} {words}"

    def _place_line(self, number: int) -> str:
        crossing = self._floor.crossings[number]
        angles = {exit: self.angle(number, exit) for exit in range(len(crossing.exits))}
        from_left = sorted(angles, key=lambda exit: -angles[exit])
        # The way back is last, to whichever side it lies.
        from_left.sort(key=lambda exit: direction_words(angles[exit]) == "back")
        ways = "; ".join(self._way(crossing, exit) for exit in from_left)
        return f"Place {number} ({self._kind(crossing)}): {ways or 'no way out'}."

    def _kind(self, crossing: Crossing) -> str:
        if crossing.number == next(iter(self._headings)):
            return self._start
        if crossing.number > 0:
            return "turning point"
        return "halt on the way" if len(crossing.exits) > 1 else "end of the way"

    def _way(self, crossing: Crossing, exit: int) -> str:
        key = crossing.number, exit
        stretch = self._floor.stretches.get(key)
        if exit in crossing.closed:
            state = "no way through"
        elif stretch is None:
            state = "not tried"
        else:
            # It was walked to the rim of the next place; the middle lies farther on.
            end = self._floor.crossings[stretch.end].place
            metres = max(stretch.length, math.dist(crossing.place, end))
            state = f"leads to place {stretch.end}, {metres:.0f} m"
        seen = seen_along(self._floor, *key)
        return f"{self.way_words(*key)}, {state}" + (f": {seen}" if seen else "")


def seen_along(floor: FloorMap, number: int, exit: int) -> str:
    """Say what was seen and read along a way out of a place, side by side.

    Doors and other things of one kind share their word: `left door 3, 7 m`.
    """
    sides: dict[str, dict[str, list[str]]] = {"left": {}, "right": {}, "ahead": {}}
    told = sorted(_told_along(floor, number, exit), key=itemgetter(0))
    for metres, side, words in told:
        at = sides[side].setdefault(words, [])
        # One sign may be read as two, on a door and beside it.
        if not (words.startswith('"') and str(metres) in at):
            at.append(str(metres))
    return " | ".join(
        f"{side} "
        + ", ".join(f"{words} {', '.join(at)} m" for words, at in things.items())
        for side, things in sides.items()
        if things
    )


def _told_along(
    floor: FloorMap, number: int, exit: int
) -> Iterator[tuple[int, str, str]]:
    """Yield how far along a way what was seen lies, on which side, and its name."""
    things: dict[int, list[Sighting]] = {}
    for each in floor.sightings:
        things.setdefault(each.track, []).append(each)
    nearest = [
        (min(each, key=lambda sighting: sighting.distance), _thing_words(each))
        for each in things.values()
    ]
    nearest += [(each, f'"{each.label}"') for each in floor.texts]
    crossing = floor.crossings[number]
    heading = crossing.exits[exit]
    for sighting, words in nearest:
        if sighting.stretch != (number, exit):
            continue
        dx = sighting.place[0] - crossing.place[0]
        dy = sighting.place[1] - crossing.place[1]
        along = dx * math.cos(heading) + dy * math.sin(heading)
        beside = dy * math.cos(heading) - dx * math.sin(heading)
        side = "left" if beside > 0 else "right"
        if abs(beside) < IN_THE_WAY:
            side = "ahead"
        yield max(round(along), 0), side, words


def _thing_words(sightings: Iterable[Sighting]) -> str:
    """Name a thing as the detector does, and in brackets what asked for it fits.

    >>> seen = Sighting("red sofa", "sofa", 0.6, (0, 0), (0, 0), 1.0, 1, (0, 0), "left")
    >>> _thing_words([seen])
    'sofa [red sofa? 0.6]'
    """
    fits: list[str] = []
    label = ""
    for each in sightings:
        label = each.label
        if each.phrase not in {each.label, DOOR}:
            doubt = "" if each.score >= SURE_FIT else f"? {each.score:.1f}"
            fits.append(each.phrase + doubt)
    return f"{label} [{'; '.join(fits)}]" if fits else label
