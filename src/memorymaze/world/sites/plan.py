"""A building written down as a plan, in the format of `docs/buildings.md`."""

import json
import math
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, Point, Polygon
from shapely.geometry.base import BaseGeometry

from memorymaze.basics.geometry.points import FloatArray
from memorymaze.basics.geometry.pose import wrap_angle

if TYPE_CHECKING:
    from memorymaze.world.sites.records import PlanPart, Site

Feature = dict[str, Any]
"""A feature of a plan as JSON has it."""
_Written = TypeVar("_Written")

HEADINGS = ("heading", "start_heading")
"""Members of records that plans have in degrees."""
FINEST_DIGITS = 15
"""Digits behind the point of degrees that are looked through."""


def site_plan(site: "Site") -> dict[str, Any]:
    """Return the plan of a building, which is read as the same building."""
    anchor = site.anchor
    return {
        "type": "FeatureCollection",
        "name": site.name,
        "title": site.title,
        "floor": site.floor,
        "ceiling_height_m": site.ceiling_height,
        "anchor": anchor
        and {
            "latitude": anchor.latitude,
            "longitude": anchor.longitude,
            "bearing_deg": degrees_of(anchor.bearing),
        },
        "description": site.description,
        **site.more,
        "features": [feature_of(part) for part in site.parts],
    }


def plan_bytes(site: "Site") -> bytes:
    """Return the plan of a building as a GeoJSON file."""
    return written_plan(site_plan(site))


def written_plan(plan: dict[str, Any]) -> bytes:
    """Return a plan as a GeoJSON file, one feature a line."""
    lines = ",\n".join(
        json.dumps(each, ensure_ascii=False) for each in plan["features"]
    )
    beside = {name: value for name, value in plan.items() if name != "features"}
    members = json.dumps(beside, ensure_ascii=False)
    # Halves of characters in members that nothing reads stay what they are in JSON.
    return f'{members[:-1]}, "features": [\n{lines}\n]}}\n'.encode(
        "utf-8", "backslashreplace"
    )


def feature_of(part: "PlanPart") -> Feature:
    """Return a part of a building as a feature of its plan."""
    shape = next(
        value for _, value in _fields_of(part) if isinstance(value, BaseGeometry)
    )
    return {
        "type": "Feature",
        "id": part.id,
        "geometry": _geometry(shape),
        "properties": {"kind": part.kind, **_members(part), **part.more},
    }


def in_millimetres(written: _Written) -> _Written:
    """Return a building or a part of one in the whole numbers that plans are made in.

    Places in millimetres, headings in hundredths of a degree, routes as long as their
    lines are then.
    """
    changed: dict[str, object] = {}
    for name, value in _fields_of(written):
        if isinstance(value, BaseGeometry):
            changed[name] = shapely.transform(value, _whole_millimetres)
        elif name == "length":
            changed[name] = round(cast(LineString, changed["line"]).length, 3)
        elif name in HEADINGS:
            changed[name] = heading_of(rounded_degrees(value))
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            changed[name] = tuple(map(in_millimetres, cast(tuple[Any, ...], value)))
    return replace(cast(Any, written), **changed)


def rounded_degrees(heading: float) -> float:
    """Return a heading in hundredths of a degree in [0, 360)."""
    return round(math.degrees(heading) % 360, 2) % 360


def heading_of(degrees: float) -> float:
    """Return a heading of a plan in radians."""
    return wrap_angle(math.radians(degrees))


def degrees_of(heading: float) -> float:
    """Return the shortest degrees that are read as a heading, in [0, 360) where any are."""
    turned = math.degrees(heading)
    for digits in range(2, FINEST_DIGITS):
        for written in (round(turned % 360, digits) % 360, round(turned, digits)):
            if heading_of(written) == heading:
                return written
    return turned % 360


def _fields_of(record: object) -> Iterator[tuple[str, Any]]:
    for each in fields(cast(Any, record)):
        yield each.name, getattr(record, each.name)


def _members(record: object) -> dict[str, object]:
    """Return what a record says beside its id and its shape, as a plan calls it."""
    told: dict[str, object] = {}
    for name, value in _fields_of(record):
        if name in ("id", "more") or isinstance(value, BaseGeometry):
            continue
        if name in HEADINGS:
            told[f"{name}_deg"] = degrees_of(value)
        elif name == "length":
            told["length_m"] = value
        elif name == "size":
            told["size_m"] = list(value)
        elif isinstance(value, tuple):
            told[name] = [_members(each) for each in cast(tuple[object, ...], value)]
        else:
            told[name] = value
    return told


def _geometry(shape: BaseGeometry) -> dict[str, object]:
    if isinstance(shape, Point):
        return {"type": "Point", "coordinates": [shape.x, shape.y]}
    if isinstance(shape, LineString):
        return {"type": "LineString", "coordinates": _places(shape)}
    polygon = cast(Polygon, shape)
    rings = (polygon.exterior, *polygon.interiors)
    return {"type": "Polygon", "coordinates": [_places(ring) for ring in rings]}


def _places(line: LineString) -> list[list[float]]:
    return shapely.get_coordinates(line).tolist()


def _whole_millimetres(places: FloatArray) -> NDArray[np.float64]:
    # Without the sign of zero.
    return np.array([
        [round(x, 3) + 0.0, round(y, 3) + 0.0] for x, y in places.tolist()
    ])
