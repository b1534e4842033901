"""Buildings: floor plans as records, how they are loaded, and the rules they keep.

Also navigation graphs made from them. No time passes here, nothing moves, and nothing is
drawn: see `simulation` and `drawing`. The format is in `docs/buildings.md`.
"""

from memorymaze.world.sites.checking import find_site_problems
from memorymaze.world.sites.loading import (
    BUILTIN_SITE_NAMES,
    load_site,
    load_sites,
    plan_file,
    plan_paths,
    sites_by_name,
)
from memorymaze.world.sites.problems import SiteProblem
from memorymaze.world.sites.records import (
    Anchor,
    Area,
    Corridor,
    Door,
    Exit,
    Landmark,
    Room,
    Route,
    RouteTurn,
    Site,
    TurningPoint,
)

__all__ = [
    "BUILTIN_SITE_NAMES",
    "Anchor",
    "Area",
    "Corridor",
    "Door",
    "Exit",
    "Landmark",
    "Room",
    "Route",
    "RouteTurn",
    "Site",
    "SiteProblem",
    "TurningPoint",
    "find_site_problems",
    "load_site",
    "load_sites",
    "plan_file",
    "plan_paths",
    "sites_by_name",
]
