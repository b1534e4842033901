"""Packages that only some uses need: the extras of the installation."""

from importlib.util import find_spec

from memorymaze.errors import SettingsError


def how_to_install(extra: str) -> str:
    """Return what to type to get an extra: `pip install 'memorymaze[video]'`."""
    return f"pip install 'memorymaze[{extra}]'"


def require_extra(
    extra: str, *packages: str, purpose: str, otherwise: str | None = None
) -> None:
    """Find out whether packages of an extra are there, without importing them.

    Args:
        extra: Name of the extra in `pyproject.toml`.
        packages: As they are imported; top-level names.
        purpose: What needs them, at the beginning of the message.
        otherwise: What can be done instead of installing it.

    Raises:
        SettingsError: One is missing; says how to get it.
    """
    for package in packages:
        if find_spec(package) is None:
            instead = "" if otherwise is None else f", or {otherwise}"
            raise SettingsError(
                f"{purpose}: the package {package} is not installed; type: "
                f"{how_to_install(extra)}{instead}"
            )
