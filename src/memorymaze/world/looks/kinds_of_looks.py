"""The looks that one can choose between; here, so that files of the room can name them."""

from pathlib import Path
from typing import Final

Looks = str
"""How things look: `own`, as the models that come with the package; `mesh`, the mesh of
the whole building that stands beside its plan; or the path of a GLB file with models."""
OWN: Final = "own"
MESH: Final = "mesh"


def file_of_looks(looks: Looks | None) -> Path | None:
    """Return the file with models of a user's own; None where looks need none."""
    return None if looks in {None, OWN, MESH} else Path(str(looks))
