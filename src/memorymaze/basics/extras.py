"""What this installation has: its extras, and how its command is typed."""

import shlex
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path

from memorymaze.basics.errors import SettingsError

_CHECKOUT = Path(__file__).parents[3]


def how_to_install(extra: str) -> str:
    """Return what to type to get an extra, or several, into this environment.

    A checkout installs from itself, with the versions it was tested with.
    """
    pip = f"{shlex.quote(sys.executable)} -m pip install"
    if not (_CHECKOUT / "pyproject.toml").is_file():
        return f"{pip} 'memorymaze[{extra}]'"
    tested = shlex.quote(str(_CHECKOUT / "constraints.txt"))
    return (
        f"{pip} --constraint {tested} --editable {shlex.quote(f'{_CHECKOUT}[{extra}]')}"
    )


def command_here() -> str:
    """Return how `memorymaze` is typed, whether or not its environment is activated."""
    installed = Path(sys.executable).with_name("memorymaze")
    if not installed.is_file() or shutil.which("memorymaze") == str(installed):
        return "memorymaze"
    return shlex.quote(str(installed))


def is_installed(*packages: str) -> bool:
    """Tell whether packages are there, by their top-level names, without importing."""
    return all(find_spec(package) is not None for package in packages)


def require_extra(
    extra: str, *packages: str, purpose: str, otherwise: str | None = None
) -> None:
    """Refuse to go on without the packages of an extra.

    Args:
        extra: Name of the extra in `pyproject.toml`; of several with commas between.
        packages: As they are imported; top-level names.
        purpose: What needs them, at the beginning of the message.
        otherwise: What can be done instead of installing it.

    Raises:
        SettingsError: One is missing; says how to get it.
    """
    for package in packages:
        if not is_installed(package):
            instead = "" if otherwise is None else f", or {otherwise}"
            raise SettingsError(
                f"{purpose}: the package {package} is not installed; type: "
                f"{how_to_install(extra)}{instead}"
            )


def require_parquet() -> None:
    """Refuse to go on without what Parquet needs, the extra `tables`."""
    require_extra("tables", "pyarrow", purpose="Parquet", otherwise="take CSV")
