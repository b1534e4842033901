"""The control API as text: for language models' prompts and for the type checker.

Both texts are made from the source of `memorymaze.robot.api`, so they cannot drift
from it. In both the methods of `Robot` are plain functions: a program calls
`turn("left")`.
"""

import ast
import dataclasses
import functools
import inspect
from textwrap import indent
from typing import NamedTuple

from memorymaze.robot import api

API_NAMES: tuple[str, ...] = tuple(
    name for name in vars(api.Robot) if not name.startswith("_")
)
"""Names of the functions a program can call, in the order of the Protocol."""

API_RECORDS: tuple[str, ...] = tuple(
    name for name, value in vars(api).items() if dataclasses.is_dataclass(value)
)
"""Names of the records that calls return."""


@functools.cache
def api_specification() -> str:
    """Return the control API with its docstrings, as a language model reads it.

    The text is Python: a comment on the robot, the types of directions and endings,
    the result records with a comment on each field, and one function with its
    docstring per call.
    """
    source = _read_source()
    about = indent(ast.get_docstring(source.robot) or "", "# ", lambda line: True)
    parts = ["\n".join(line.rstrip() for line in about.splitlines())]
    parts.append("\n".join(map(ast.unparse, source.aliases)))
    parts += map(_describe_record, source.records)
    parts += map(_describe_function, source.functions)
    return "\n\n\n".join(parts) + "\n"


@functools.cache
def api_stub() -> str:
    """Return the control API as a stub file: types only, nothing to read."""
    source = _read_source()
    lines = ["from typing import Literal", *map(ast.unparse, source.aliases)]
    for record in source.records:
        lines.append(f"class {record.name}:")
        lines += [f"    {field.name}: {field.kind}" for field in _fields(record)]
    lines += [f"{_signature(function)}: ..." for function in source.functions]
    return "\n".join(lines) + "\n"


class _Source(NamedTuple):
    """What the API's module defines."""

    aliases: list[ast.Assign]
    records: list[ast.ClassDef]
    robot: ast.ClassDef

    @property
    def functions(self) -> list[ast.FunctionDef]:
        return [item for item in self.robot.body if isinstance(item, ast.FunctionDef)]


class _Field(NamedTuple):
    name: str
    kind: str
    text: str


def _read_source() -> _Source:
    body = ast.parse(inspect.getsource(api)).body
    classes = {item.name: item for item in body if isinstance(item, ast.ClassDef)}
    robot = classes.pop(api.Robot.__name__)
    aliases = [
        item
        for item in body
        if isinstance(item, ast.Assign) and isinstance(item.value, ast.Subscript)
    ]
    return _Source(aliases, list(classes.values()), robot)


def _fields(record: ast.ClassDef) -> list[_Field]:
    """Return each field with the docstring beneath it."""
    fields: list[_Field] = []
    for statement, below in zip(record.body, [*record.body[1:], None], strict=True):
        match statement, below:
            case (
                ast.AnnAssign(target=ast.Name(id=name), annotation=kind),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                fields.append(_Field(name, ast.unparse(kind), " ".join(text.split())))
            case ast.AnnAssign(target=target), _:
                raise TypeError(
                    f"{record.name}.{ast.unparse(target)} has no docstring beneath it"
                )
            case _:
                pass
    return fields


def _signature(function: ast.FunctionDef) -> str:
    """Return `def name(parameters) -> result` without `self`."""
    parameters = ast.arguments(
        posonlyargs=[],
        args=function.args.args[1:],
        kwonlyargs=[],
        kw_defaults=[],
        defaults=function.args.defaults,
    )
    result = ast.unparse(function.returns) if function.returns else "None"
    return f"def {function.name}({ast.unparse(parameters)}) -> {result}"


def _describe_record(record: ast.ClassDef) -> str:
    lines = [f"class {record.name}:", f'    """{ast.get_docstring(record)}"""', ""]
    lines += [
        f"    {field.name}: {field.kind}  # {field.text}" for field in _fields(record)
    ]
    return "\n".join(lines)


def _describe_function(function: ast.FunctionDef) -> str:
    docstring = indent(f'"""{ast.get_docstring(function)}\n"""', "    ")
    return f"{_signature(function)}:\n{docstring}"
