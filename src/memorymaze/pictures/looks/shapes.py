"""Shapes without material: boxes, plates, turned, extruded and cut solids."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise, product
from typing import Literal, NamedTuple

import numpy as np
import shapely

from memorymaze.geometry.points import FloatArray, IntArray

Axis = Literal["x", "y", "z"]
AxisSpan = tuple[float, float]
"""From and to along an axis, metres."""


class Extent(NamedTuple):
    """From where to where a thing reaches along an axis, metres."""

    low: float
    high: float

    def start(self, first: float, second: float | None = None) -> AxisSpan:
        """Return the first metres of it, or what lies between two distances from there."""
        if second is None:
            return self.low, self.low + first
        return self.low + first, self.low + second

    def end(self, first: float, second: float = 0.0) -> AxisSpan:
        """Return its last metres, or what lies between two distances from its end."""
        return self.high - first, self.high - second

    def inset(self, first: float, second: float | None = None) -> AxisSpan:
        """Return it less a margin at its beginning and the same or another at its end."""
        return self.low + first, self.high - (first if second is None else second)


THINNEST = 1e-4
"""Metres of material that even a box without thickness has."""
SOFT_BEND_DEG = 40.0
"""Bends of an outline up to this angle look round, sharper ones like an edge."""


@dataclass(frozen=True, slots=True, eq=False)
class Shape:
    """Triangles counter-clockwise from outside; metres. Moves return a new shape."""

    vertices: FloatArray
    """(N, 3)."""
    faces: IntArray
    """(M, 3)."""
    normals: FloatArray
    """(N, 3), unit."""
    uv: FloatArray | None = None
    """(N, 2) in [0, 1] from the top left; None: laid on from the sides."""

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Shape":
        """Return it shifted."""
        return Shape(
            self.vertices + np.array((x, y, z)), self.faces, self.normals, self.uv
        )

    def turned(self, axis: Axis, degrees: float) -> "Shape":
        """Return it turned about an axis through the origin, by the right-hand rule."""
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        first, second = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        turn = np.eye(3)
        turn[first, first] = turn[second, second] = c
        turn[first, second], turn[second, first] = -s, s
        return Shape(self.vertices @ turn.T, self.faces, self.normals @ turn.T, self.uv)

    def scaled(self, x: float = 1.0, y: float = 1.0, z: float = 1.0) -> "Shape":
        """Return it stretched along the axes; negative factors mirror it."""
        factors = np.array((x, y, z))
        normals = self.normals / factors
        normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        faces = self.faces if x * y * z > 0 else self.faces[:, ::-1]
        return Shape(self.vertices * factors, faces, normals, self.uv)


def joined(*shapes: Shape) -> Shape:
    """Return one shape with all triangles of the given ones.

    Pictures are kept where every shape has one.
    """
    starts = np.cumsum([0, *(len(shape.vertices) for shape in shapes)])
    pictures = [shape.uv for shape in shapes if shape.uv is not None]
    return Shape(
        np.concatenate([shape.vertices for shape in shapes]),
        np.concatenate([
            shape.faces + start for shape, start in zip(shapes, starts, strict=False)
        ]),
        np.concatenate([shape.normals for shape in shapes]),
        np.concatenate(pictures) if len(pictures) == len(shapes) else None,
    )


def cross_products(first: FloatArray, second: FloatArray) -> FloatArray:
    """Return the cross products of rows; `numpy.cross` is slow on few of them."""
    (a, b, c), (d, e, f) = first.T, second.T
    return np.column_stack([b * f - c * e, c * d - a * f, a * e - b * d])


def smoothed_shape(vertices: FloatArray, faces: IntArray) -> Shape:
    """Return a shape whose normals are the area-weighted means of the faces' normals.

    Triangles without area are dropped.
    """
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    across = cross_products(b - a, c - a)
    sound = np.einsum("ij,ij->i", across, across) > 1e-18
    faces, across = faces[sound], across[sound]
    normals = np.zeros_like(vertices)
    for axis in range(3):
        normals[:, axis] = np.bincount(
            faces.ravel(), np.repeat(across[:, axis], 3), len(vertices)
        )
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 0, normals / np.maximum(lengths, 1e-12), (0, 0, 1))
    return Shape(vertices, faces, normals)


def around(middle: float, half: float) -> AxisSpan:
    """Return the span that reaches so far to either side of its middle."""
    return middle - half, middle + half


def span_between(one: float, other: float) -> AxisSpan:
    """Return the span from the smaller of two numbers to the larger."""
    return (one, other) if one < other else (other, one)


def span_within(span: AxisSpan, margin: float) -> AxisSpan:
    """Return a span less a margin at both ends."""
    return span[0] + margin, span[1] - margin


def box(x: AxisSpan, y: AxisSpan, z: AxisSpan, bevel: float = 0.0) -> Shape:
    """Return an upright box: from back to front, across, from bottom to top.

    Its edges lose `bevel` metres, shaded round; at most half its smallest side.
    """
    low, high = _corners(x, y, z)
    half = (high - low) / 2
    if bevel <= 0:
        signs, normals, faces = _box_template()
        return Shape((low + high) / 2 + signs * half, faces, normals)
    bevel = min(bevel, *(half * 0.999))
    signs, normals, faces = _bevelled_template()
    points = signs * (half - bevel) + normals * bevel
    return Shape((low + high) / 2 + points, faces, normals)


def tapered(
    x: AxisSpan, y: AxisSpan, z: AxisSpan, top_x: AxisSpan, top_y: AxisSpan
) -> Shape:
    """Return a block whose top is another rectangle than its bottom, with flat faces."""
    signs, _, faces = _box_template()
    low, high = _corners(x, y, z)
    top_low, top_high = _corners(top_x, top_y, z)
    up = signs[:, 2:] > 0
    points = np.where(
        signs > 0, np.where(up, top_high, high), np.where(up, top_low, low)
    )
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    across = cross_products(b - a, c - a)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    normals = np.empty_like(points)
    for corner in range(3):
        normals[faces[:, corner]] = across
    return Shape(points, faces, normals)


def plate(
    x: AxisSpan,
    y: AxisSpan,
    z: AxisSpan,
    *,
    both_sides: bool = False,
    roof: bool = False,
) -> Shape:
    """Return a box whose front shows a whole picture; its rim has a corner's colour.

    With `both_sides` the back shows it too, readable from there; with `roof` the top
    and not the front, readable from the front.
    """
    signs, normals, faces = _box_template()
    low, high = _corners(x, y, z)
    points = (low + high) / 2 + signs * (high - low) / 2
    uv = np.full((len(points), 2), 0.004)
    right, top = (signs[:, 1] + 1) / 2, (signs[:, 2] + 1) / 2
    picture = np.column_stack([right, 1 - top])
    front = normals[:, 2] > 0.5 if roof else normals[:, 0] > 0.5
    if roof:
        picture = np.column_stack([right, (signs[:, 0] + 1) / 2])
    uv[front] = picture[front]
    if both_sides:
        back = normals[:, 0] < -0.5
        uv[back] = np.column_stack([1 - right, 1 - top])[back]
    return Shape(points, faces, normals, uv)


def pane(x: float, y: AxisSpan, z: AxisSpan) -> Shape:
    """Return a single rectangle that is seen from the front."""
    points = np.array([
        (x, y[0], z[0]),
        (x, y[1], z[0]),
        (x, y[1], z[1]),
        (x, y[0], z[1]),
    ])
    return Shape(
        points, np.array([(0, 1, 2), (0, 2, 3)]), np.tile((1.0, 0.0, 0.0), (4, 1))
    )


def lathed(
    profile: Sequence[tuple[float, float]],
    sides: int = 16,
    *,
    radius: float = 1.0,
    height: float = 1.0,
    z: float = 0.0,
) -> Shape:
    """Return a solid turned about the z axis, its circles with so many corners.

    The profile has radius and height, from the lowest to the highest point of the
    outside, as multiples of `radius` and `height`; it is closed with flat ends where it
    does not start or end on the axis. A picture is wrapped round it once, its middle at
    the front, its top at the end of the profile.
    """
    points = ((float(radius * r), float(z + height * up)) for r, up in profile)
    return _lathed(tuple(points), sides)


@cache
def _lathed(profile: tuple[tuple[float, float], ...], sides: int) -> Shape:
    points = [profile[0]]
    points += [b for a, b in pairwise(profile) if math.dist(a, b) > 1e-9]
    if points[0][0] > 0:
        points.insert(0, (0.0, points[0][1]))
    if points[-1][0] > 0:
        points.append((0.0, points[-1][1]))
    angles = (np.arange(sides + 1) % sides) * (2 * math.pi / sides) + math.pi
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    lengths = [math.dist(a, b) for a, b in pairwise(points)]
    up = np.cumsum([0.0, *lengths]) / sum(lengths)
    turn = np.linspace(0, 1, sides + 1)
    rings: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    faces: list[IntArray] = []
    for run in _runs(points):
        outward = _outward(points, run)
        for position, at in enumerate(run):
            radius, height = points[at]
            nr, nz = outward[position]
            start = len(rings) * (sides + 1)
            ring = np.column_stack([circle * radius, np.full(sides + 1, height)])
            normals = np.column_stack([circle * nr, np.full(sides + 1, nz)])
            uv = np.column_stack([turn, np.full(sides + 1, 1 - up[at])])
            rings.append((ring, normals, uv))
            if position:
                faces.append(_band(start, sides, points[run[position - 1]][0], radius))
    shape = Shape(
        np.concatenate([ring for ring, _, _ in rings]),
        np.concatenate(faces),
        np.concatenate([normals for _, normals, _ in rings]),
        np.concatenate([uv for _, _, uv in rings]),
    )
    shape.vertices.flags.writeable = False
    return shape


def cylinder(
    radius: float,
    span: AxisSpan,
    sides: int = 16,
    top: float | None = None,
    *,
    along: Axis = "z",
) -> Shape:
    """Return a cylinder, or a cone's stump with another radius at its top.

    Along y its span runs from the thing's left to its right.
    """
    end = radius if top is None else top
    upright = lathed([(radius, span[0]), (end, span[1])], sides)
    match along:
        case "x":
            return upright.turned("y", 90)
        case "y":
            return upright.turned("x", 90)
        case "z":
            return upright


def ball(radius: float, sides: int = 16, rings: int = 10) -> Shape:
    """Return a ball about the origin."""
    angles = np.linspace(-math.pi / 2, math.pi / 2, rings + 1)
    profile = [(radius * math.cos(a), radius * math.sin(a)) for a in angles]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return lathed(profile, sides)


def ellipsoid(
    centre: tuple[float, float, float],
    radii: tuple[float, float, float],
    sides: int,
    rings: int,
) -> Shape:
    """Return a ball stretched to other radii along the axes."""
    return ball(1.0, sides, rings).scaled(*radii).moved(*centre)


def extruded(
    outline: Sequence[tuple[float, float]], span: AxisSpan, along: Axis
) -> Shape:
    """Return a solid with the same outline all along an axis.

    The corners of the simple polygon are in the other two axes in alphabetic order: (y,
    z) along x, (x, z) along y, (x, y) along z.
    """
    flat = np.array(outline, dtype=float)
    following = np.roll(flat, -1, axis=0)
    if np.sum(flat[:, 0] * following[:, 1] - flat[:, 1] * following[:, 0]) < 0:
        flat = flat[::-1]
        following = np.roll(flat, -1, axis=0)
    count = len(flat)
    edges = following - flat
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    sideways = np.column_stack([edges[:, 1], -edges[:, 0]])
    before = np.roll(sideways, 1, axis=0)
    soft = np.einsum("ij,ij->i", sideways, before) > math.cos(
        math.radians(SOFT_BEND_DEG)
    )
    mean = sideways + before
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), 1e-9)
    at_start = np.where(soft[:, None], mean, sideways)
    at_end = np.where(np.roll(soft, -1)[:, None], np.roll(mean, -1, axis=0), sideways)
    zero, one = np.full((count, 1), span[0]), np.full((count, 1), span[1])
    none = np.zeros((count, 1))
    points = np.concatenate([
        np.hstack([flat, zero]),
        np.hstack([following, zero]),
        np.hstack([following, one]),
        np.hstack([flat, one]),
        np.hstack([flat, zero]),
        np.hstack([flat, one]),
    ])
    normals = np.concatenate([
        np.hstack([at_start, none]),
        np.hstack([at_end, none]),
        np.hstack([at_end, none]),
        np.hstack([at_start, none]),
        np.tile((0.0, 0.0, -1.0), (count, 1)),
        np.tile((0.0, 0.0, 1.0), (count, 1)),
    ])
    side = np.arange(count)
    cap = triangles_of(flat)
    faces = np.concatenate([
        np.column_stack([side, side + count, side + 2 * count]),
        np.column_stack([side, side + 2 * count, side + 3 * count]),
        cap[:, ::-1] + 4 * count,
        cap + 5 * count,
    ])
    order = {"z": (0, 1, 2), "y": (0, 2, 1), "x": (2, 0, 1)}[along]
    if along == "y":
        faces = faces[:, ::-1]
    return Shape(points[:, order], faces, normals[:, order])


def triangles_of(outline: FloatArray) -> IntArray:
    """Cut a simple polygon (N, 2) into triangles (M, 3), counter-clockwise."""
    polygon = shapely.Polygon(outline) if len(outline) > 2 else shapely.Polygon()
    if polygon.is_empty or not polygon.is_valid:
        raise ValueError(
            "expected a polygon that does not cross itself, with at least three "
            f"corners; got {len(outline)} corners"
        )
    numbers = {(x, y): number for number, (x, y) in enumerate(outline.tolist())}
    pieces = shapely.constrained_delaunay_triangles(polygon).geoms
    rings = [
        shapely.get_coordinates(each.normalize())[2::-1].tolist() for each in pieces
    ]
    return np.array([[numbers[x, y] for x, y in ring] for ring in rings])


def _corners(x: AxisSpan, y: AxisSpan, z: AxisSpan) -> tuple[FloatArray, FloatArray]:
    """Return the lowest and the highest corner; spans may be given either way round."""
    ends = np.array([x, y, z], dtype=float)
    low, high = ends.min(axis=1), ends.max(axis=1)
    return low, np.maximum(high, low + THINNEST)


def _runs(points: list[tuple[float, float]]) -> list[list[int]]:
    """Split a profile at its sharp bends, which both neighbours share."""
    runs = [[0]]
    for at in range(1, len(points)):
        runs[-1].append(at)
        if at + 1 < len(points):
            (ar, az), (br, bz), (cr, cz) = points[at - 1 : at + 2]
            bend = math.atan2(cz - bz, cr - br) - math.atan2(bz - az, br - ar)
            bend = abs((bend + math.pi) % (2 * math.pi) - math.pi)
            if bend > math.radians(SOFT_BEND_DEG):
                runs.append([at])
    return runs


def _outward(
    points: list[tuple[float, float]], run: list[int]
) -> list[tuple[float, float]]:
    sides = np.array([
        (points[b][1] - points[a][1], points[a][0] - points[b][0])
        for a, b in pairwise(run)
    ])
    sides /= np.linalg.norm(sides, axis=1, keepdims=True)
    padded = np.concatenate([sides[:1], sides, sides[-1:]])
    means = padded[:-1] + padded[1:]
    means /= np.linalg.norm(means, axis=1, keepdims=True)
    return [(float(r), float(z)) for r, z in means]


def _band(start: int, sides: int, below: float, above: float) -> IntArray:
    low = np.arange(start - sides - 1, start - 1)
    high = low + sides + 1
    triangles: list[IntArray] = []
    if below > 0:
        triangles.append(np.column_stack([low, low + 1, high + 1]))
    if above > 0:
        triangles.append(np.column_stack([low, high + 1, high]))
    if below > 0 and above <= 0:
        triangles = [np.column_stack([low, low + 1, high])]
    return np.concatenate([np.empty((0, 3), dtype=np.int64), *triangles])


@cache
def _box_template() -> tuple[FloatArray, FloatArray, IntArray]:
    signs: list[tuple[float, ...]] = []
    normals: list[tuple[float, ...]] = []
    faces: list[tuple[int, int, int]] = []
    for axis, side in product(range(3), (-1.0, 1.0)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        start = len(signs)
        for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[first], corner[second] = side, a, b
            signs.append(tuple(corner))
            normals.append(tuple(side * (each == axis) for each in range(3)))
        quad = [(0, 1, 2), (0, 2, 3)] if side > 0 else [(0, 2, 1), (0, 3, 2)]
        faces += [(start + i, start + j, start + k) for i, j, k in quad]
    return np.array(signs, dtype=float), np.array(normals), np.array(faces)


@cache
def _bevelled_template() -> tuple[FloatArray, FloatArray, IntArray]:
    """Join the six faces, drawn apart, by twelve edges and eight corners."""
    signs, normals, flat = _box_template()
    rows = {
        (tuple(sign), int(np.argmax(np.abs(normal)))): row
        for row, (sign, normal) in enumerate(zip(signs, normals, strict=True))
    }
    faces: list[tuple[int, ...]] = [tuple(map(int, face)) for face in flat]
    for axis, a, b in product(range(3), (-1.0, 1.0), (-1.0, 1.0)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        ends: list[tuple[int, int]] = []
        for end in (-1.0, 1.0):
            corner = [0.0, 0.0, 0.0]
            corner[axis], corner[first], corner[second] = end, a, b
            ends.append((rows[tuple(corner), first], rows[tuple(corner), second]))
        (p, q), (r, s) = ends
        faces += [(p, q, s), (p, s, r)]
    faces += [
        tuple(rows[corner, axis] for axis in range(3))
        for corner in product((-1.0, 1.0), repeat=3)
    ]
    outside = signs + 0.3 * normals
    turned = [
        face if np.linalg.det(outside[list(face)]) > 0 else face[::-1] for face in faces
    ]
    return signs, normals, np.array(turned)
