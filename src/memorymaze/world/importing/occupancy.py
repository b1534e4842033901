"""Occupancy grids as ROS keeps them: a YAML file and an image, after `nav2_map_server`."""

import math
import struct
import warnings
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeVar, cast

import numpy as np
import yaml
from numpy.typing import NDArray
from PIL import Image
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from shapely import LineString, Polygon
from shapely.affinity import affine_transform

from memorymaze.basics.errors import ImportFileError
from memorymaze.basics.geometry.pose import Pose, wrap_angle
from memorymaze.basics.input_files import (
    mistakes,
    read_text,
    refusal,
    shown,
    unknown_fields,
)

LONGEST_YAML = 2**16
"""Characters."""
MOST_CELLS = 40_000_000
"""Of an image: 300 m by 300 m in cells of 5 cm."""
IMAGE_FORMATS = ("PPM", "PNG", "BMP")
"""What the map server reads, as Pillow calls it; PGM is a PPM."""
SAVED_UNKNOWN, SAVED_FREE = 205, {254, 255}
"""Shades as a map saver writes them."""
_UNREADABLE = (OSError, SyntaxError, ValueError, EOFError, struct.error, zlib.error)
"""What Pillow raises on files that are no images."""

Cells = NDArray[np.bool_]
_Shape = TypeVar("_Shape", Polygon, LineString)


@dataclass(frozen=True)
class OccupancyGrid:
    """What a robot knows of a floor, cell by cell; row 0 is the south of the map."""

    free: Cells
    occupied: Cells
    """What is neither is unknown."""
    resolution: float
    """Metres along a cell."""
    origin: Pose
    """Of the outer corner of the first cell, in the map's frame."""
    unknown_as_saved: int = 0
    """Cells that are unknown because `map_saver` means that by their shade."""

    def in_map(self, shape: _Shape) -> _Shape:
        """Return a shape in cells as one in metres."""
        along = self.resolution * math.cos(self.origin.heading)
        up = self.resolution * math.sin(self.origin.heading)
        return affine_transform(
            shape, (along, -up, up, along, self.origin.x, self.origin.y)
        )


class _MapFile(BaseModel):
    """The YAML file of a map."""

    model_config = ConfigDict(allow_inf_nan=False)

    image: str = Field(min_length=1)
    resolution: float = Field(gt=0)
    origin: tuple[float, float, float]
    negate: bool
    occupied_thresh: float = Field(ge=0, le=1)
    free_thresh: float = Field(ge=0, le=1)
    mode: Literal["trinary", "scale", "raw"] = "trinary"


def read_occupancy(path: Path) -> OccupancyGrid:
    """Return the grid of a map's YAML file and the image it names."""
    described = _read_yaml(path)
    if described.free_thresh > described.occupied_thresh:
        raise ImportFileError(
            f"{path}: free_thresh: expected at most occupied_thresh "
            f"({described.occupied_thresh:g}), got {described.free_thresh:g}"
        )
    shades, opaque = _read_image(path.parent / described.image, path)
    if described.mode == "raw":
        values = np.rint(shades * 255)
        known = values <= 100
        share = values / 100
        free = known & (share < described.free_thresh)
        occupied = known & (share > described.occupied_thresh)
        saved = np.zeros_like(free)
    else:
        share = shades if described.negate else 1.0 - shades
        saved = _saved_as_unknown(shades, described)
        known = opaque if described.mode == "scale" else ~saved
        free = known & (share < described.free_thresh)
        occupied = known & (share > described.occupied_thresh)
    x, y, yaw = described.origin
    return OccupancyGrid(
        free[::-1],
        occupied[::-1],
        described.resolution,
        Pose(x, y, wrap_angle(yaw)),
        int(saved.sum()),
    )


def _saved_as_unknown(shades: NDArray[np.float64], described: _MapFile) -> Cells:
    """Return the cells that a map saver wrote as unknown and a map server reads as free.

    Nav2's saver writes 205 for unknown and 0.25 as free_thresh, which makes 205 free
    (https://github.com/SteveMacenski/slam_toolbox/issues/587).
    """
    levels = set(np.unique(np.rint(shades * 255).astype(int)).tolist())
    saved = np.rint(shades * 255) == SAVED_UNKNOWN
    if (
        described.mode == "trinary"
        and not described.negate
        and levels <= {0, SAVED_UNKNOWN, *SAVED_FREE}
        and levels & SAVED_FREE
        and described.free_thresh > 1 - SAVED_UNKNOWN / 255
    ):
        return saved
    return np.zeros_like(saved)


def _read_yaml(path: Path) -> _MapFile:
    text = read_text(path, ImportFileError)
    if len(text) > LONGEST_YAML:
        raise ImportFileError(
            f"{path}: expected the YAML file of a map, of at most {LONGEST_YAML} "
            f"characters, got {len(text)}"
        )
    try:
        record = _record(text)
        unknown_fields(record, _MapFile.model_fields)
        return _MapFile.model_validate(record)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f":{mark.line + 1}" if mark else ""
        reason = getattr(error, "problem", None) or error
        raise ImportFileError(f"{path}{line}: expected YAML, got: {reason}") from None
    except ValidationError as error:
        wrong = [f"{path}: {where}: {what}" for where, what in mistakes(error)]
        raise refusal(wrong, ImportFileError) from None
    except (ValueError, RecursionError) as error:
        reason = "nested too deep" if isinstance(error, RecursionError) else error
        raise ImportFileError(f"{path}: {reason}") from None


def _record(text: str) -> dict[str, object]:
    """Return the members of a YAML file; without references, which can be endless."""
    for token in yaml.scan(text, yaml.SafeLoader):
        if isinstance(token, yaml.AnchorToken | yaml.AliasToken):
            raise ValueError(
                "expected members with plain values, got a reference (& or *) in line "
                f"{token.start_mark.line + 1}"
            )
    root = yaml.compose(text, yaml.SafeLoader)
    if not isinstance(root, yaml.MappingNode):
        raise ValueError("expected members such as `image: map.pgm`, got none")
    names = [str(key.value) for key, _ in root.value]
    repeated = next((name for name in names if names.count(name) > 1), None)
    if repeated is not None:
        raise ValueError(f"{shown(repeated)}: expected it once, got it twice")
    return cast(dict[str, object], yaml.safe_load(text))


def _read_image(path: Path, named_in: Path) -> tuple[NDArray[np.float64], Cells]:
    """Return shades from black (0) to white (1), and which cells are opaque."""
    if not path.is_file():
        raise ImportFileError(
            f"{named_in}: image: expected the file of the map's image, got {path.name!r}, "
            f"and there is no {path}"
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(path, formats=IMAGE_FORMATS) as image:
                if math.prod(image.size) > MOST_CELLS:
                    raise ImportFileError(
                        f"{path}: expected at most {MOST_CELLS:,} cells, got "
                        f"{image.width} by {image.height}; cut the map, or halve it"
                    )
                if image.mode.startswith("I"):
                    shades = np.asarray(image, dtype=np.float64) / 65535
                    return shades, np.ones(shades.shape, dtype=bool)
                pixels = np.asarray(image.convert("LA"))
    except (Image.DecompressionBombError, Image.DecompressionBombWarning) as error:
        raise ImportFileError(f"{path}: {error}") from None
    except _UNREADABLE as error:
        raise ImportFileError(
            f"{path}: expected an image as PGM, PNG or BMP, got: {error}"
        ) from None
    return pixels[..., 0] / 255, pixels[..., 1] == 255
