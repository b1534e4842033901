"""Features of a plan written down, in the format of `docs/site_plans.md`."""

import json
import math
from collections.abc import Sequence

from shapely import Polygon

Feature = dict[str, object]


def plan_bytes(header: dict[str, object], features: Sequence[Feature]) -> bytes:
    """Return a plan as a GeoJSON file, one feature a line."""
    members = json.dumps({"type": "FeatureCollection", **header}, ensure_ascii=False)
    lines = ",\n".join(json.dumps(each, ensure_ascii=False) for each in features)
    text = f'{members[:-1]}, "features": [\n{lines}\n]}}\n'
    # JSON can say halves of characters, UTF-8 cannot.
    return text.encode(errors="backslashreplace")


def feature(
    identity: str, kind: str, geometry: dict[str, object], **properties: object
) -> Feature:
    """Return a feature of a kind."""
    return {
        "type": "Feature",
        "id": identity,
        "geometry": geometry,
        "properties": {"kind": kind, **properties},
    }


def polygon_feature(
    identity: str, kind: str, polygon: Polygon, **properties: object
) -> Feature:
    """Return a feature that covers a polygon."""
    rings = [
        [position((x, y)) for x, y, *_ in ring.coords]
        for ring in (polygon.exterior, *polygon.interiors)
    ]
    return feature(
        identity, kind, {"type": "Polygon", "coordinates": rings}, **properties
    )


def line_feature(
    identity: str,
    kind: str,
    places: Sequence[tuple[float, float]],
    **properties: object,
) -> Feature:
    """Return a feature along a line."""
    line = [position(place) for place in places]
    return feature(
        identity, kind, {"type": "LineString", "coordinates": line}, **properties
    )


def point_feature(
    identity: str, kind: str, place: tuple[float, float], **properties: object
) -> Feature:
    """Return a feature at a place."""
    return feature(
        identity, kind, {"type": "Point", "coordinates": position(place)}, **properties
    )


def position(place: tuple[float, float]) -> list[float]:
    """Return a place with whole millimetres."""
    return [round(place[0], 3) + 0.0, round(place[1], 3) + 0.0]


def degrees(heading: float) -> float:
    """Return a heading in degrees in [0, 360)."""
    return round(math.degrees(heading) % 360, 2) % 360
