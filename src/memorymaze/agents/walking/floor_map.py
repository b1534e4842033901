"""What an agent has seen of a building: crossings, ways, things, writing.

A sketch map in the agent's own frame: metres from where it started, the start heading
is 0. Nothing here comes from a site plan.
"""

import heapq
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from statistics import median

from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.reading import ANY_FLOOR, is_floor
from memorymaze.robot.perception.matching import points_elsewhere

Point = tuple[float, float]

ALONG = math.radians(30)
"""What lies within this angle of a way lies along it."""
SURE = 0.8
"""Score from which on a floor is surely the one that was asked for."""
BEYOND_RIM = 1.0
"""Metres beyond the rim of a crossing within which the floor of a way begins."""
SEES_FAR = 6.0
"""Metres; who has seen something so far away sees far."""
AT_CROSSING = 2.5
"""Metres within which a place is at a crossing, whatever other crossings there are."""
USUAL_RIM = 1.2
"""Metres from the middle of a crossing to its rim, before any was measured."""
SURELY_AT, NOT_AT = 2.0, 4.5
"""Metres beyond the rim of a crossing up to which a thing surely is at it, and from which
on it is not."""
NEARER = 1.0
"""Metres by which another crossing has to be nearer for a thing to be there."""
STRIDE = 0.8
"""Metres between two looks."""
LEAST_SIGHT = 4.0
"""Metres that any robot sees."""
LEAST_SEEN, ENOUGH_SEEN = 0.25, 5
"""Share of what stands at walls that is seen however wide the ways are, since some stands
out; and things that have to be seen before one can tell how wide."""
NEAR_WAY, IN_LINE = 4.0, 2.5
"""Metres from the middle of a way within which a thing is on it, and who looks along it
stands."""
ON_LINE = 0.4
"""Metres from a line walked within which a thing lies on neither side of it."""
SAME_THING = 1.5
"""Metres between a thing and the words on it, at most."""
SAME_SIGN, SAME_WIDE_SIGN = 0.6, 1.0
"""Metres from a thing within which words are on it; a wide sign that is half in view is
placed 0.7 m aside."""
_SIGN = re.compile(r"\b(sign|board|signboard|poster|screen)\b")
SAME_EXIT = math.radians(35)
"""Exits of a crossing that differ by less are one."""


@dataclass(frozen=True, slots=True)
class Sighting:
    """A thing that was looked for and seen."""

    phrase: str
    """The words it was looked for with."""
    label: str
    """What the detector calls it."""
    score: float
    place: Point
    """Where it is, about."""
    seen_from: Point
    distance: float
    """Metres from there."""
    track: int
    """Number of the thing; below 0 where its words alone were read."""
    stretch: tuple[int, int]
    """Crossing and exit of the stretch on which it was seen."""
    side: str
    """`left`, `right` or `ahead` of the way the robot went."""
    bearing: float = 0.0
    """Radians from the way the robot faced, left positive."""

    @property
    def is_written(self) -> bool:
        """Whether its words alone were read, and not the thing itself was seen."""
        return self.track < 0

    def is_near(self, other: "Sighting") -> bool:
        """Tell whether another stands where this does."""
        return math.dist(self.place, other.place) <= SAME_THING

    def is_again(self, other: "Sighting") -> bool:
        """Tell whether another look saw the same thing."""
        if self.is_written or other.is_written:
            return self.phrase == other.phrase and self.is_near(other)
        return self.track == other.track


@dataclass
class _View:
    """What one sees along a way from the crossing where it begins."""

    asked: set[str] = field(default_factory=set[str])
    """What was looked for."""
    distances: dict[str, float] = field(default_factory=dict[str, float])
    """Metres to the nearest of what was found, by what was looked for."""
    rim: float = 0.0
    """Metres from who looks to the rim of the crossing."""

    @property
    def floor(self) -> float | None:
        """Metres to the nearest covering that can be told; None without any."""
        return self.distances.get(ANY_FLOOR)

    def has_floor(self, phrase: str) -> bool:
        """Tell whether the covering of the way itself, not of one behind it, fits."""
        floor, found = self.floor, self.distances.get(phrase)
        if floor is None or found is None:
            return False
        return found <= max(floor + 0.6, self.rim + BEYOND_RIM)


