"""GeoJSON of others read feature by feature: what is sound, and what is told."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import cast

import numpy as np
import shapely
from shapely import get_coordinates
from shapely.geometry import shape
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.wording import single_spaced
from memorymaze.world.importing.imported import FAR, ImportNotes, LocalFrame, listed_in

SHAPES = ("Point", "LineString", "Polygon", "MultiPolygon")


@dataclass(frozen=True, slots=True)
class SourceFeature:
    """A feature of somebody else's file."""

    id: str
    """Its own, or its place in the file."""
    properties: Mapping[str, object]
    geometry: BaseGeometry | None
    """In degrees, longitude first; None where it has none."""

    def text(self, *names: str) -> str | None:
        """Return the first of these properties that has text, in one line."""
        for name in names:
            value = self.properties.get(name)
            if isinstance(value, dict):
                labels = cast(dict[str, object], value)
                value = labels.get("en") or next(iter(labels.values()), None)
            if isinstance(value, str):
                shown = "".join(filter(str.isprintable, single_spaced(value)))
                if shown.strip():
                    return shown.strip()
        return None

    def number(self, name: str) -> float | None:
        """Return a property that is a number, also one written as text."""
        value = self.properties.get(name)
        try:
            number = (
                float(cast(str, value)) if not isinstance(value, bool) else math.nan
            )
        except (TypeError, ValueError, OverflowError):
            return None
        return number if math.isfinite(number) else None


def read_features(
    content: str | bytes, source: str, notes: ImportNotes
) -> list[SourceFeature]:
    """Return the features of a FeatureCollection that have sound geometries or none."""
    features = listed_in(content, "features", "a GeoJSON FeatureCollection", source)
    return list(_sound(features, source, notes))


def within_reach(
    features: Sequence[SourceFeature], frame: LocalFrame, notes: ImportNotes
) -> list[SourceFeature]:
    """Return the features without those too far away to be of the same building."""
    kept: list[SourceFeature] = []
    for feature in features:
        places = () if feature.geometry is None else get_coordinates(feature.geometry)
        if frame.reaches(places):
            kept.append(feature)
        else:
            notes.miss(f"features {FAR}", feature.id)
    return kept


def _sound(
    features: Sequence[object], source: str, notes: ImportNotes
) -> Iterator[SourceFeature]:
    for index, raw in enumerate(features):
        place = f"{source.rpartition('/')[2]}[{index}]"
        if not isinstance(raw, dict):
            notes.miss("features that are no GeoJSON objects", place)
            continue
        feature = cast(dict[str, object], raw)
        properties = feature.get("properties")
        known = (
            cast(dict[str, object], properties) if isinstance(properties, dict) else {}
        )
        names = (feature.get("id"), feature.get("_id"))
        identity = next(
            (name for name in names if isinstance(name, str) and name), place
        )
        geometry = feature.get("geometry")
        made = _geometry(geometry) if geometry is not None else None
        if geometry is not None and made is None:
            notes.miss("features with broken or unknown geometries", identity)
            continue
        yield SourceFeature(identity, known, made)


def _geometry(raw: object) -> BaseGeometry | None:
    """Return a geometry of finite degrees; None for what is not one."""
    if not isinstance(raw, dict):
        return None
    described = cast(dict[str, object], raw)
    if described.get("type") not in SHAPES:
        return None
    try:
        with np.errstate(invalid="ignore"):
            made = shape(described)
        places = get_coordinates(made)
    # shape() trusts what it is given: anything can come of other things.
    except (
        TypeError,
        ValueError,
        LookupError,
        AttributeError,
        OverflowError,
        shapely.errors.ShapelyError,
    ):
        return None
    sound = (abs(places[:, 0]) <= 180).all() and (abs(places[:, 1]) <= 90).all()
    return made if len(places) and sound else None
