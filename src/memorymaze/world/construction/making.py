"""Buildings from a kind and a seed; a floor that breaks a rule is drawn again."""

import numpy as np

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.world.construction.floor import MadeFloor
from memorymaze.world.construction.growth import grow
from memorymaze.world.construction.layout import UnsuitableFloor
from memorymaze.world.construction.plan import parts_of
from memorymaze.world.construction.recipes import BUILDING_KINDS, RECIPES, BuildingKind
from memorymaze.world.construction.rooms import MadeDoor, RoomPlanner
from memorymaze.world.construction.skeleton import Skeleton
from memorymaze.world.construction.things import Furnisher
from memorymaze.world.construction.vocabulary import Special, Vocabulary, vocabulary
from memorymaze.world.construction.walls import MadeWall, end_wall, walls_of
from memorymaze.world.construction.ways import Ways
from memorymaze.world.sites.checking import made_site_problems
from memorymaze.world.sites.plan import in_millimetres
from memorymaze.world.sites.records import Site, parts_by_kind
from memorymaze.world.sites.things import door_kinds

MOST_TRIES = 60
"""Floors drawn for one building before giving up."""
TURNING_POINTS = (20, 70)
"""Fewest and most of a building."""
ACROSS = (40.0, 110.0)
"""Metres along the longer side of a floor's bounding box."""
MOST_GROWN = 8
"""Corridors at most that a floor has beyond its recipe."""
STAIRS = Special(
    name="Stairs", use="stairwell", width=3.0, depth=5.0, door="fire", programs=()
)


def make_building(kind: BuildingKind, seed: int) -> Site:
    """Make a building's floor.

    Args:
        kind: One of `BUILDING_KINDS`.
        seed: From 0; which building of its kind.

    Returns:
        A building called by kind and seed, such as `hospital_0007`, that breaks no rule of
        `memorymaze sites check`. The same seed gives the same building.

    Raises:
        SettingsError: There is no such kind, the seed is negative, or no floor drawn
            from this seed kept all rules.
    """
    if kind not in BUILDING_KINDS:
        raise SettingsError(
            f"kind: expected one of {', '.join(BUILDING_KINDS)}, got {kind!r}"
            f"{did_you_mean(kind, BUILDING_KINDS)}"
        )
    if seed < 0:
        raise SettingsError(f"seed: expected a number from 0, got {seed}")
    rng = np.random.default_rng([BUILDING_KINDS.index(kind), seed])
    name = f"{kind}_{seed:04d}"
    reasons: list[str] = []
    for _ in range(MOST_TRIES):
        try:
            return _drawn(name, kind, rng)
        except UnsuitableFloor as reason:
            reasons.append(str(reason))
    raise SettingsError(
        f"{kind} with seed {seed}: expected a floor that keeps all rules within "
        f"{MOST_TRIES} tries, got none, the last because of: {reasons[-1]}; take another "
        "seed"
    )


def _drawn(name: str, kind: BuildingKind, rng: np.random.Generator) -> Site:
    """Return one drawn floor, or raise why it is unsuitable."""
    words = vocabulary(kind)
    drawn = RECIPES[kind](rng)
    layout = drawn.turned(int(rng.integers(4)), mirrored=bool(rng.integers(2)))
    grow(layout, rng, int(rng.integers(MOST_GROWN + 1)))
    floor = MadeFloor(layout, Skeleton(layout))
    _check_size(floor)
    walls = walls_of(floor)
    digit = int(rng.integers(len(words.floors)))
    planner = RoomPlanner(floor, words, rng)
    doors, exits = _close_ends(floor, walls, words, planner, rng)
    rooms = planner.place(walls, digit + 1)
    furnisher = Furnisher(floor, words, rooms, rng)
    furnisher.label_doors(rooms)
    for wall in exits:
        hung = wall.at(wall.length / 2, 0.8)
        furnisher.hang("exit sign", hung, wall.facing, "EXIT")
    ways = Ways(floor, rooms)
    ways.hang_signs(furnisher, rng)
    for number in range(len(floor.halls)):
        furnisher.furnish_hall(number)
    for wall in walls:
        furnisher.furnish_wall(wall)
    routes = ways.routes(rng)
    title = words.titles[rng.integers(len(words.titles))]
    parts = parts_of(floor, words, rooms, doors, routes)
    exact = Site(
        name=name,
        title=title,
        floor=words.floors[digit],
        ceiling_height=float(rng.choice(words.ceilings)),
        description=f"A made floor of a {kind}; no such building exists.",
        anchor=None,
        **parts_by_kind([*parts, *furnisher.things]),
    )
    building = in_millimetres(exact)
    problems = made_site_problems(building)
    if problems:
        raise UnsuitableFloor(problems[0].line())
    return building


def _check_size(floor: MadeFloor) -> None:
    west, south, east, north = floor.walkable.bounds
    across = max(east - west, north - south)
    if not ACROSS[0] <= across <= ACROSS[1]:
        raise UnsuitableFloor(f"{across:.0f} m across")
    points = len(floor.turning_points)
    if not TURNING_POINTS[0] <= points <= TURNING_POINTS[1]:
        raise UnsuitableFloor(f"{points} turning points")


def _close_ends(
    floor: MadeFloor,
    walls: list[MadeWall],
    words: Vocabulary,
    planner: RoomPlanner,
    rng: np.random.Generator,
) -> tuple[list[MadeDoor], list[MadeWall]]:
    """Put entrances, stairs, exits or windows at the ends of streets.

    Returns doors that lead to no room, and walls with a way out in them.
    """
    skeleton = floor.skeleton
    doors: list[MadeDoor] = []
    exits: list[MadeWall] = []
    for node in skeleton.graph:
        place = skeleton.places[node]
        if skeleton.graph.degree[node] > 1 or floor.hall_around(place) is not None:
            continue
        wall = end_wall(walls, place)
        if wall is None:
            raise UnsuitableFloor("a dead end without a wall")
        if node in floor.entrances:
            doors.append(_door_in(wall, "automatic", floor.entrances[node], rng))
            exits.append(wall)
            continue
        ends = words.programs[wall.program].ends
        end = ends[rng.integers(len(ends))]
        if end == "stairs" and planner.add_behind(wall, STAIRS):
            exits.append(wall)
        elif end != "window":
            doors.append(_door_in(wall, "fire", "EXIT", rng))
            exits.append(wall)
    return doors, exits


def _door_in(
    wall: MadeWall, kind: str, label: str, rng: np.random.Generator
) -> MadeDoor:
    door = door_kinds()[kind]
    half = min(door.width, wall.length - 0.3) / 2
    middle = wall.length / 2
    wall.take(middle - half - 0.1, middle + half + 0.1)
    color = door.colors[rng.integers(len(door.colors))]
    return MadeDoor(wall, middle - half, middle + half, door.style, color, label)