@dataclass
class Crossing:
    """A place where one can choose: a turning point, the start, or a dead end."""

    number: int
    """The robot's number of a turning point; 0 for the start; negative for dead ends."""
    place: Point
    exits: list[float] = field(default_factory=list[float])
    """Headings of the ways out, radians; known by their index."""
    closed: set[int] = field(default_factory=set[int])
    """Exits that turned out to lead nowhere."""
    rim: float | None = None
    """Metres from the place to where it was entered or left; None before it is known."""

    def add_exit(self, heading: float) -> int:
        """Note a way out, unless it is noted; return its index."""
        known = self.find_exit(heading)
        if known is None:
            self.exits.append(heading)
            return len(self.exits) - 1
        return known

    def find_exit(self, heading: float) -> int | None:
        """Return the index of the exit nearest to a heading, None when none is near."""
        best, least = None, SAME_EXIT
        for index, each in enumerate(self.exits):
            angle = abs(wrap_angle(each - heading))
            if angle <= least:
                best, least = index, angle
        return best

    def open_exits(self) -> list[tuple[int, float]]:
        """Return the exits that are not closed, with their headings."""
        return [
            (index, each)
            for index, each in enumerate(self.exits)
            if index not in self.closed
        ]


@dataclass(frozen=True, slots=True)
class Stretch:
    """A way walked from one crossing to the next."""

    start: int
    exit: int
    """Index of the exit of the start it leaves by."""
    end: int
    arrival: float
    """Heading in which it arrives, radians."""
    length: float
    asked: frozenset[str]
    """Phrases that were looked for all along it."""


