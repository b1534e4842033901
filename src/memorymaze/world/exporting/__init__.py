"""Buildings for others' simulators: glTF and more, with the plan's names and ids.

Holds one file per format, and the building as named meshes that they are made from. How
things look is made in `looks`; what comes in is `importing`.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.basics.durable_files import check_new_file, check_new_folder
from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.extras import require_extra

if TYPE_CHECKING:
    from memorymaze.world.sites.records import Site

__all__ = ["FILE_ENDINGS", "FORMATS", "export_site"]

FILE_ENDINGS = {
    "gltf": ".glb",
    "usd": "_usd",
    "mjcf": "_mjcf",
    "ros_map": "_ros_map",
    "habitat": "_habitat",
    "carla": "_carla",
}
"""What follows the site's name in that of the file or folder of each format."""
FORMATS = tuple(FILE_ENDINGS)
"""What a site can be exported to; each is a file of this room."""


def export_site(
    site: "Site",
    to: str,
    out: str | Path,
    *,
    resolution: float | None = None,
    lanes: str | None = None,
) -> list[Path]:
    """Write a building in the format of another program.

    Args:
        site: A building that passed the checks of `memorymaze.world.sites`.
        to: One of `FORMATS`.
        out: File or folder to make, by the format; it must not exist.
        resolution: Metres per pixel of a `ros_map`; None for 0.05.
        lanes: Type of the lanes for `carla`, `sidewalk` or `driving`; None for the first.

    Returns:
        The files written, the one to open first.

    Raises:
        SettingsError: The format is unknown, needs a package that is not installed, or
            there is something at `out` already.
    """
    if to not in FORMATS:
        raise SettingsError(
            f"--to: expected one of {', '.join(FORMATS)}; got {to!r}"
            f"{did_you_mean(to, FORMATS)}"
        )
    options: dict[str, float | str] = {}
    for name, value, of in (
        ("resolution", resolution, "ros_map"),
        ("lanes", lanes, "carla"),
    ):
        if value is not None:
            if to != of:
                raise SettingsError(
                    f"--{name}: expected only with --to {of}, got --to {to}"
                )
            options[name] = value
    if to == "usd":
        require_extra("usd", "pxr", purpose="--to usd")
    out = Path(out)
    check = check_new_file if to == "gltf" else check_new_folder
    check(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    module = import_module(f"memorymaze.world.exporting.{to}")
    write: Callable[..., list[Path]] = getattr(module, f"write_{to}")
    return write(site, out, **options)
