"""Code of users' own: an agent, a robot's body, a finder of objects.

It is named by `module:Class` or `file.py:Class`, may have a dataclass `Options`, and is
known by the fingerprints of its files: its own, and those beside it that it imports.
"""

import ast
import hashlib
import importlib
import importlib.util
import inspect
import sys
import zlib
from collections.abc import Iterator
from dataclasses import is_dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.failures import failure_line
from memorymaze.basics.input_files import FileStamp, stamp_file
from memorymaze.basics.options import parse_options

INSTALLED = {"site-packages", "dist-packages"}
OURS = Path(__file__).parents[1]
"""Of what is in here the stamp of the code tells."""


def find_own(role: str, name: str) -> Any:
    """Return what `module:Class` or `file.py:Class` names; it can be called.

    Messages say which role it is to play.
    """
    place, _, attribute = name.rpartition(":")
    try:
        module = _load(place)
    except (Exception, SystemExit) as error:
        raise SettingsError(
            f"{role} {name!r}: {place!r} cannot be imported ({failure_line(error)})"
        ) from error
    maker = getattr(module, attribute, None)
    if not callable(maker):
        raise SettingsError(
            f"{role} {name!r}: expected {place!r} to have a class {attribute!r}, got "
            f"{'nothing of this name' if maker is None else repr(maker)}"
        )
    return maker


def checked_options(role: str, name: str, maker: object) -> type | None:
    """Return the dataclass of its options: its attribute `Options`, if any."""
    options = getattr(maker, "Options", None)
    if options is not None and not (
        isinstance(options, type) and is_dataclass(options)
    ):
        raise SettingsError(
            f"{role} {name!r}: expected `Options` to be a dataclass, got {options!r}"
        )
    return options


def parse_own_options(role: str, name: str, maker: object, text: str) -> Any:
    """Read its options from `NAME=VALUE,NAME=VALUE`; None where it has none."""
    kind = checked_options(role, name, maker)
    if kind is not None:
        return parse_options(kind, text, subject=f"{role} {name}")
    if text:
        raise SettingsError(
            f"{role} {name!r}: has no options to set, got {text!r}; give it a dataclass "
            "`Options`, and it is called with one of these"
        )
    return None


def own_files(name: str) -> dict[str, Path]:
    """Return the files of what is named `file.py:Class` or `module:Class`.

    Its own comes first, then what it and they import from beside it, wherever
    in the code. They are named as seen from the folder they are imported from. What is
    installed is not looked into, nor are files that are no Python.
    """
    place = name.rpartition(":")[0]
    if place.endswith(".py"):
        first = Path(place).absolute()
        root = first.parent
    else:
        spec = importlib.util.find_spec(place) if place else None
        if spec is None or spec.origin is None or not spec.has_location:
            return {}
        first = Path(spec.origin).absolute()
        root = first.parents[place.count(".") + (first.stem == "__init__")]
    if first.is_relative_to(OURS):
        return {}
    if INSTALLED & set(root.parts):
        return {first.name: first}
    found: dict[str, Path] = {}
    waiting = [first]
    while waiting:
        path = waiting.pop(0)
        name = path.relative_to(root).as_posix()
        if name not in found:
            found[name] = path
            waiting += _imported(path, root)
    return found


def own_fingerprint(name: str, given: object = None) -> tuple[FileStamp, ...]:
    """Return the fingerprints of its files; none of what comes with the package.

    Of what was handed over, as an object or its class, the source of its class counts
    where that is in no file, as in a notebook.
    """
    if given is not None:
        kind = given if isinstance(given, type) else type(given)
        file = getattr(sys.modules.get(kind.__module__), "__file__", None)
        if file is None:
            return _source_stamp(kind)
        name = f"{file}:{kind.__qualname__}"
    return tuple(stamp_file(path, name) for name, path in own_files(name).items())


def _source_stamp(kind: type) -> tuple[FileStamp, ...]:
    try:
        source = inspect.getsource(kind)
    except (OSError, TypeError):
        return ()
    digest = hashlib.sha256(source.encode()).hexdigest()
    return (FileStamp(f"class {kind.__qualname__}", digest),)


def _imported(path: Path, root: Path) -> Iterator[Path]:
    """Yield the files below a folder that one of them can import."""
    try:
        tree = ast.parse(path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        # It cannot be imported either; whoever does says so.
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield from _beside(root, alias.name.split("."))
        elif isinstance(node, ast.ImportFrom):
            folder = path.parents[node.level - 1] if node.level else root
            for alias in node.names:
                parts = [*(node.module or "").split("."), alias.name]
                yield from _beside(folder, [part for part in parts if part])


def _beside(folder: Path, parts: list[str]) -> Iterator[Path]:
    """Yield the modules that the import of `a.b.c` runs, as far as they are there."""
    for part in parts:
        module, package = folder / f"{part}.py", folder / part / "__init__.py"
        if package.is_file():
            yield package
        elif module.is_file():
            yield module
        folder = folder / part


def _load(place: str) -> ModuleType:
    if not place.endswith(".py"):
        _look_also_in(Path.cwd())
        return importlib.import_module(place)
    path = Path(place).absolute()
    if not path.is_file():
        raise FileNotFoundError(f"no such file: {place}")
    return _run_file(path, path.stat().st_mtime_ns)


@cache
def _run_file(path: Path, edited: int) -> ModuleType:
    """Run a file; once as long as it stays as it is."""
    # Not its bare name: a user's random.py must not stand in for the library's, nor one
    # mine.py for another's.
    name = f"own_{path.stem}_{zlib.crc32(str(path).encode()):08x}"
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot be loaded: {path}")
    _look_also_in(path.parent)
    module = importlib.util.module_from_spec(spec)
    # Dataclasses and pickles inside the file look their module up here.
    sys.modules[module.__name__] = module
    spec.loader.exec_module(module)
    return module


def _look_also_in(folder: Path) -> None:
    """Let imports find what lies beside a user's file, after all that is installed."""
    if str(folder) not in sys.path:
        sys.path.append(str(folder))
