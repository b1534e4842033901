"""Buildings from elsewhere: made of other formats, with what had to be guessed.

One file per format, and the two pieces behind all: centre lines of a floor, and ways made
into parts of a building. Does not hold what a plan is (`sites`), or how ours are given to
others.
"""

from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.basics.errors import SettingsError, did_you_mean

if TYPE_CHECKING:
    from memorymaze.world.importing.imported import ImportedSite

__all__ = ["SOURCE_FORMATS", "import_site"]

SOURCE_FORMATS = ("cabot", "imdf", "osm", "ros_map", "mesh")
"""What a building can be imported from; each is a file of this room."""
WITH_FLOORS = ("cabot", "imdf", "osm")
"""Formats that hold several floors."""


def import_site(
    path: str | Path,
    format: str,
    *,
    floor: str | None = None,
    narrowest: float | None = None,
    routes: Sequence[tuple[str, str]] = (),
) -> "ImportedSite":
    """Make a building of a file in another format.

    Args:
        path: The file.
        format: One of `SOURCE_FORMATS`.
        floor: Which one, where the file has several.
        narrowest: Of a ROS map, metres of the ways behind which floor is left out; None
            for 0.5, what a robot needs.
        routes: Reference routes to add, each from and to a room, door or thing by id or
            name, or a place `x,y` in metres.

    Returns:
        The building as `site`, called like the file, with what the file said (`took`),
        what had to be `guessed`, and what is `missing`.

    Raises:
        SettingsError: The format is unknown, or something given does not fit the file.
        ImportFileError: The file is not of this format, or holds no floor.
        SitePlanError: Routes are asked for on a floor that cannot be used.
    """
    if format not in SOURCE_FORMATS:
        raise SettingsError(
            f"--from: expected one of {', '.join(SOURCE_FORMATS)}, got {format!r}"
            f"{did_you_mean(format, SOURCE_FORMATS)}"
        )
    if floor and format not in WITH_FLOORS:
        raise SettingsError(
            f"--floor: expected with {', '.join(WITH_FLOORS)}, got {format}, which has "
            "one floor"
        )
    if narrowest is not None and format != "ros_map":
        raise SettingsError(f"--narrowest: expected with ros_map, got {format}")
    options = {"floor": floor, "narrowest": narrowest}
    given = {name: value for name, value in options.items() if value is not None}
    module = import_module(f"memorymaze.world.importing.{format}")
    imported: ImportedSite = getattr(module, f"import_{format}")(Path(path), **given)
    if not routes:
        return imported
    from memorymaze.world.importing.reference_route import reference_route
    from memorymaze.world.sites.loading import check_sound

    check_sound(imported.site)
    site = imported.site
    for start, goal in routes:
        site = replace(site, routes=(*site.routes, reference_route(site, start, goal)))
    return replace(imported, site=site)
