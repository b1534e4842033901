"""What an importer gives, and the frame and the lines that it is made from."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import TypeVar, cast

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.errors import ImportFileError, SettingsError, did_you_mean
from memorymaze.basics.geometry.points import XY
from memorymaze.basics.input_files import parse_json, shown
from memorymaze.basics.wording import single_spaced
from memorymaze.world.sites.loading_rules import FLOOR_ACROSS
from memorymaze.world.sites.plan import in_millimetres
from memorymaze.world.sites.records import Anchor, PlanPart, Site, parts_by_kind

_Shape = TypeVar("_Shape", bound=BaseGeometry)
EQUATOR_RADIUS = 6_378_137.0
"""Metres (WGS 84)."""
FAR = f"more than {FLOOR_ACROSS / 2:.0f} m from the middle of the rest"
"""Why a feature is left out that the frame does not reach."""
CEILING = 2.8
"""Metres; none of the formats tells."""
FLATTENING = 1 / 298.257223563
"""Of the same ellipsoid."""


@dataclass(frozen=True, slots=True)
class CentreLine:
    """The middle line of a way one can walk."""

    points: tuple[XY, ...]
    width: float
    """Metres from wall to wall."""
    name: str | None = None
    """What people call the way."""


@dataclass(frozen=True, slots=True)
class ImportedSite:
    """A building from elsewhere, with what a person must know of it."""

    site: Site
    """Called like the file."""
    took: tuple[str, ...]
    """What the file said, such as `34 doors`."""
    guessed: tuple[str, ...]
    """What it did not say and the plan needs, and what was moved to fit."""
    missing: tuple[str, ...]
    """What is not in the building: left out, with the feature's id, or never in the file."""


@dataclass
class ImportNotes:
    """Lines for a person, gathered while a file is read."""

    took: list[str] = field(default_factory=list[str])
    guessed: list[str] = field(default_factory=list[str])
    missing: list[str] = field(default_factory=list[str])
    _features: dict[tuple[bool, str], list[str]] = field(
        default_factory=dict[tuple[bool, str], list[str]]
    )

    def guess(self, what: str, feature: str) -> None:
        """Note a feature of which something was guessed; likes share a line."""
        self._features.setdefault((True, what), []).append(feature)

    def miss(self, what: str, feature: str) -> None:
        """Note a feature that was left out, with the reason; likes share a line."""
        self._features.setdefault((False, what), []).append(feature)

    def guess_looks(self) -> None:
        """Note what a plan has and formats for finding one's way do not."""
        self.guessed.append(
            f"ceiling height: {CEILING} m; materials of floors and walls; colours of "
            "doors; sizes of things by their kinds"
        )

    def imported(self, site: Site) -> ImportedSite:
        """Return a building with these lines."""
        lines: dict[bool, list[str]] = {True: [], False: []}
        for (guessed, what), features in self._features.items():
            shown = ", ".join(single_spaced(each) for each in features)
            lines[guessed].append(f"{what} ({len(features)}): {shown}")
        return ImportedSite(
            site,
            tuple(self.took),
            (*self.guessed, *lines[True]),
            (*self.missing, *lines[False]),
        )


@dataclass(frozen=True, slots=True)
class LocalFrame:
    """Metres around a place on the globe, x east and y north.

    The ellipsoid's two radii of curvature there scale degrees to metres; a kilometre away
    this is off by some centimetres.
    """

    longitude: float
    latitude: float

    @classmethod
    def around(cls, positions: Sequence[tuple[float, float]]) -> "LocalFrame":
        """Return the frame in the middle of positions (longitude, latitude)."""
        return cls(*(round(median(each), 7) for each in zip(*positions, strict=True)))

    def reaches(self, positions: Iterable[Sequence[float]]) -> bool:
        """Tell whether places are near enough to be of the same building."""
        return all(
            math.hypot(*self.metres(*each[:2])) <= FLOOR_ACROSS / 2
            for each in positions
        )

    @property
    def anchor(self) -> Anchor:
        """Where it lies on the globe, as sites have it."""
        return Anchor(self.latitude, self.longitude, 0.0)

    def metres(self, longitude: float, latitude: float) -> XY:
        """Return where a place on the globe lies in this frame."""
        squared = FLATTENING * (2 - FLATTENING)
        slope = math.radians(self.latitude)
        bend = 1 - squared * math.sin(slope) ** 2
        across = EQUATOR_RADIUS / math.sqrt(bend) * math.cos(slope)
        along = EQUATOR_RADIUS * (1 - squared) / bend**1.5
        return (
            math.radians(longitude - self.longitude) * across,
            math.radians(latitude - self.latitude) * along,
        )

    def placed(self, geometry: _Shape) -> _Shape:
        """Return a geometry of degrees in this frame."""

        def moved(positions: NDArray[np.float64]) -> NDArray[np.float64]:
            return np.array([self.metres(*each) for each in positions]).reshape(-1, 2)

        return shapely.transform(shapely.force_2d(geometry), moved)


def listed_in(
    content: str | bytes, member: str, what: str, source: str
) -> list[object]:
    """Return the list that a JSON document has as a member.

    Raises:
        ImportFileError: It is no JSON, or has no such list; tells `what` was expected.
    """
    try:
        document = parse_json(content)
    except ValueError as error:
        raise ImportFileError(f"{source}: {error}") from None
    listed = (
        cast(dict[str, object], document).get(member)
        if isinstance(document, dict)
        else None
    )
    if not isinstance(listed, list):
        raise ImportFileError(
            f'{source}: expected {what} with "{member}", got {shown(document)}'
        )
    return cast(list[object], listed)


def chosen_floor(floors: Mapping[float, str], asked: str | None, source: str) -> float:
    """Return the key of the floor that is asked for by name or key, or of the only one."""
    if asked is None and len(floors) == 1:
        return next(iter(floors))
    wanted = (asked or "").strip().casefold()
    # Names come first: ordinals 0, 1, 2 may be called -1, 0, 1.
    named = [(name, key) for key, name in floors.items()]
    for name, key in (*named, *((f"{key:g}", key) for key in floors)):
        if wanted == name.casefold():
            return key
    known = ", ".join(floors.values())
    if asked is None:
        raise SettingsError(
            f"{source}: has several floors; choose one: --floor {known}"
        )
    raise SettingsError(
        f"{source}: expected a floor of {known}, got {asked!r}"
        f"{did_you_mean(asked, floors.values())}"
    )


def imported_building(
    path: Path,
    title: str | None,
    floor: str,
    anchor: Anchor | None,
    parts: Iterable[PlanPart],
    ceiling: float = CEILING,
) -> Site:
    """Return a building, named like its file."""
    name = re.sub("[^a-z0-9]+", "_", path.stem.lower()).strip("_") or "imported"
    return in_millimetres(
        Site(
            name=name,
            title=title or name.replace("_", " ").capitalize(),
            floor=floor,
            ceiling_height=ceiling,
            description=f"Imported from {single_spaced(path.name)}.",
            anchor=anchor,
            **parts_by_kind(parts),
        )
    )
