"""Which thing looks how: from the words of a site plan to a model.

What is no known kind of thing gets a box with its name on it.
"""

import zlib
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.resources import as_file, files
from pathlib import Path

from memorymaze.basics.errors import SettingsError
from memorymaze.world.looks.assembly import ObjectModel
from memorymaze.world.looks.kinds_of_looks import MESH, OWN, Looks, file_of_looks
from memorymaze.world.looks.models import (
    Order,
    ThingModel,
    model_of_kind,
    read_models,
)
from memorymaze.world.looks.windows import WINDOWS, window_model
from memorymaze.world.sites.records import Landmark, Mount
from memorymaze.world.sites.things import kind_of_thing, thing_kinds

UNKNOWN = "unknown"
"""The node that shows what no kind is known of."""
VARIANTS = 6
"""Things of one kind, size, colour and text come in at most so many looks."""
WITH_PICTURES = frozenset({
    "computer terminal", "digital sign", "exhibit panel", "information panel", "kiosk",
    "mural", "painting", "poster", "touch screen", "video wall",
})  # fmt: skip
"""Archetypes that show a picture, each thing another one."""


@cache
def archetypes() -> frozenset[str]:
    """Return the names of all kinds that have a look of their own."""
    return frozenset(kind.look for kind in thing_kinds().values())


def archetype_of(category: str) -> str | None:
    """Return the archetype of a category of a site plan, one of `archetypes`.

    None for a category that nothing is known of, which is shown as a box with its name.
    """
    kind = kind_of_thing(category)
    return None if kind is None else kind.look


def model_for_landmark(landmark: Landmark, looks: Looks = OWN) -> ObjectModel:
    """Return how a landmark looks.

    Landmarks that differ in nothing one sees share one model.
    """
    number = zlib.crc32(landmark.id.encode())
    pictured = archetype_of(landmark.category) in WITH_PICTURES
    return model_of(
        landmark.category,
        landmark.size,
        colour_words=landmark.color,
        text=landmark.text,
        name=landmark.name,
        mount=landmark.mount,
        variant=number if pictured else number % VARIANTS,
        looks=looks,
    )


@cache
def model_of(
    category: str,
    size: tuple[float, float, float],
    *,
    colour_words: str | None = None,
    text: str | None = None,
    name: str | None = None,
    mount: Mount = "floor",
    variant: int = 0,
    looks: Looks = OWN,
) -> ObjectModel:
    """Return how a thing looks that no plan has, such as a box left in the way.

    Size is length across the front, depth, height. Unknown words for colours give its
    usual colour; a proper name may say what it shows; the variant is one of several
    looks.
    """
    order = Order(category, *size, colour_words, text or None, name, mount, variant)
    kind = _kind_of(order)
    if kind in WINDOWS:
        return window_model(category, size, text)
    models = models_of(looks).get(kind) or models_of(OWN)[kind]
    return model_of_kind(models, order)


def check_looks(looks: Looks) -> Looks:
    """Refuse looks that there are not, or a file that holds no models."""
    file = file_of_looks(looks)
    if file is not None:
        if not file.is_file():
            raise SettingsError(
                f"looks: expected {OWN}, {MESH}, or the path of a GLB file with models, "
                f"got {looks!r}, which is no file here"
            )
        models_of(looks)
    return looks


def models_of(looks: Looks) -> Mapping[str, Sequence[ThingModel]]:
    """Return the models that one may choose for looks, by kind."""
    path = file_of_looks(looks)
    if path is None:
        with as_file(files("memorymaze.world.looks") / "data" / "things.glb") as path:
            return _models_in(path)
    return _models_in(path.resolve())


@cache
def _models_in(path: Path) -> Mapping[str, Sequence[ThingModel]]:
    return read_models(path, _kind_of_node)


def _kind_of_node(name: str) -> str | None:
    return UNKNOWN if name == UNKNOWN else archetype_of(name)


def _kind_of(order: Order) -> str:
    archetype = archetype_of(order.category)
    if archetype is None:
        return UNKNOWN
    if archetype == "sign" and order.mount == "ceiling":
        return "hanging sign"
    if archetype == "sign" and order.mount == "floor" and order.depth > 0.2:
        return "A-frame"
    return archetype
