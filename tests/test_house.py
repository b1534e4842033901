"""The house as a whole: what holds for all of its files together."""

import ast
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import memorymaze

SOURCE = Path(memorymaze.__file__).parent


@cache
def _parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def test_no_two_files_import_each_other_in_a_circle() -> None:
    """Imports in functions count too, those for type checkers do not.

    A package's `__init__` is a file: it may import the files beside it, which then must
    not import from it.
    """
    files = {_name(path): path for path in sorted(SOURCE.rglob("*.py"))}
    imports = {name: set(_imported(path, files)) for name, path in files.items()}
    try:
        TopologicalSorter(imports).prepare()
    except CycleError as circle:
        raise AssertionError("a circle: " + " <- ".join(circle.args[1])) from None


def _name(path: Path) -> str:
    parts = path.relative_to(SOURCE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _imported(path: Path, files: dict[str, Path]) -> Iterator[str]:
    for node in _statements(_parsed(path)):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names if each.name in files)
        elif isinstance(node, ast.ImportFrom) and node.module in files:
            inside = [f"{node.module}.{each.name}" for each in node.names]
            yield from (each if each in files else node.module for each in inside)


def _statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield everything in a file but what stands under `if TYPE_CHECKING`."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.expr):
            continue
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            continue
        yield node
        yield from _statements(node)


def test_a_public_name_means_one_thing_in_the_house() -> None:
    """Classes, functions, types, and the constants that another file imports.

    Other constants are words of their file. What every verb of the command line has to
    have is one role in many files: `add_parser` in `cli`.
    """
    trees = {path: _parsed(path) for path in SOURCE.rglob("*.py")}
    imported = {
        (node.module, each.name)
        for tree in trees.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for each in node.names
    }
    homes: dict[str, list[str]] = {}
    for path, tree in sorted(trees.items()):
        home = _name(path)
        is_verb = home.startswith("memorymaze.front.cli.")
        for name in _public_names(tree):
            is_own = name.isupper() and (home, name) not in imported
            if not is_own and not (is_verb and name == "add_parser"):
                homes.setdefault(name, []).append(home)
    assert {name: at for name, at in homes.items() if len(at) > 1} == {}


def _public_names(tree: ast.Module) -> Iterator[str]:
    for node in tree.body:
        names: list[str] = []
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            names = [node.name]
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names = [each.id for each in targets if isinstance(each, ast.Name)]
        yield from (name for name in names if not name.startswith("_"))
