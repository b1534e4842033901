"""Sides and corners of meshes: which way faces look, where they meet, how they shade."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

CREASE = math.cos(math.radians(42))
"""Neighbouring faces that meet at less than this angle share their shading."""


def turned_outward(
    vertices: Floats, faces: Ints, places: Ints
) -> tuple[Ints, NDArray[np.bool_]]:
    """Return the faces, closed pieces turned outward, and which belong to these."""
    count = len(faces)
    starts = places[faces].reshape(-1)
    ends = places[np.roll(faces, -1, axis=1)].reshape(-1)
    owner = np.repeat(np.arange(count), 3)
    edges = numbered(
        np.column_stack([np.minimum(starts, ends), np.maximum(starts, ends)])
    )
    shared = np.bincount(edges)[edges] == 2
    order = np.argsort(edges[shared], kind="stable")
    pairs = np.flatnonzero(shared)[order].reshape(-1, 2)
    first, second = owner[pairs[:, 0]], owner[pairs[:, 1]]
    agree = starts[pairs[:, 0]] != starts[pairs[:, 1]]
    links = csr_array(
        coo_array((np.where(agree, 1, 2), (first, second)), shape=(count, count))
    )
    links = links + links.T
    pieces, labels = connected_components(links, directed=False)
    flipped = np.zeros(count, dtype=bool)
    # Faces that share two edges would add up; such pieces count as open.
    relation = links.todok()
    open_edges = np.bincount(labels[owner[~shared]], minlength=pieces) > 0
    closed = ~open_edges[labels]
    for piece in np.flatnonzero(~open_edges):
        start = int(np.flatnonzero(labels == piece)[0])
        walk, before = breadth_first_order(links, start, directed=False)
        for face in walk[1:].tolist():
            previous = int(before[face])
            flipped[face] = flipped[previous] ^ (relation[previous, face] == 2)
    faces = np.where(flipped[:, None], faces[:, ::-1], faces)
    corners = vertices[faces]
    volumes = np.einsum(
        "ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])
    )
    inside_out = np.bincount(labels, volumes, minlength=pieces) < 0
    faces = np.where((inside_out[labels] & closed)[:, None], faces[:, ::-1], faces)
    return faces, closed


def smooth_normals(corners: Floats, groups: Ints) -> Floats:
    """Return a normal per corner: the mean over like-minded faces at its vertex."""
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sizes = np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    flat = across / sizes
    owner = np.repeat(np.arange(len(corners)), 3)
    first, second = pairs_in_groups(groups)
    mine, other = owner[first], owner[second]
    alike = np.einsum("ij,ij->i", flat[mine], flat[other]) > CREASE
    sums = np.zeros((len(owner), 3))
    for axis in range(3):
        sums[:, axis] = np.bincount(
            first[alike], across[other[alike], axis], len(owner)
        )
    lengths = np.linalg.norm(sums, axis=1, keepdims=True)
    return np.where(lengths > 1e-12, sums / np.maximum(lengths, 1e-12), flat[owner])


def directions(vectors: Floats) -> Floats:
    """Return vectors of length 1, (N, 3)."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)


def pairs_in_groups(groups: Ints) -> tuple[Ints, Ints]:
    """Return all ordered pairs of rows of the same group, each with itself too."""
    order = np.argsort(groups, kind="stable")
    starts = np.flatnonzero(np.diff(groups[order], prepend=-1))
    counts = np.diff(np.append(starts, len(order)))
    partners = np.repeat(counts, counts)
    first = np.repeat(np.arange(len(order)), partners)
    nth = np.arange(len(first)) - np.repeat(np.cumsum(partners) - partners, partners)
    second = np.repeat(np.repeat(starts, counts), partners) + nth
    return order[first], order[second]


def same_places(vertices: Floats) -> Ints:
    """Return equal numbers for vertices that are at one place, to rounding."""
    span = float(np.ptp(vertices, axis=0).max()) or 1.0
    return numbered(np.round(vertices / (span * 1e-5)))


def numbered(rows: Floats | Ints) -> Ints:
    """Return equal numbers for equal rows, from 0 on."""
    return np.unique(rows, axis=0, return_inverse=True)[1].reshape(-1)
