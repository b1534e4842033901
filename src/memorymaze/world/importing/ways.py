"""Centre lines made into the floor of a plan: corridors, turning points, open areas.

What comes out keeps the rules of the floor (`world/sites/floor_rules.py`): what would break one
is made smaller or left to an area, and told.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import cast

import shapely
from shapely import LineString, MultiPolygon, Point, Polygon

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.pose import heading_to, moved
from memorymaze.basics.wording import counted
from memorymaze.world.importing.corridors import PlannedCorridor, corridors_along
from memorymaze.world.importing.imported import CentreLine, ImportNotes
from memorymaze.world.importing.junctions import (
    LineJunction,
    exits_of,
    junctions_of,
)
from memorymaze.world.importing.line_graph import LineLeg, legs_of, nodes_of
from memorymaze.world.importing.shapes import polygons, strip
from memorymaze.world.sites.exits import FloorShapes, shape_of
from memorymaze.world.sites.floor_rules import exact_union
from memorymaze.world.sites.records import (
    Area,
    Corridor,
    PlanPart,
    TurningPoint,
    floor_pieces,
)

FLOOR_MATERIAL, WALL_MATERIAL = "linoleum", "plaster"
SMALLEST_FLOOR = 1.0
"""Square metres of the smallest floor."""
SMALLEST_PIECE = 0.1
"""Square metres of the smallest area that is left beside corridors."""
SEAM = 0.03
"""Metres by half of the widest strip beside corridors that is left out of the floor."""
PATCH = 0.1
"""Metres that a piece that closes a hole reaches under the parts around it."""
INTO_AREA = 1.5
"""Metres ahead of the end of a way within which an open area is what it leads to."""
SHORTEST_PART = 0.1
"""Metres of the shortest way that an open area cuts off."""
SMALLEST_HOLE = 0.06
"""Square metres of the smallest block that one walks around."""


@dataclass(frozen=True, slots=True)
class OpenArea:
    """Floor that is no corridor."""

    polygon: Polygon
    name: str | None
    open_air: bool = False


@dataclass(frozen=True, slots=True)
class PlannedFloor:
    """The walkable floor of a building."""

    parts: tuple[PlanPart, ...]
    """Corridors, areas and turning points."""
    polygon: Polygon
    """Their union, as rules and robots see it."""


def plan_floor(
    lines: Sequence[CentreLine],
    notes: ImportNotes,
    floor: Polygon | MultiPolygon | None = None,
    areas: Sequence[OpenArea] = (),
) -> PlannedFloor:
    """Return corridors along lines, turning points between them, and areas elsewhere.

    `floor` is where one can walk, beside the areas; without it, it is what the lines'
    widths cover. Where it is in pieces, all but the largest are left out and told.
    """
    walkable = _walkable(lines, floor, areas, notes)
    opened = [
        OpenArea(part, area.name, area.open_air)
        for area in areas
        for part in polygons(area.polygon.intersection(walkable))
        if part.area > SMALLEST_PIECE
    ]
    legs = [part for leg in legs_of(lines) for part in _cut_at_areas(leg, opened)]
    legs += list(_into_areas(legs, opened))
    across = {leg for leg in legs if _crosses(leg, opened)}
    inner = shapely.union_all([area.polygon.buffer(-2 * SEAM) for area in opened])
    between = cast(Polygon | MultiPolygon, walkable.difference(inner))
    outside = [leg for leg in legs if leg not in across]
    corridors = list(corridors_along(outside, between, nodes_of(legs)))
    junctions = junctions_of(legs, walkable, across, notes)
    taken = [each.polygon for each in (*opened, *corridors, *junctions)]
    opened += [OpenArea(part, None) for part in _rest(walkable, taken)]
    return _planned(corridors, opened, junctions, notes)


def _walkable(
    lines: Sequence[CentreLine],
    floor: Polygon | MultiPolygon | None,
    areas: Sequence[OpenArea],
    notes: ImportNotes,
) -> Polygon:
    """Return the floor to be covered, in one piece."""
    given = [floor] if floor is not None else list(widened(lines))
    parts = [
        part
        for each in (*given, *(area.polygon for area in areas))
        for part in polygons(each)
    ]
    pieces = polygons(shapely.union_all(parts))
    if not pieces or pieces[0].area < SMALLEST_FLOOR:
        raise ImportFileError("expected some floor to walk on, got none")
    for piece in pieces[1:]:
        if piece.area >= SMALLEST_PIECE:
            where = piece.representative_point()
            notes.missing.append(
                f"{piece.area:.1f} m² of floor at ({where.x:.1f}, {where.y:.1f}): it "
                "does not hang together with the rest"
            )
    holes = [hole for hole in pieces[0].interiors if Polygon(hole).area > SMALLEST_HOLE]
    return polygons(Polygon(pieces[0].exterior, holes))[0]


def widened(lines: Sequence[CentreLine]) -> Iterator[Polygon]:
    """Yield what the lines' widths cover, walls drawn out to where they meet."""
    legs = legs_of(lines)
    for leg in legs:
        yield LineString(leg.points).buffer(
            leg.width / 2, cap_style="flat", join_style="mitre"
        )
    for node, leaving in nodes_of(legs).items():
        reach = 2 * max(leg.width for leg in leaving)
        stubs: list[Polygon] = []
        for leg in leaving:
            heading = heading_to(node, leg.points_from(node)[1])
            start, half = moved(node, heading, -reach), leg.width / 2
            stubs.append(strip(start, heading, 2 * reach, half, half))
        for stub, other in combinations(stubs, 2):
            yield from polygons(stub.intersection(other))


