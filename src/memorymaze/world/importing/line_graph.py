"""Centre lines as a graph: where they meet or bend, and the straight ways between.

Knows nothing of floors but the lines; what is made of them is in `ways.py`.
"""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import shapely
from shapely import LineString, MultiLineString, Point, STRtree
from shapely.ops import linemerge

from memorymaze.basics.geometry.points import XY
from memorymaze.basics.geometry.pose import heading_to, turn_between
from memorymaze.world.importing.imported import CentreLine

_SourceOf = Callable[[XY, XY], CentreLine]
"""Which line a step is part of."""

BEND = math.radians(15)
"""Where a line bends more, one changes direction."""
SNAP = 0.3
"""Metres between the end of a line and another line that it is meant to meet."""
WOBBLE = 0.1
"""Metres by which a drawn line strays from what it means."""
SPUR = 0.75
"""Side lines shorter than so many widths of the way they leave lead nowhere."""
SHORTEST = 0.3
"""Metres of the shortest line that means anything."""


@dataclass(frozen=True)
class LineLeg:
    """A way between two nodes, without a bend worth the name."""

    points: tuple[XY, ...]
    width: float
    name: str | None

    @property
    def ends(self) -> tuple[XY, XY]:
        """The nodes at its ends."""
        return self.points[0], self.points[-1]

    @property
    def length(self) -> float:
        """Metres."""
        return LineString(self.points).length

    def points_from(self, node: XY) -> tuple[XY, ...]:
        """Return its points, beginning at one of its ends."""
        return self.points if self.points[0] == node else self.points[::-1]


def legs_of(lines: Sequence[CentreLine]) -> list[LineLeg]:
    """Return the legs between all places where lines meet, bend or end."""
    # Whole millimetres: what differs by less is one place.
    sources = [
        (drawn, line)
        for line in lines
        if len(line.points) > 1
        for drawn in [LineString([(round(x, 3), round(y, 3)) for x, y in line.points])]
        if drawn.length >= SHORTEST
    ]
    if not sources:
        return []
    tree = STRtree([line for line, _ in sources])

    def source_of(start: XY, end: XY) -> CentreLine:
        middle = Point((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
        return sources[int(tree.nearest(middle))][1]

    joined = _joined([line for line, _ in sources])
    chains = _without_spurs(joined, source_of)
    return [
        leg
        for chain in chains
        for straight in _straight_parts(chain)
        for leg in _parts_by_source(straight, source_of)
    ]


def nodes_of(legs: Iterable[LineLeg]) -> dict[XY, list[LineLeg]]:
    """Return the legs at every node, in the order of the nodes' places."""
    found: dict[XY, list[LineLeg]] = defaultdict(list)
    for leg in legs:
        for end in leg.ends:
            found[end].append(leg)
    return dict(sorted(found.items()))


def _joined(lines: list[LineString]) -> list[LineString]:
    """Return the lines cut where they meet; ends that just miss a line are led to it."""
    tree = STRtree(lines)
    pieces = list(lines)
    for number, line in enumerate(lines):
        for end in (Point(line.coords[0]), Point(line.coords[-1])):
            for other in sorted(tree.query(end, predicate="dwithin", distance=SNAP)):
                gap = shapely.shortest_line(end, lines[int(other)])
                if other != number and gap.length > 1e-6:
                    pieces.append(gap)
    return _chains(pieces)


def _chains(pieces: Iterable[LineString]) -> list[LineString]:
    """Return lines cut at crossings and joined where only two ends meet."""
    union = shapely.set_precision(shapely.union_all(list(pieces), grid_size=0.001), 0)
    merged = linemerge(union) if isinstance(union, MultiLineString) else union
    parts = [part for part in shapely.get_parts(merged) if isinstance(part, LineString)]
    return sorted(parts, key=_points)


def _points(line: LineString) -> list[XY]:
    return [(x, y) for x, y, *_ in line.coords]


def _without_spurs(chains: list[LineString], source_of: _SourceOf) -> list[LineString]:
    """Return the chains without short ones that leave others and lead nowhere."""
    while True:
        ends: dict[XY, list[int]] = defaultdict(list)
        for number, chain in enumerate(chains):
            for end in (_points(chain)[0], _points(chain)[-1]):
                ends[end].append(number)
        spurs: list[tuple[float, int]] = []
        for number, chain in enumerate(chains):
            points = _points(chain)
            degrees = [len(ends[points[end]]) for end in (0, -1)]
            if min(degrees) > 1 or max(degrees) < 3:
                continue
            joint = points[0 if degrees[0] > 1 else -1]
            width = max(
                source_of(*_end_step(chains[other], joint)).width
                for other in ends[joint]
                if other != number
            )
            if chain.length < SPUR * width:
                spurs.append((chain.length, number))
        if not spurs:
            return chains
        _, shortest = min(spurs)
        chains = _chains(
            each for number, each in enumerate(chains) if number != shortest
        )


def _end_step(chain: LineString, end: XY) -> tuple[XY, XY]:
    """Return the step of a chain at one of its ends."""
    coords = _points(chain)
    first, second = (coords[0], coords[1]) if coords[0] == end else coords[-2:]
    return first, second


def _straight_parts(chain: LineString) -> list[tuple[XY, ...]]:
    """Cut a chain where it bends."""
    coords = _simplified(chain)
    cuts = [0]
    for place in range(1, len(coords) - 1):
        before = heading_to(coords[place - 1], coords[place])
        after = heading_to(coords[place], coords[place + 1])
        if abs(turn_between(before, after)) > BEND:
            cuts.append(place)
    cuts.append(len(coords) - 1)
    return [tuple(coords[start : end + 1]) for start, end in pairwise(cuts)]


def _simplified(chain: LineString) -> list[XY]:
    """Return the points of a chain without wobbles; one that is a loop begins at a bend."""
    coords = _points(chain)
    if chain.is_ring:
        # Any corner of a loop is as good as another to begin with, a straight place not.
        hull = shapely.remove_repeated_points(chain).minimum_rotated_rectangle
        corner = Point(shapely.get_coordinates(hull)[0])
        start = min(
            range(len(coords) - 1), key=lambda n: corner.distance(Point(coords[n]))
        )
        coords = coords[start:-1] + coords[: start + 1]
    return _points(LineString(coords).simplify(WOBBLE))


def _parts_by_source(points: tuple[XY, ...], source_of: _SourceOf) -> list[LineLeg]:
    """Cut a straight part where its width or its name changes."""
    legs: list[LineLeg] = []
    for step in pairwise(points):
        source = source_of(*step)
        last = legs[-1] if legs else None
        if last and (last.width, last.name) == (source.width, source.name):
            legs[-1] = LineLeg((*last.points, step[1]), last.width, last.name)
        else:
            legs.append(LineLeg(step, source.width, source.name))
    return legs
