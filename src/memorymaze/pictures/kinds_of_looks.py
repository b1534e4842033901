"""The looks that one can choose between; here, so that files of the room can name them."""

from typing import Literal

Looks = Literal["own", "models", "mesh"]
"""How things look: as made by this project's code alone, by furniture models too, or the
whole building as the mesh beside its plan."""
