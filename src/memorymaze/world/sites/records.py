"""What a building's floor plan says, as immutable records.

Metres; angles in radians counter-clockwise from +x in (-pi, pi]. Loading and checking
live in the other files of this room.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar, Literal, cast

from shapely import LineString, MultiPolygon, Point, Polygon, box, union_all
from shapely.affinity import affine_transform

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import SettingsError, SitePlanError, did_you_mean
from memorymaze.basics.geometry.pose import Pose
from memorymaze.world.sites.plan import plan_bytes

Mount = Literal["floor", "wall", "ceiling"]

SEAM_GAP = 1e-3
"""Half the width in metres of the gaps and slivers that are closed in the floor."""
SEAM_KINK = 5e-3
"""Kinks in the floor's boundary smaller than this many metres are straightened."""


@dataclass(frozen=True)
class Anchor:
    """Where the plan's origin lies on the globe."""

    latitude: float
    """Degrees."""
    longitude: float
    """Degrees."""
    bearing: float
    """Heading of true north in the plan's frame minus pi/2, radians."""


@dataclass(frozen=True)
class PlanPart:
    """What every feature of a plan is."""

    kind: ClassVar[str]
    """As plans have it."""
    id: str
    more: Mapping[str, object] = field(
        default_factory=dict[str, object], kw_only=True, compare=False, repr=False
    )
    """What else the plan says of it, that nobody reads."""


@dataclass(frozen=True)
class Corridor(PlanPart):
    """A straight, convex, four-cornered piece of floor; its long direction is its way."""

    kind = "corridor"
    polygon: Polygon
    name: str | None
    """What people call it."""
    floor_material: str
    wall_material: str

    @cached_property
    def centre_line(self) -> LineString:
        """Line of two points between the middles of its short ends, metres."""
        return corridor_centre_line(self.polygon)

    @property
    def length(self) -> float:
        """Metres along the centre line."""
        return self.centre_line.length

    @property
    def width(self) -> float:
        """Mean width across the centre line, metres."""
        return self.polygon.area / self.length


@dataclass(frozen=True)
class Area(PlanPart):
    """Open floor of any shape; holes are blocks one walks around."""

    kind = "area"
    polygon: Polygon
    name: str | None
    floor_material: str
    wall_material: str
    open_air: bool


@dataclass(frozen=True)
class Exit:
    """A direction in which one can leave a turning point."""

    to: str
    """Id of the corridor, area or turning point it leads to."""
    heading: float
    """Radians."""


@dataclass(frozen=True)
class TurningPoint(PlanPart):
    """A convex part of the floor where a walker can change corridor."""

    kind = "turning_point"
    polygon: Polygon
    name: str | None
    shape: str
    """`corner`, `t_junction`, `crossing`, `opening` or `dead_end`."""
    exits: tuple[Exit, ...]
    """Every direction in which one can leave it."""


@dataclass(frozen=True)
class Room(PlanPart):
    """A space beside the walkable floor; not entered."""

    kind = "room"
    polygon: Polygon
    name: str
    use: str


@dataclass(frozen=True)
class Door(PlanPart):
    """A door on the boundary of the walkable floor."""

    kind = "door"
    line: LineString
    """Its two ends, (2, 2) metres."""
    room: str | None
    """Id of the room behind it."""
    style: str
    color: str
    label: str | None
    """Text on or beside it."""
    state: Literal["closed", "open"]


@dataclass(frozen=True)
class Landmark(PlanPart):
    """A thing that people mention or that stands in the way."""

    kind = "landmark"
    position: Point
    """Centre of its footprint."""
    category: str
    """Common English noun, such as `vending machine`."""
    color: str | None
    name: str | None
    """Proper name."""
    text: str | None
    """Words written on it."""
    heading: float
    """The way its front faces, radians."""
    size: tuple[float, float, float]
    """Length across the front, depth, height; metres."""
    mount: Mount
    obstacle: bool
    """Whether the robot must not drive through its footprint."""

    @cached_property
    def footprint(self) -> Polygon:
        """The rectangle it covers on the plan."""
        return rectangle(self.size, self.position.x, self.position.y, self.heading)


