"""A building as the meshes that cameras draw and every export is made from."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from memorymaze.pictures.kinds_of_looks import Looks
from memorymaze.pictures.rendering.mesh_looks import mesh_building
from memorymaze.pictures.rendering.meshes import Slice
from memorymaze.pictures.rendering.placed_things import (
    BuildingMesh,
    PlacedMeshes,
    placed_things,
    shadows,
)
from memorymaze.pictures.rendering.structure import structure_of
from memorymaze.sites.records import Site


class Building(NamedTuple):
    """What a building looks like."""

    meshes: Sequence[BuildingMesh]
    """Floor with all around it; doors and landmarks, in the plan's order; their shades."""
    hiding: NDArray[np.float64]
    """Pieces of wall that hide what is behind, (n, 4): x, y to x, y, metres."""


def building(site: Site, looks: Looks) -> Building:
    """Build the meshes of a site that passed the checks of `memorymaze.sites`."""
    if looks == "mesh":
        # What a mesh hides is not known beforehand.
        return Building(mesh_building(site), np.empty((0, 4)))
    structure = structure_of(site)
    pieces = [piece for made in structure.slices for piece in _pieces(made)]
    return Building(
        [*pieces, *placed_things(site, looks), *shadows(site)], structure.hiding
    )


def _pieces(made: Slice) -> Iterator[BuildingMesh]:
    low, high = made.points.min(axis=0), made.points.max(axis=0)
    x, y = ((low + high) / 2).tolist()
    radius = float(np.hypot(*(made.points - (low + high) / 2).T).max()) + 0.1
    for kind, part in made.meshes():
        placed = PlacedMeshes((part,))
        yield BuildingMesh(
            made.part_of, kind, placed, (x, y), radius, shows_sky=made.shows_sky
        )
