"""Cleaning of foreign meshes: faces once, outward, few, with smooth normals.

Models for interactive viewers often hold each face twice, front and back, in any
winding, and far more of them than a robot's camera can tell.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

from memorymaze.geometry.points import FloatArray, IntArray

FLAT = 0.9999
"""Cosine between faces up to which they make a flat quad."""
HARDNESS = (2, 4, 6)
"""How hard the library presses for fewer faces, tried in turn."""
LEAST_AREA = 0.7
"""Share of a surface's area that must remain."""
MANY, LARGEST_SHARE = 40, 0.06
"""Foliage has more pieces than this, and none with more than this share of its area."""
LARGEST_LEAF = 40
"""Mean faces of a leaf up to which leaves need not be simplified themselves."""
GROWTH = 1.7
"""Foliage that is left grows at most so much in length, for what was taken away."""
CREASE = math.cos(math.radians(42))
"""Neighbouring faces that meet at less than this angle share their shading."""


@dataclass(frozen=True, slots=True, eq=False)
class MaterialSurface:
    """Triangles of one material."""

    vertices: FloatArray
    """(N, 3)."""
    faces: IntArray
    """(M, 3)."""
    uv: FloatArray | None = None
    """(N, 2)."""


def cleaned(surface: MaterialSurface) -> MaterialSurface:
    """Join equal vertices; drop faces without area and faces that lie twice."""
    span = float(np.ptp(surface.vertices, axis=0).max()) or 1.0
    keys = np.round(surface.vertices / (span * 1e-5))
    places = row_numbers(keys)
    if surface.uv is not None:
        keys = np.column_stack([keys, np.round(surface.uv * 1e4)])
    _, first, joined = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    faces = joined.reshape(-1)[surface.faces]
    corners = np.sort(places[surface.faces], axis=1)
    sound = (corners[:, 0] < corners[:, 1]) & (corners[:, 1] < corners[:, 2])
    faces, corners = faces[sound], corners[sound]
    _, once = np.unique(corners, axis=0, return_index=True)
    once = np.sort(once)
    faces, corners = faces[once], corners[once]
    spots = np.zeros((len(surface.vertices), 3))
    spots[places] = surface.vertices
    faces = faces[~_split_the_other_way(spots, corners)]
    uv = None if surface.uv is None else surface.uv[first]
    return MaterialSurface(surface.vertices[first], faces, uv)


def _split_the_other_way(spots: FloatArray, corners: IntArray) -> NDArray[np.bool_]:
    """Find quads that lie twice, cut along both diagonals, and tell the second cuts.

    The faces' corners (M, 3) are numbers of spots (N, 3), ascending.
    """
    again = np.zeros(len(corners), dtype=bool)
    sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [0, 2]]])
    first, second = pairs_in_groups(row_numbers(sides))
    first, second = first % len(corners), second % len(corners)
    pairs = np.column_stack([first, second])[first < second]
    if not len(pairs):
        return again
    # Of six corners two are those of the cut, each there twice.
    four = np.sort(corners[pairs].reshape(-1, 6), axis=1)
    twice = np.column_stack([np.zeros(len(four), bool), four[:, 1:] == four[:, :-1]])
    once = ~twice & ~np.column_stack([twice[:, 1:], np.zeros(len(four), bool)])
    here, there = (spots[four[twice].reshape(-1, 2)[:, end]] for end in (0, 1))
    left, right = (spots[four[once].reshape(-1, 2)[:, end]] for end in (0, 1))
    first_up = directions(np.cross(there - here, left - here))
    second_up = directions(np.cross(there - here, right - here))
    flat = np.einsum("ij,ij->i", first_up, second_up) < -FLAT
    pairs, four, twice = pairs[flat], four[flat], twice[flat]
    quads = row_numbers(four[~twice].reshape(-1, 4))
    cuts = row_numbers(four[twice].reshape(-1, 2))
    first_cut: dict[int, int] = {}
    needed = np.zeros(len(corners), dtype=bool)
    for row, (quad, pair) in enumerate(zip(quads.tolist(), pairs, strict=True)):
        before = first_cut.setdefault(quad, row)
        # In larger polygons a face has several partners; what covers one quad stays.
        if (
            cuts[row] == cuts[before]
            or again[pairs[before]].any()
            or needed[pair].any()
        ):
            continue
        needed[pairs[before]] = True
        again[pair] = True
    return again


