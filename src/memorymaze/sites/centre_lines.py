"""The middle line of a four-cornered corridor; polygons only, no plan records."""

import math

from shapely import LineString, Polygon


def corridor_centre_line(polygon: Polygon) -> LineString:
    """Return the line between the middles of a corridor's two short ends.

    The ends are the pair of opposite sides that is shorter in sum, so the line follows
    the long direction; of a square it joins the second and the fourth side. It runs
    from the west end to the east end, or from south to north when it has no west.

    Args:
        polygon: Convex, with exactly four corners; metres.

    Returns:
        A line of two points, (2, 2) metres.

    Raises:
        ValueError: The polygon has not four corners.
    """
    corners = [(x, y) for x, y, *_ in polygon.exterior.coords[:-1]]
    if len(corners) != 4:
        raise ValueError(f"a corridor has 4 corners, got {len(corners)}")
    sides = [(corners[i], corners[(i + 1) % 4]) for i in range(4)]
    lengths = [math.dist(*side) for side in sides]
    first_end = 1 if lengths[0] + lengths[2] >= lengths[1] + lengths[3] else 0
    middles = [
        ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        for a, b in (sides[first_end], sides[first_end + 2])
    ]
    return LineString(sorted(middles))
