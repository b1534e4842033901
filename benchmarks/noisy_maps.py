"""ROS maps of known floors, as noisy as those that robots make, and what comes back.

`python -m benchmarks.noisy_maps` makes maps of the benchmark's floors and of a made building
of each kind, imports them and holds the plans against the true ones (docs/lab/importing.md).
"""

import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from PIL import Image
from scipy import ndimage
from scipy.optimize import linear_sum_assignment
from shapely import LineString, Point, Polygon
from shapely.affinity import rotate

from memorymaze.basics.tables import Column, Table
from memorymaze.world.construction import BUILDING_KINDS, make_building
from memorymaze.world.importing.ros_map import import_ros_map
from memorymaze.world.sites import (
    BUILTIN_SITE_NAMES,
    Site,
    find_site_problems,
    load_site,
)

WALL = 0.15
"""Metres of wall that a scanner shows around a floor."""
MARGIN = 3.0
"""Metres of unknown space around it."""
FREE, OCCUPIED, UNKNOWN = 254, 0, 205
"""Shades as `map_saver` writes them."""
SAME_POINT = 2.0
"""Metres between the middles of two turning points that are one."""
SAME_LINE = 0.6
"""Metres between two middle lines of one corridor."""
SEED = 7
VALUES = (
    "area error %",
    "turning points: recall %",
    "precision %",
    "corridors: recall %",
    "precision (length) %",
    "errors",
)


@dataclass(frozen=True)
class Noise:
    """What is wrong with a map."""

    ragged: float = 0.0
    """Standard deviation in metres by which walls stray."""
    specks: float = 0.0
    """Share of the free cells that are occupied or unknown."""
    missing_wall: float = 0.0
    """Share of the walls' length that was not seen."""
    turned_deg: float = 0.0
    """By which the building stands askew in the map."""
    boxes: int = 0
    """Things of half a metre that stand about."""


def write_map(
    folder: Path,
    floor: Polygon,
    noise: Noise,
    rng: np.random.Generator,
    resolution: float = 0.05,
) -> tuple[Path, Polygon]:
    """Write a floor as a ROS map; return its YAML file and the floor as it lies in it."""
    floor = rotate(floor, noise.turned_deg, origin=(0, 0))
    west, south, east, north = floor.buffer(MARGIN).bounds
    size = (
        math.ceil((north - south) / resolution),
        math.ceil((east - west) / resolution),
    )
    y, x = (np.indices(size) + 0.5) * resolution
    shifted = [
        each + noise.ragged * _waves(size, 0.4 / resolution, rng)
        if noise.ragged
        else each
        for each in (x + west, y + south)
    ]
    shapely.prepare(floor)
    free = shapely.contains_xy(floor, *shifted)
    for _ in range(noise.boxes):
        row, column = rng.choice(np.argwhere(free))
        half = round(0.25 / resolution)
        free[row - half : row + half, column - half : column + half] = False
    apart = np.asarray(ndimage.distance_transform_edt(~free), dtype=np.float64)
    beside = apart * resolution
    unseen = _waves(size, 1.0 / resolution, rng)
    seen = unseen > np.quantile(unseen, noise.missing_wall)
    cells = np.where(free, FREE, UNKNOWN).astype(np.uint8)
    cells[(beside > 0) & (beside <= WALL) & seen] = OCCUPIED
    # Beams go out where no wall was seen.
    leaks = ~free & ~seen & (beside <= 2.0) & (rng.random(size) < 0.6)
    cells[leaks] = FREE
    speck = free & (rng.random(size) < noise.specks)
    cells[speck] = rng.choice([OCCUPIED, UNKNOWN], size=int(speck.sum()))
    folder.mkdir(parents=True, exist_ok=True)
    Image.fromarray(cells[::-1]).save(folder / "map.pgm")
    (folder / "map.yaml").write_text(
        f"image: map.pgm\nmode: trinary\nresolution: {resolution}\n"
        f"origin: [{west}, {south}, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
        encoding="utf-8",
    )
    return folder / "map.yaml", floor


def _waves(
    size: tuple[int, int], wavelength: float, rng: np.random.Generator
) -> np.ndarray:
    """Return smooth noise of mean 0 and standard deviation 1."""
    rough = ndimage.gaussian_filter(rng.standard_normal(size), wavelength / 4)
    return (rough - rough.mean()) / rough.std()