@dataclass(frozen=True)
class RouteTurn:
    """A change of direction along a route."""

    at: str
    """Turning point id."""
    direction: str
    """`left`, `right`, `slight_left` or `slight_right`."""


@dataclass(frozen=True)
class Route(PlanPart):
    """A walk from a start to a destination along its middle line."""

    kind = "route"
    line: LineString
    route: str
    """`R1`, `R2`, …"""
    role: Literal["reference", "alternative"]
    start_heading: float
    """Radians."""
    goal: str
    """The destination in everyday words."""
    goal_landmark: str
    """Id of the landmark, door or room that is the destination."""
    length: float
    """Metres along the line."""
    turns: tuple[RouteTurn, ...]
    note: str

    @property
    def start(self) -> Pose:
        """Pose in which an episode on this route begins."""
        x, y = self.line.coords[0][:2]
        return Pose(x, y, self.start_heading)


def parts_by_kind(parts: Iterable[PlanPart]) -> dict[str, Any]:
    """Return the parts of a plan in their order, by the names that a site has for them."""
    parts = tuple(parts)
    return {
        f"{kind.kind}s": tuple(part for part in parts if isinstance(part, kind))
        for kind in PART_KINDS
    }


PART_KINDS = (Corridor, Area, TurningPoint, Room, Door, Landmark, Route)


@dataclass(frozen=True)
class Site:
    """One floor of a building: what the robot's world is made from."""

    name: str
    """File stem, such as `museum_5f`."""
    title: str
    floor: str
    ceiling_height: float
    description: str
    anchor: Anchor | None
    corridors: tuple[Corridor, ...]
    areas: tuple[Area, ...]
    turning_points: tuple[TurningPoint, ...]
    rooms: tuple[Room, ...]
    doors: tuple[Door, ...]
    landmarks: tuple[Landmark, ...]
    routes: tuple[Route, ...]
    more: Mapping[str, object] = field(
        default_factory=dict[str, object], compare=False, repr=False
    )
    """What else the plan says, that nobody reads."""
    source: str = field(default="", compare=False)
    """Path of the file it was read from."""

    def __repr__(self) -> str:
        """Return name and size."""
        return (
            f"Site({self.name!r}: {self.title}, {len(self.turning_points)} turning points, "
            f"{len(self.doors)} doors, {len(self.landmarks)} landmarks, routes "
            f"{', '.join(route.id for route in self.routes) or 'none'})"
        )

    @property
    def floor_parts(self) -> tuple[Corridor | Area | TurningPoint, ...]:
        """All that is walked on."""
        return (*self.corridors, *self.areas, *self.turning_points)

    @property
    def parts(self) -> tuple[PlanPart, ...]:
        """All features, in the order in which they are written."""
        beside = (*self.rooms, *self.doors, *self.landmarks)
        return (*self.floor_parts, *beside, *self.routes)

    @cached_property
    def walkable_floor(self) -> Polygon:
        """Union of all corridors, areas and turning points, with its holes.

        Gaps and slivers up to 2 mm wide and kinks below 5 mm, which rounded coordinates
        leave at slanted seams, are smoothed away.
        """
        return union_of_floor([part.polygon for part in self.floor_parts])

    @cached_property
    def free_floor(self) -> Polygon | MultiPolygon:
        """Walkable floor without the footprints of obstacles.

        Several polygons when obstacles cut pieces off.
        """
        obstacles = [thing.footprint for thing in self.landmarks if thing.obstacle]
        free = self.walkable_floor.difference(union_all(obstacles))
        return cast(Polygon | MultiPolygon, free)

    def save(self, path: str | Path) -> None:
        """Write it as a plan, which is read as the same building; replace what is there.

        Raises:
            SettingsError: The file cannot be written.
        """
        try:
            write_whole(Path(path), plan_bytes(self))
        except OSError as error:
            raise SettingsError(
                f"{path}: cannot be written ({error.strerror or error})"
            ) from None

    def find_route(self, name: str) -> Route:
        """Return a route by its name (`R1`: the reference route) or its id.

        Raises:
            SettingsError: There is none; lists those there are.
        """
        for route in self.routes:
            if name == route.id or (name == route.route and route.role == "reference"):
                return route
        if not self.routes:
            raise SettingsError(
                f"route: expected a site with routes, got {self.name}, which has none"
            )
        names = [
            f"{each.route} ({each.id})" if each.role == "reference" else each.id
            for each in self.routes
        ]
        known = [each for route in self.routes for each in (route.route, route.id)]
        meant = did_you_mean(str(name).upper(), known) or did_you_mean(name, known)
        raise SettingsError(
            f"route: expected one of {', '.join(names)}, got {name!r}{meant}"
        )

    def ways(self, route: str) -> list[Route]:
        """Return the ways of the route called `R1`, `R2`, …, the reference first."""
        ways = [each for each in self.routes if each.route == route]
        return sorted(ways, key=lambda each: each.role != "reference")


