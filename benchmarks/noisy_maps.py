"""ROS maps of known floors, as noisy as those that robots make: see docs/importing.md."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from PIL import Image
from scipy import ndimage
from shapely import Polygon
from shapely.affinity import rotate

WALL = 0.15
"""Metres of wall that a scanner shows around a floor."""
MARGIN = 3.0
"""Metres of unknown space around it."""
FREE, OCCUPIED, UNKNOWN = 254, 0, 205
"""Shades as `map_saver` writes them."""


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
    beside = ndimage.distance_transform_edt(~free) * resolution
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
