"""The union of floor polygons whose seams were rounded to millimetres."""

from collections.abc import Sequence

from shapely import Polygon, union_all

from memorymaze.errors import SitePlanError

SEAM_GAP = 1e-3
"""Half the width in metres of the gaps and slivers that are closed."""
SEAM_KINK = 5e-3
"""Kinks in the boundary smaller than this many metres are straightened."""


def floor_pieces(parts: Sequence[Polygon]) -> list[Polygon]:
    """Unite floor polygons into connected pieces, the largest first.

    Gaps and slivers up to 2 mm wide and kinks below 5 mm are smoothed away.
    """
    grown = union_all([part.buffer(SEAM_GAP, join_style="mitre") for part in parts])
    floor = grown.buffer(-SEAM_GAP, join_style="mitre").simplify(SEAM_KINK)
    pieces = [piece for piece in getattr(floor, "geoms", [floor]) if not piece.is_empty]
    return sorted(pieces, key=lambda piece: piece.area, reverse=True)


def union_of_floor(parts: Sequence[Polygon]) -> Polygon:
    """Unite floor polygons that are connected; see `floor_pieces`.

    Raises:
        SitePlanError: There is no floor, or it is in several pieces.
    """
    pieces = floor_pieces(parts)
    if len(pieces) != 1:
        raise SitePlanError(
            "floor-connected: expected corridors, areas and turning points that form "
            f"one connected floor, got {len(pieces)} pieces; let neighbours overlap or "
            "share an edge"
        )
    return pieces[0]