LEVELS = {
    "clean": Noise(turned_deg=12),
    "as from a good LiDAR": Noise(0.03, 0.005, 0.03, 12, 15),
    "as from a poor one": Noise(0.06, 0.02, 0.10, 12, 30),
}


@dataclass(frozen=True)
class Comparison:
    """An imported floor against the true one."""

    area_error: float
    """Square metres in just one of the two, as a share of the true floor."""
    points: tuple[int, int, int]
    """Turning points: true ones but dead ends, found, found and true."""
    lengths: tuple[float, float, float, float]
    """Metres of middle lines: true, of these found, found, of these true."""
    errors: int
    """Of `sites check`."""


def compare(true: Site, found: Site, turned_deg: float, errors: int) -> Comparison:
    """Hold a plan made from a map against the true one, turned as the map was."""
    floor = rotate(true.walkable_floor, turned_deg, origin=(0, 0))
    # The importer makes no turning points of dead ends.
    wanted = [
        rotate(point.polygon, turned_deg, origin=(0, 0)).centroid
        for point in true.turning_points
        if point.shape != "dead_end"
    ]
    got = [point.polygon.centroid for point in found.turning_points]
    lines = [
        rotate(each.centre_line, turned_deg, origin=(0, 0)) for each in true.corridors
    ]
    drawn = [each.centre_line for each in found.corridors]
    return Comparison(
        floor.symmetric_difference(found.walkable_floor).area / floor.area,
        (len(wanted), len(got), _matched(wanted, got)),
        (*_covered(lines, drawn), *_covered(drawn, lines)),
        errors,
    )


def _matched(wanted: Sequence[Point], got: Sequence[Point]) -> int:
    """Return how many pairs of near turning points there are, each in one pair."""
    apart = np.array([[one.distance(other) for other in got] for one in wanted])
    pairs = linear_sum_assignment(np.minimum(apart, 10 * SAME_POINT))
    return int((apart[pairs] <= SAME_POINT).sum())


def _covered(
    lines: Sequence[LineString], by: Sequence[LineString]
) -> tuple[float, float]:
    """Return the length of lines, and how much of it lies along others."""
    whole = shapely.union_all(list(lines))
    near = shapely.union_all([line.buffer(SAME_LINE) for line in by])
    return whole.length, whole.intersection(near).length


def floors() -> Iterator[Site]:
    """Yield the benchmark's floors, and a made building of each kind."""
    for name in BUILTIN_SITE_NAMES:
        yield load_site(name)
    for kind in BUILDING_KINDS:
        yield make_building(kind, SEED)


def measure(site: Site, noise: Noise, folder: Path) -> Comparison:
    """Return how a site comes back from a map."""
    rng = np.random.default_rng(SEED)
    path, _ = write_map(folder / site.name, site.walkable_floor, noise, rng)
    imported = import_ros_map(path).site
    plan = folder / f"{site.name}_map.geojson"
    imported.save(plan)
    errors = sum(each.severity == "error" for each in find_site_problems(plan))
    return compare(site, imported, noise.turned_deg, errors)


def main() -> None:
    """Print a line per level of noise for the benchmark's floors and for made ones."""
    rows: list[dict[str, object]] = []
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        sites = list(floors())
        own = len(BUILTIN_SITE_NAMES)
        for level, noise in LEVELS.items():
            found = [measure(site, noise, folder) for site in sites]
            for what, part in (("benchmark", found[:own]), ("made", found[own:])):
                points = np.array([each.points for each in part]).sum(axis=0)
                lengths = np.array([each.lengths for each in part]).sum(axis=0)
                values = (
                    100 * np.mean([each.area_error for each in part]),
                    100 * points[2] / points[0],
                    100 * points[2] / points[1],
                    100 * lengths[1] / lengths[0],
                    100 * lengths[3] / lengths[2],
                    sum(each.errors for each in part),
                )
                rows.append({
                    "map": level,
                    "floors": f"{what} ({len(part)})",
                    **dict(zip(VALUES, map(float, values), strict=True)),
                })
    labels = [Column(name, name, role="label") for name in ("map", "floors")]
    values = [
        Column(name, name, digits=1 if number == 0 else 0)
        for number, name in enumerate(VALUES)
    ]
    print(Table("", (*labels, *values), tuple(rows)).markdown())


if __name__ == "__main__":
    main()
