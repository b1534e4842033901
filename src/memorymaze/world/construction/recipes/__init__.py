"""One recipe for each kind of building: how its streets and halls lie."""

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np

from memorymaze.world.construction.layout import Layout
from memorymaze.world.construction.recipes.airport import airport
from memorymaze.world.construction.recipes.hospital import hospital
from memorymaze.world.construction.recipes.mall import mall
from memorymaze.world.construction.recipes.museum import museum
from memorymaze.world.construction.recipes.office import office
from memorymaze.world.construction.recipes.school import school
from memorymaze.world.construction.recipes.station import station
from memorymaze.world.construction.recipes.university import university

BuildingKind = Literal[
    "university",
    "museum",
    "hospital",
    "office",
    "mall",
    "station",
    "school",
    "airport",
]
BUILDING_KINDS: tuple[BuildingKind, ...] = get_args(BuildingKind)
RECIPES: dict[BuildingKind, Callable[[np.random.Generator], Layout]] = {
    "university": university,
    "museum": museum,
    "hospital": hospital,
    "office": office,
    "mall": mall,
    "station": station,
    "school": school,
    "airport": airport,
}