def rectangle(
    size: tuple[float, float, float], x: float, y: float, heading: float
) -> Polygon:
    """Return what a thing covers of the plan that faces along a heading."""
    length, depth, _ = size
    upright = box(-depth / 2, -length / 2, depth / 2, length / 2)
    cosine, sine = math.cos(heading), math.sin(heading)
    return affine_transform(upright, (cosine, -sine, sine, cosine, x, y))


def floor_pieces(parts: Sequence[Polygon]) -> list[Polygon]:
    """Unite floor polygons into connected pieces, the largest first.

    Gaps and slivers up to 2 mm wide and kinks below 5 mm are smoothed away.
    """
    grown = union_all([part.buffer(SEAM_GAP, join_style="mitre") for part in parts])
    floor = grown.buffer(-SEAM_GAP, join_style="mitre")
    pieces = [
        cast(Polygon, _without_specks(piece).simplify(SEAM_KINK))
        for piece in getattr(floor, "geoms", [floor])
    ]
    there = [piece for piece in pieces if not piece.is_empty]
    return sorted(there, key=lambda piece: piece.area, reverse=True)


def _without_specks(piece: Polygon) -> Polygon:
    """Fill holes of a kink's size, which may lie outside once kinks are smoothed."""
    holes = [hole for hole in piece.interiors if Polygon(hole).area > SEAM_KINK**2]
    return Polygon(piece.exterior, holes)


def union_of_floor(parts: Sequence[Polygon]) -> Polygon:
    """Unite floor polygons that form one connected floor; see `floor_pieces`."""
    pieces = floor_pieces(parts)
    if len(pieces) != 1:
        raise SitePlanError(
            "floor-connected: expected corridors, areas and turning points that form "
            f"one connected floor, got {len(pieces)} pieces; let neighbours overlap or "
            "share an edge"
        )
    return pieces[0]


def corridor_centre_line(polygon: Polygon) -> LineString:
    """Return the line between the middles of a four-cornered corridor's two short ends.

    The ends are the pair of opposite sides that is shorter in sum, so the line follows
    the long direction; of a square it joins the second and the fourth side. It runs
    from the west end to the east end, or from south to north when it has no west.
    """
    corners = [(x, y) for x, y, *_ in polygon.exterior.coords[:-1]]
    if len(corners) != 4:
        raise ValueError(f"a corridor has 4 corners, got {len(corners)}")
    sides = [(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    lengths = [math.dist(*side) for side in sides]
    first_end = 1 if lengths[0] + lengths[2] >= lengths[1] + lengths[3] else 0
    middles = [
        ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        for a, b in (sides[first_end], sides[first_end + 2])
    ]
    return LineString(sorted(middles))
