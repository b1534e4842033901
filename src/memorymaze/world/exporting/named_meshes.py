"""A building as meshes with the names of its plan, which every format is made from."""

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from shapely import Polygon

from memorymaze.world.looks import OWN
from memorymaze.world.looks.assembly import MeshPart
from memorymaze.world.looks.building import building
from memorymaze.world.looks.materials import Material
from memorymaze.world.looks.meshes import BuildingMesh, PlacedMeshes
from memorymaze.world.sites.plan import feature_of, site_plan
from memorymaze.world.sites.records import PlanPart, Site

Attributes = Mapping[str, object]
"""What the plan says of a feature, as JSON takes it; nothing stands for null."""
FLOOR_FEATURES = ("corridor", "area", "turning_point")
"""Kinds of features that are floor."""


@dataclass(frozen=True, slots=True, eq=False)
class NamedMesh:
    """A feature of the plan with its meshes, or a part of the building around it."""

    name: str
    """The feature's id, or, for what the plan has no feature for, that of the piece of
    floor or the thing it belongs to with a word after a slash: `c_west/wall`."""
    attributes: Attributes
    """`id` and `kind`; of a feature its properties and its geometry as the plan has
    them; of other parts `part_of`, the id of what they belong to."""
    placed: PlacedMeshes
    """Metres, z up, in the plan's frame; without any parts for what is only a place."""

    @property
    def kind(self) -> str:
        """`corridor`, `door`, … as in plans, or `ceiling`, `wall`, `beyond`, `shade`."""
        return str(self.attributes["kind"])

    @property
    def label(self) -> str:
        """What it is called where pixels get classes: `floor`, `door`, `bench`, …."""
        if self.kind in FLOOR_FEATURES:
            return "floor"
        return str(self.attributes.get("category", self.kind)).lower()


def named_meshes(site: Site) -> Iterator[NamedMesh]:
    """Yield a building: floor with all around it, doors, things, and rooms as places.

    Things have this project's own looks, never models that carry others' licences.
    """
    attributes = feature_attributes(site)
    found: dict[tuple[str, str], list[BuildingMesh]] = defaultdict(list)
    for mesh in building(site, OWN).meshes:
        found[mesh.owner, mesh.kind].append(mesh)
    for feature in (*site.corridors, *site.areas, *site.turning_points):
        floor = found.pop((feature.id, "floor"), None)
        # Another feature may cover all of its floor: then it is a place only.
        placed = _together(floor) if floor else _place(feature.polygon)
        yield NamedMesh(feature.id, attributes[feature.id], placed)
    for (owner, kind), meshes in found.items():
        placed = _together(meshes)
        if meshes[0].thing is None:
            word = "shade" if kind == "decal" else kind
            name = f"{owner}/{word}"
            of = {"id": name, "kind": word, "part_of": owner}
            yield NamedMesh(name, of, placed)
        else:
            yield NamedMesh(owner, attributes[owner], placed)
    for room in site.rooms:
        yield NamedMesh(room.id, attributes[room.id], _place(room.polygon))


def feature_attributes(site: Site) -> Mapping[str, Attributes]:
    """Return what a plan says of each feature, by its id."""
    return {part.id: _attributes(part) for part in site.parts}


def site_file_stem(site: Site) -> str:
    """Return the name of a site as every file system takes it."""
    return re.sub(r"[^\w-]+", "_", site.name)


def plan_members(site: Site) -> Attributes:
    """Return what a plan says beside features that have a place: members, routes."""
    routes = [_attributes(route) for route in site.routes]
    plan = {**site_plan(site), "features": None, "type": None}
    return _without_null({**plan, "routes": routes or None})


def _place(polygon: Polygon) -> PlacedMeshes:
    place = polygon.representative_point()
    return PlacedMeshes((), place.x, place.y)


def _together(meshes: Sequence[BuildingMesh]) -> PlacedMeshes:
    """Join the parts of each material of pieces whose vertices are in the plan's frame."""
    if len(meshes) == 1:
        return meshes[0].placed
    by_material: dict[Material, list[MeshPart]] = defaultdict(list)
    for mesh in meshes:
        for part in mesh.placed.parts:
            by_material[part.material].append(part)
    return PlacedMeshes([_joined(each) for each in by_material.values()])


def _joined(parts: Sequence[MeshPart]) -> MeshPart:
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    return MeshPart(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([
            part.faces + np.int32(start)
            for part, start in zip(parts, starts, strict=False)
        ]),
        np.concatenate([part.normals for part in parts if part.normals is not None]),
        np.concatenate([part.uv for part in parts if part.uv is not None]),
        parts[0].material,
    )


def _attributes(part: PlanPart) -> Attributes:
    feature = feature_of(part)
    return _without_null({
        **feature["properties"],
        "id": feature["id"],
        "geometry": feature["geometry"],
    })


def _without_null(members: Attributes) -> Attributes:
    return {name: value for name, value in members.items() if value is not None}