class FloorMap:
    """All crossings, stretches and sightings of one walk."""

    def __init__(self) -> None:
        """Begin with the start alone."""
        self.crossings: dict[int, Crossing] = {0: Crossing(0, (0.0, 0.0), [0.0])}
        self.stretches: dict[tuple[int, int], Stretch] = {}
        self._sightings: dict[str, dict[int, Sighting]] = {}
        self._texts: dict[int, Sighting] = {}
        self._dead_ends = 0
        self.views: dict[tuple[int, int], _View] = {}
        """By crossing and exit."""
        self.metres = 0.0
        """Of ways walked, each counted once."""
        self._seen_beside: float | None = None
        self.farthest = 0.0
        """Metres of the farthest sighting: how far this robot sees."""
        self.refuted: set[int] = set()
        """Tracks of what was found not to be the destination."""

    def new_dead_end(self, place: Point) -> Crossing:
        """Note a place where a way ends."""
        self._dead_ends += 1
        crossing = Crossing(-self._dead_ends, place)
        self.crossings[crossing.number] = crossing
        return crossing

    def is_dead_end(self, crossing: int) -> bool:
        """Tell whether it is a place where a way ends."""
        return crossing < 0

    def add_stretch(self, stretch: Stretch) -> None:
        """Note a way walked, and the way back along it."""
        if (stretch.start, stretch.exit) not in self.stretches:
            self.metres += stretch.length
        self.stretches[stretch.start, stretch.exit] = stretch
        end = self.crossings[stretch.end]
        back = end.add_exit(wrap_angle(stretch.arrival + math.pi))
        heading = self.crossings[stretch.start].exits[stretch.exit]
        self.stretches.setdefault(
            (stretch.end, back),
            Stretch(
                stretch.end,
                back,
                stretch.start,
                wrap_angle(heading + math.pi),
                stretch.length,
                frozenset(),
            ),
        )
        view = self.views.get((stretch.start, stretch.exit))
        if view is not None and view.floor is not None:
            floors = [p for p in view.distances if is_floor(p) and view.has_floor(p)]
            mirrored = self.views.setdefault((stretch.end, back), _View())
            mirrored.asked.update(p for p in view.asked if is_floor(p))
            for phrase in floors:
                mirrored.distances.setdefault(phrase, view.floor)

    def note_view(
        self, crossing: int, exit: int, asked: Iterable[str], seen: Iterable[Sighting]
    ) -> None:
        """Keep what was seen along a way by someone who faces it in its crossing."""
        view = self.views.setdefault((crossing, exit), _View())
        view.asked.update(asked)
        view.rim = self.rim_of(crossing)
        for each in seen:
            if abs(each.bearing) > ALONG or (
                is_floor(each.phrase) and each.score < SURE
            ):
                continue
            known = view.distances.get(each.phrase, math.inf)
            view.distances[each.phrase] = min(known, each.distance)

    def views_from(self, crossing: int) -> list[_View]:
        """Return the views along all ways out of a crossing that were looked along."""
        return [view for (at, _), view in self.views.items() if at == crossing]

    @property
    def usual_rim(self) -> float:
        """Metres from the middle of a crossing of this building to its rim, in the middle."""
        known = [each.rim for each in self.crossings.values() if each.rim is not None]
        return median(known) if known else USUAL_RIM

    @property
    def sees_far(self) -> bool:
        """Whether this robot sees things of other places, too."""
        return self.farthest > SEES_FAR

    @property
    def seen_beside(self) -> float:
        """Share of what stands at the walls of ways that a camera which looks ahead sees.

        It sees 45 degrees to either side, and so far; the walls are about where most of
        what it saw beside itself was.
        """
        if self._seen_beside is None:
            found = (
                each.distance * abs(math.sin(each.bearing)) for each in self.sightings
            )
            asides = sorted(aside for aside in found if aside > ON_LINE)
            walls = asides[3 * len(asides) // 4] if len(asides) >= ENOUGH_SEEN else 0.0
            clear = max(self.farthest, LEAST_SIGHT) * math.sqrt(0.5) - walls
            self._seen_beside = min(max(clear, LEAST_SEEN), 1.0)
        return self._seen_beside

    def rim_of(self, crossing: int | None) -> float:
        """Return the metres from a crossing to its rim, as far as one can tell."""
        if crossing is None or crossing <= 0:
            return 0.0
        known = self.crossings[crossing].rim
        return self.usual_rim if known is None else known

    def nearness(self, place: Point, crossing_place: Point, rim: float) -> float:
        """Return how surely a thing stands at a crossing, from 0 to 1.

        Who sees far has seen things of other places, too.
        """
        distance = math.dist(place, crossing_place)
        if self.sees_far:
            return float(distance <= AT_CROSSING)
        if any(
            math.dist(place, other.place) < distance - NEARER
            for other in self.crossings.values()
        ):
            return 0.0
        return min(max((rim + NOT_AT - distance) / (NOT_AT - SURELY_AT), 0.0), 1.0)

    def crossing_near(self, place: Point) -> int | None:
        """Return the crossing that a place is at; None where it is at none."""
        nearest = min(
            self.crossings.values(), key=lambda each: math.dist(each.place, place)
        )
        near = math.dist(nearest.place, place) <= AT_CROSSING
        return nearest.number if near else None

    def note(self, sighting: Sighting) -> None:
        """Keep a sighting; of one thing the one from nearest counts."""
        self.farthest = max(self.farthest, sighting.distance)
        self._seen_beside = None
        known = self._sightings.setdefault(sighting.phrase, {})
        for each in [*known.values()]:
            if each.is_written and each.is_near(sighting):
                del known[each.track]
        _keep_nearest(known, sighting)

    def note_written(self, sighting: Sighting) -> bool:
        """Keep that words looked for were read; False where the thing itself was seen.

        Letters are read from farther away than things are seen.
        """
        known = self._sightings.setdefault(sighting.phrase, {})
        if any(s.is_near(sighting) and not s.is_written for s in known.values()):
            return False
        _keep_nearest(known, sighting)
        return True

    def note_text(self, text: Sighting) -> None:
        """Keep what was read, its words as phrase and label; from nearest it counts."""
        _keep_nearest(self._texts, text)

    @property
    def sightings(self) -> list[Sighting]:
        """Everything seen; a thing that fits several phrases once for each of them."""
        return [each for seen in self._sightings.values() for each in seen.values()]

    @property
    def texts(self) -> list[Sighting]:
        """Everything that was read."""
        return list(self._texts.values())

    def seen(self, phrase: str) -> list[Sighting]:
        """Return everything seen for a phrase, each thing once."""
        return list(self._sightings.get(phrase, {}).values())

    def seen_ahead(self, phrase: str, crossing: int, heading: float) -> list[Sighting]:
        """Return what was seen for a phrase along a way out of a crossing, beyond it.

        By someone who stood in line with that way.
        """
        place = self.crossings[crossing].place
        found: list[Sighting] = []
        for each in self.seen(phrase):
            along, aside = along_and_aside(each.place, place, heading)
            if (
                along <= AT_CROSSING
                or aside > math.tan(ALONG) * along
                or aside > NEAR_WAY
            ):
                continue
            from_along, from_aside = along_and_aside(each.seen_from, place, heading)
            if from_along < along and from_aside <= IN_LINE:
                found.append(each)
        return found

    def ways_out(self) -> Iterator[tuple[int, int]]:
        """Yield all ways that are not closed, as crossing and exit."""
        for number, crossing in self.crossings.items():
            for exit, _ in crossing.open_exits():
                yield number, exit

    def distances_from(self, start: int) -> dict[int, float]:
        """Return the metres along walked stretches from one crossing to all others."""
        return {number: cost for number, (cost, _) in self._paths(start).items()}

    def path(self, start: int, goal: int) -> list[Stretch] | None:
        """Return the shortest way between two crossings along walked stretches."""
        paths = self._paths(start)
        if goal not in paths:
            return None
        way: list[Stretch] = []
        stretch = paths[goal][1]
        while stretch is not None:
            way.append(stretch)
            stretch = paths[stretch.start][1]
        return way[::-1]

    def _paths(self, start: int) -> dict[int, tuple[float, Stretch | None]]:
        by_start: dict[int, list[Stretch]] = {}
        for stretch in self.stretches.values():
            by_start.setdefault(stretch.start, []).append(stretch)
        best: dict[int, tuple[float, Stretch | None]] = {start: (0.0, None)}
        queue = [(0.0, start)]
        while queue:
            cost, at = heapq.heappop(queue)
            if cost > best[at][0]:
                continue
            for stretch in by_start.get(at, ()):
                total = cost + stretch.length
                if total < best.get(stretch.end, (math.inf, None))[0]:
                    best[stretch.end] = (total, stretch)
                    heapq.heappush(queue, (total, stretch.end))
        return best


def _keep_nearest(seen: dict[int, Sighting], sighting: Sighting) -> None:
    known = seen.get(sighting.track)
    if known is None or sighting.distance < known.distance:
        seen[sighting.track] = sighting


def is_sign(words: str) -> bool:
    """Tell whether a label is one of a sign."""
    return _SIGN.search(words) is not None


def is_on_a_pointer(sighting: Sighting, texts: Iterable[Sighting]) -> bool:
    """Tell whether it is a sign on which words were read that point elsewhere."""
    reach = SAME_WIDE_SIGN if is_sign(sighting.label) else SAME_SIGN
    return any(
        math.dist(text.place, sighting.place) <= reach and points_elsewhere(text.phrase)
        for text in texts
    )


def distance_to_line(point: Point, line: Sequence[Point]) -> float:
    """Return the distance from a point to a line of straight pieces, metres."""
    best = min(math.dist(point, corner) for corner in line)
    for (ax, ay), (bx, by) in pairwise(line):
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        if square == 0.0:
            continue
        along = ((point[0] - ax) * dx + (point[1] - ay) * dy) / square
        if 0.0 < along < 1.0:
            foot = (ax + along * dx, ay + along * dy)
            best = min(best, math.dist(point, foot))
    return best


def side_of_line(point: Point, line: Sequence[Point]) -> str:
    """Return on which side of a line walked a point lies, `ahead` where it is on it."""
    (ax, ay), (bx, by) = min(
        pairwise(line), key=lambda piece: distance_to_line(point, piece)
    )
    dx, dy = bx - ax, by - ay
    aside = dx * (point[1] - ay) - dy * (point[0] - ax)
    if abs(aside) <= ON_LINE * math.hypot(dx, dy):
        return "ahead"
    return "left" if aside > 0 else "right"


def along_and_aside(point: Point, origin: Point, heading: float) -> tuple[float, float]:
    """Return how far along a heading, and how far beside it, a point lies, metres."""
    dx, dy = point[0] - origin[0], point[1] - origin[1]
    cos, sin = math.cos(heading), math.sin(heading)
    return dx * cos + dy * sin, abs(dy * cos - dx * sin)


def metres_along(place: Point, start: Point, end: Point) -> float:
    """Return how far along a straight piece a place lies, metres."""
    length = math.dist(start, end)
    if length == 0.0:
        return 0.0
    dx, dy = end[0] - start[0], end[1] - start[1]
    along = ((place[0] - start[0]) * dx + (place[1] - start[1]) * dy) / length
    return min(max(along, 0.0), length)
