"""A map that a robot made: free space to floor, centre lines, corridors, turning points."""

import math
from pathlib import Path

from shapely import LineString

from memorymaze.basics.errors import ImportFileError, SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.geometry.grid import LARGEST_FLOOR
from memorymaze.basics.wording import counted
from memorymaze.world.importing.centre_lines import centre_lines
from memorymaze.world.importing.imported import (
    CEILING,
    ImportedSite,
    ImportNotes,
    imported_building,
)
from memorymaze.world.importing.obstacles import (
    OBSTACLE_HEIGHT,
    boxes_on,
    without_obstacles,
)
from memorymaze.world.importing.straight_walls import straight_walls
from memorymaze.world.importing.ways import plan_floor
from memorymaze.world.sites.floor_rules import PASSABLE_RADIUS

STRAY = 0.12
"""Metres by which a straight wall may stray from the map's."""
STRAY_CELLS = 2.0
"""The same in cells, where cells are large."""
PLACES_TOLD = 5


def import_ros_map(
    path: Path, *, narrowest: float = 2 * PASSABLE_RADIUS
) -> ImportedSite:
    """Return the floor of a ROS map as a building, in metres of the map's frame.

    What lies behind ways narrower than `narrowest` metres is left out.
    """
    require_extra("ros", "yaml", purpose="reading the map's YAML file")
    from memorymaze.world.importing.free_space import free_space
    from memorymaze.world.importing.occupancy import read_occupancy

    if not 0 < narrowest < math.inf:
        raise SettingsError(
            f"narrowest: expected metres greater than 0, got {narrowest:g}"
        )
    grid = read_occupancy(path)
    try:
        space = free_space(grid, narrowest / 2)
    except ImportFileError as error:
        raise ImportFileError(f"{path}: {error}") from None
    if space.floor.area > LARGEST_FLOOR:
        raise ImportFileError(
            f"{path}: expected a floor of at most {LARGEST_FLOOR:,.0f} m², got "
            f"{space.floor.area:,.0f} m²; look at resolution, metres per cell, which is "
            f"{grid.resolution:g}, or cut the map"
        )
    notes = ImportNotes()
    stray = max(STRAY, STRAY_CELLS * grid.resolution)
    ragged, standing = without_obstacles(space.floor)
    floor = straight_walls(ragged, stray)
    planned = plan_floor(centre_lines(floor), notes, floor)
    obstacles = list(boxes_on(planned.polygon, standing))
    rows, columns = grid.free.shape
    notes.took.insert(
        0,
        f"{columns} by {rows} cells of {grid.resolution:g} m, in the map's own frame",
    )
    notes.guessed += [
        f"walls: straight lines that stray by up to {stray:.2f} m from the cells",
        f"ceiling height: {CEILING} m; materials",
    ]
    if grid.unknown_as_saved:
        notes.guessed.append(
            f"{grid.unknown_as_saved} cells of shade 205 are unknown space, as map_saver "
            "writes it, though the map's free_thresh would make them free"
        )
    if space.specks:
        notes.guessed.append(f"{counted(space.specks, 'speck')} amid free floor: noise")
    if obstacles:
        notes.guessed.append(
            f"{counted(len(obstacles), 'obstacle')} that "
            f"{'stands' if len(obstacles) == 1 else 'stand'} free: boxes of "
            f"{OBSTACLE_HEIGHT:g} m height; say what they are"
        )
    if space.left_out >= 1:
        notes.missing.append(
            f"{space.left_out:.0f} m² of free cells behind ways narrower than "
            f"{narrowest:g} m, or not connected"
        )
    if space.gaps:
        notes.missing.append(_gaps_told(space.gaps))
    notes.missing.append("rooms, doors, names, things, routes: add them by hand")
    parts = [*planned.parts, *obstacles]
    return notes.imported(imported_building(path, None, "ground floor", None, parts))


def _gaps_told(gaps: tuple[LineString, ...]) -> str:
    """Return where the floor ends without a wall, the longest stretches first."""
    longest = sorted(gaps, key=lambda gap: -gap.length)[:PLACES_TOLD]
    places = ", ".join(
        f"({middle.x:.1f}, {middle.y:.1f}) over {gap.length:.1f} m"
        for gap in longest
        for middle in [gap.interpolate(0.5, normalized=True)]
    )
    more = f" and {len(gaps) - PLACES_TOLD} more" if len(gaps) > PLACES_TOLD else ""
    return (
        f"walls at {places}{more}: the map ends there in unknown space; an opening, "
        "glass, or not explored"
    )