def _cut_at_areas(leg: LineLeg, areas: Sequence[OpenArea]) -> Iterator[LineLeg]:
    """Yield a leg's parts outside and inside open areas."""
    parts = [LineString(leg.points)]
    for area in areas:
        parts = [
            piece
            for part in parts
            for cut in (part.difference(area.polygon), part.intersection(area.polygon))
            for piece in shapely.get_parts(cut).tolist()
            if isinstance(piece, LineString) and not piece.is_empty
        ]
    for part in parts:
        rounded = [(round(x, 3), round(y, 3)) for x, y in part.coords]
        steps = [rounded[0], *(b for a, b in pairwise(rounded) if a != b)]
        if len(steps) > 1 and part.length >= SHORTEST_PART:
            yield LineLeg(tuple(steps), leg.width, leg.name)


def _into_areas(
    legs: Sequence[LineLeg], areas: Sequence[OpenArea]
) -> Iterator[LineLeg]:
    """Yield short legs that lead on into open areas where others end at them."""
    for node, leaving in nodes_of(legs).items():
        heading = heading_to(leaving[0].points_from(node)[1], node)
        inside = moved(node, heading, INTO_AREA)
        if len(leaving) == 1 and any(
            area.polygon.covers(Point(inside))
            and area.polygon.buffer(-SHORTEST_PART).distance(Point(node)) > 0
            for area in areas
        ):
            yield LineLeg((node, inside), leaving[0].width, None)


def _crosses(leg: LineLeg, areas: Sequence[OpenArea]) -> bool:
    """Tell whether a leg lies in an open area."""
    middle = LineString(leg.points).interpolate(0.5, normalized=True)
    return any(area.polygon.covers(middle) for area in areas)


def _rest(floor: Polygon, taken: Sequence[Polygon]) -> list[Polygon]:
    """Return the floor that nothing covers yet, reaching a little under the rest."""
    left = floor.difference(shapely.union_all(list(taken)))
    wide = left.buffer(-SEAM, join_style="mitre")
    wider = wide.buffer(2 * SEAM, join_style="mitre", mitre_limit=2.0)
    return [
        part
        for part in polygons(wider.intersection(floor))
        if part.area > SMALLEST_PIECE
    ]


def _patches(parts: Sequence[Polygon]) -> list[Polygon]:
    """Return pieces that close the small holes between parts."""
    return [
        patch
        for piece in polygons(exact_union(parts))
        for hole in piece.interiors
        if Polygon(hole).area < SMALLEST_HOLE
        for patch in polygons(Polygon(hole).buffer(PATCH, join_style="mitre"))
    ]


def _planned(
    corridors: Sequence[PlannedCorridor],
    areas: Sequence[OpenArea],
    junctions: Sequence[LineJunction],
    notes: ImportNotes,
) -> PlannedFloor:
    """Return the parts with ids and exits, the seams between them closed."""
    parts = [each.polygon for each in (*corridors, *areas, *junctions)]
    areas = [*areas, *(OpenArea(patch, None) for patch in _patches(parts))]
    exact = exact_union([*parts, *(area.polygon for area in areas)])
    while True:
        shapes = FloorShapes(
            {f"corridor_{n}": part.polygon for n, part in enumerate(corridors, 1)},
            {f"area_{n}": part.polygon for n, part in enumerate(areas, 1)},
            {f"tp_{n}": part.polygon for n, part in enumerate(junctions, 1)},
        )
        exits = [exits_of(each, exact, shapes) for each in junctions]
        # A turning point without a way out is floor all the same.
        blind = [each for each, out in zip(junctions, exits, strict=True) if not out]
        if not blind:
            break
        areas += [OpenArea(each.polygon, None) for each in blind]
        junctions = [each for each in junctions if each not in blind]
    floor = floor_pieces([part for kind in shapes for part in kind.values()])[0]
    notes.took.append(
        f"{floor.area:.0f} m² of floor: {counted(len(corridors), 'corridor')}, "
        f"{counted(len(junctions), 'turning point')}, {counted(len(areas), 'open area')}"
    )
    planned = (
        *(
            Corridor(name, part.polygon, part.name, FLOOR_MATERIAL, WALL_MATERIAL)
            for name, part in zip(shapes.corridors, corridors, strict=True)
        ),
        *(
            Area(
                name,
                part.polygon,
                part.name,
                FLOOR_MATERIAL,
                WALL_MATERIAL,
                part.open_air,
            )
            for name, part in zip(shapes.areas, areas, strict=True)
        ),
        *(
            TurningPoint(name, polygon, None, shape_of(out, shapes.areas), tuple(out))
            for (name, polygon), out in zip(
                shapes.turning_points.items(), exits, strict=True
            )
        ),
    )
    return PlannedFloor(planned, floor)
