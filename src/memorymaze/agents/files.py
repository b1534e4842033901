"""The files that a user's agent is made of: its own, and those beside it."""

import ast
import hashlib
import importlib.util
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path

from memorymaze.input_files import FileStamp, stamp_file

INSTALLED = {"site-packages", "dist-packages"}
OURS = Path(__file__).parents[1]
"""Of the agents in here the stamp of the code tells."""


def agent_files(name: str) -> dict[str, Path]:
    """Return the files of an agent named `file.py:Class` or `module:Class`.

    The agent's own comes first, then what it and they import from beside it, wherever
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


def agent_fingerprint(name: str, given: object = None) -> tuple[FileStamp, ...]:
    """Return the fingerprints of an agent's files.

    Of an agent that was handed over, as an object or its class, the source of its class counts where that
    is in no file, as in a notebook.
    """
    if given is not None:
        kind = given if isinstance(given, type) else type(given)
        file = getattr(sys.modules.get(kind.__module__), "__file__", None)
        if file is None:
            return _source_stamp(kind)
        name = f"{file}:{kind.__qualname__}"
    return tuple(stamp_file(path, name) for name, path in agent_files(name).items())


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
