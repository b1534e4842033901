"""From what a user calls a site on the command line to the file of its plan."""

from difflib import get_close_matches
from pathlib import Path

from memorymaze.errors import SettingsError


def plan_path(name: str) -> Path:
    """Return the plan of one of the benchmark's sites, or the file of this name.

    Raises:
        SettingsError: There is neither; says which sites there are.
    """
    from memorymaze.sites import BUILTIN_SITE_NAMES, builtin_site_path

    if name in BUILTIN_SITE_NAMES:
        return builtin_site_path(name)
    if name and Path(name).exists():
        return Path(name)
    near = get_close_matches(name, BUILTIN_SITE_NAMES, n=1)
    meant = f"; did you mean {near[0]}?" if near else ""
    raise SettingsError(
        f"expected a plan's file or one of {', '.join(BUILTIN_SITE_NAMES)}, got "
        f"{name!r}: no such file{meant}"
    )