def thinned(
    surface: MaterialSurface, target: int, rng: np.random.Generator
) -> MaterialSurface:
    """Return a surface of about `target` faces or fewer that looks alike.

    Foliage loses whole leaves and the others grow (Cook, Halstead, Planck, Ryu 2007,
    "Stochastic simplification of aggregate detail"); else edges collapse where the
    shape changes least (Garland and Heckbert 1997).
    """
    if len(surface.faces) <= target:
        return surface
    if not _is_foliage(surface):
        return _collapsed(surface, target)
    pieces = _pieces(surface)
    if len(surface.faces) > LARGEST_LEAF * (pieces.max() + 1):
        surface = _collapsed(surface, max(target, len(surface.faces) // 4))
        pieces = _pieces(surface)
    return _fewer_leaves(surface, pieces, target, rng)


def finished(
    surface: MaterialSurface,
) -> tuple[FloatArray, IntArray, FloatArray, FloatArray | None]:
    """Turn faces outward, show open surfaces from both sides, and shade smoothly.

    Returns vertices (N, 3), faces (M, 3), unit normals (N, 3) and pictures' (N, 2).
    """
    places = same_places(surface.vertices)
    faces, closed = turned_outward(surface.vertices, surface.faces, places)
    turned = faces[~closed][:, ::-1]
    # Back sides must not share normals with the front, so they get corners of their own.
    backs = places.max() + 1 + places if len(turned) else places
    corners = np.concatenate([faces, turned]).reshape(-1)
    groups = np.concatenate([places[faces], backs[turned]]).reshape(-1)
    points = surface.vertices[corners]
    normals = smooth_normals(points.reshape(-1, 3, 3), groups)
    uv = None if surface.uv is None else surface.uv[corners]
    rows = np.column_stack([
        points,
        np.round(normals, 3),
        *([] if uv is None else [uv]),
    ])
    _, first, joined = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return (
        points[first],
        joined.reshape(-1, 3),
        normals[first],
        None if uv is None else uv[first],
    )


def _collapsed(surface: MaterialSurface, target: int) -> MaterialSurface:
    """Collapse edges; gently if that is enough, and never at the cost of whole parts."""
    best = surface
    for hardness in HARDNESS:
        made = _collapsed_so_hard(surface, target, hardness)
        if _areas(made).sum() < LEAST_AREA * _areas(surface).sum():
            break
        best = made
        if len(made.faces) <= 1.1 * target:
            break
    return best


def _collapsed_so_hard(
    surface: MaterialSurface, target: int, hardness: int
) -> MaterialSurface:
    import fast_simplification

    points = surface.vertices.astype(np.float32)
    shrunk: Any = fast_simplification.simplify(
        points,  # pyright: ignore[reportArgumentType]  # it wants single precision
        surface.faces.astype(np.int32),
        target_count=target,
        agg=hardness,
        return_collapses=True,
    )
    made, faces, collapses = shrunk
    if not len(faces):
        return replace(surface, faces=surface.faces[:0])
    uv = surface.uv
    if uv is not None:
        _, _, went_to = fast_simplification.replay_simplification(
            points, surface.faces.astype(np.int32), collapses
        )
        uv = _nearest_uv(surface, np.asarray(made), np.asarray(went_to))
    return cleaned(
        MaterialSurface(np.asarray(made, float), np.asarray(faces, np.int64), uv)
    )


def _areas(surface: MaterialSurface) -> FloatArray:
    """Return the area of each face."""
    corners = surface.vertices[surface.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.linalg.norm(across, axis=1) / 2


def _nearest_uv(
    surface: MaterialSurface, made: FloatArray, went_to: IntArray
) -> FloatArray:
    """Give each vertex the picture's place of the nearest one that became it."""
    assert surface.uv is not None
    distance = np.linalg.norm(surface.vertices - made[went_to], axis=1)
    order = np.lexsort((distance, went_to))
    targets, first = np.unique(went_to[order], return_index=True)
    uv = np.zeros((len(made), 2))
    uv[targets] = surface.uv[order[first]]
    return uv


def _fewer_leaves(
    surface: MaterialSurface, pieces: IntArray, target: int, rng: np.random.Generator
) -> MaterialSurface:
    count = int(pieces.max()) + 1
    share = min(1.0, target / len(surface.faces))
    kept = rng.random(count) < share
    if not kept.any():
        kept[0] = True
    grown = min(GROWTH, math.sqrt(1 / share))
    piece_of_vertex = np.zeros(len(surface.vertices), dtype=np.int64)
    piece_of_vertex[surface.faces] = pieces[:, None]
    sums = np.zeros((count, 3))
    np.add.at(sums, piece_of_vertex, surface.vertices)
    sizes = np.bincount(piece_of_vertex, minlength=count)[:, None]
    middles = (sums / np.maximum(sizes, 1))[piece_of_vertex]
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    vertices = np.clip(middles + (surface.vertices - middles) * grown, low, high)
    return replace(surface, vertices=vertices, faces=surface.faces[kept[pieces]])


def _is_foliage(surface: MaterialSurface) -> bool:
    """Tell whether it is made of many pieces, none of which matters much."""
    pieces = _pieces(surface)
    areas = np.bincount(pieces, _areas(surface))
    return len(areas) > MANY and areas.max() < LARGEST_SHARE * areas.sum()


def _pieces(surface: MaterialSurface) -> IntArray:
    """Return the number of the connected piece that each face belongs to."""
    places = same_places(surface.vertices)[surface.faces]
    count = int(places.max()) + 1
    links = coo_array(
        (
            np.ones(2 * len(places)),
            (np.tile(places[:, 0], 2), np.concatenate([places[:, 1], places[:, 2]])),
        ),
        shape=(count, count),
    )
    _, labels = connected_components(links, directed=False)
    return row_numbers(labels[places[:, 0]][:, None])


def turned_outward(
    vertices: FloatArray, faces: IntArray, places: IntArray
) -> tuple[IntArray, NDArray[np.bool_]]:
    """Return the faces, closed pieces turned outward, and which belong to these."""
    count = len(faces)
    starts = places[faces].reshape(-1)
    ends = places[np.roll(faces, -1, axis=1)].reshape(-1)
    owner = np.repeat(np.arange(count), 3)
    edges = row_numbers(
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


def smooth_normals(corners: FloatArray, groups: IntArray) -> FloatArray:
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


def directions(vectors: FloatArray) -> FloatArray:
    """Return vectors of length 1, (N, 3)."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)


def pairs_in_groups(groups: IntArray) -> tuple[IntArray, IntArray]:
    """Return all ordered pairs of rows of the same group, each with itself too."""
    order = np.argsort(groups, kind="stable")
    starts = np.flatnonzero(np.diff(groups[order], prepend=-1))
    counts = np.diff(np.append(starts, len(order)))
    partners = np.repeat(counts, counts)
    first = np.repeat(np.arange(len(order)), partners)
    nth = np.arange(len(first)) - np.repeat(np.cumsum(partners) - partners, partners)
    second = np.repeat(np.repeat(starts, counts), partners) + nth
    return order[first], order[second]


def same_places(vertices: FloatArray) -> IntArray:
    """Return equal numbers for vertices that are at one place, to rounding."""
    span = float(np.ptp(vertices, axis=0).max()) or 1.0
    return row_numbers(np.round(vertices / (span * 1e-5)))


def row_numbers(rows: FloatArray | IntArray) -> IntArray:
    """Return equal numbers for equal rows, from 0 on."""
    return np.unique(rows, axis=0, return_inverse=True)[1].reshape(-1)
