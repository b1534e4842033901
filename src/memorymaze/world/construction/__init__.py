"""Made buildings: recipes for kinds of large public floors.

With the pieces that recipes share, and routes through them. Does not hold what a plan is
(`sites`) or texts (`writing`).
"""

from memorymaze.world.construction.making import make_building
from memorymaze.world.construction.recipes import BUILDING_KINDS, BuildingKind

__all__ = ["BUILDING_KINDS", "BuildingKind", "make_building"]
