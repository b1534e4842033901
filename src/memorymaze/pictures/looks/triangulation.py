"""Cutting a simple polygon into triangles."""

import numpy as np

from memorymaze.pictures.looks.shape import Floats, Ints


def triangles_of(outline: Floats) -> Ints:
    """Cut a simple polygon into triangles by clipping ears.

    Args:
        outline: (N, 2) corners, counter-clockwise.

    Returns:
        (N - 2, 3) numbers of corners, counter-clockwise.

    Raises:
        ValueError: The outline crosses itself or has fewer than three corners.
    """
    corners = [(float(x), float(y)) for x, y in outline]
    left = list(range(len(corners)))
    triangles: list[tuple[int, int, int]] = []
    while len(left) > 3:
        for place in range(len(left)):
            a, b, c = left[place - 1], left[place], left[(place + 1) % len(left)]
            if _turn(corners[a], corners[b], corners[c]) > 0 and not any(
                _inside(corners[each], corners[a], corners[b], corners[c])
                for each in left
                if each not in {a, b, c}
            ):
                triangles.append((a, b, c))
                del left[place]
                break
        else:
            break
    if len(left) != 3:
        raise ValueError(
            "expected a polygon that does not cross itself, with at least three "
            f"corners, counter-clockwise; got {len(corners)} corners, of which "
            f"{len(left)} cannot be cut into triangles"
        )
    triangles.append((left[0], left[1], left[2]))
    return np.array(triangles)


Point = tuple[float, float]


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _inside(p: Point, a: Point, b: Point, c: Point) -> bool:
    if p in {a, b, c}:
        return False
    return _turn(a, b, p) >= 0 and _turn(b, c, p) >= 0 and _turn(c, a, p) >= 0
