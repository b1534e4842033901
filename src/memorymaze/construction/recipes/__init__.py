"""One recipe for each kind of building: how its streets and halls lie."""

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np

from memorymaze.construction.layout import Layout
from memorymaze.construction.recipes.hospital import hospital

Kind = Literal["hospital"]
KINDS: tuple[Kind, ...] = get_args(Kind)
RECIPES: dict[Kind, Callable[[np.random.Generator], Layout]] = {
    "hospital": hospital,
}
