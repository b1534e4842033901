"""The control API as text: for language models' prompts and for the type checker.

Both texts are made from the source of `memorymaze.robot.api.control`, and in the track with
people one can ask of `memorymaze.robot.api.asking`, so they cannot drift from it. In both the
methods of the robot are plain functions: a program calls `turn("left")`.
"""

import ast
import dataclasses
import functools
import inspect
from textwrap import indent
from types import ModuleType
from typing import NamedTuple, get_args

from memorymaze.robot.api import asking
from memorymaze.robot.api import control as api

API_NAMES: tuple[str, ...] = tuple(
    name for name in vars(api.Robot) if not name.startswith("_")
)
"""Names of the functions a program can call, in the order of the Protocol."""

API_RECORDS: tuple[str, ...] = tuple(
    name for name, value in vars(api).items() if dataclasses.is_dataclass(value)
)
"""Names of the records that calls return."""

QUESTIONS: tuple[str, ...] = get_args(asking.QuestionKind)
"""Names of the functions that make a question."""
ASKING_CALLS: tuple[str, ...] = tuple(
    name
    for name in vars(asking.AskingRobot)
    if not name.startswith("_") and not hasattr(api.Robot, name)
)
"""Names of the calls that only a robot has that can ask people."""
ASKING_NAMES: tuple[str, ...] = (*QUESTIONS, *ASKING_CALLS)
"""Names of the functions that a program can call besides in the track with people."""


@functools.cache
def api_specification(*, with_people: bool = False) -> str:
    """Return the control API with its docstrings, as a language model reads it.

    With people it tells also how to ask them.

    The text is Python: a comment on the robot, the types of directions and endings,
    the result records with a comment on each field, and one function with its
    docstring per call.
    """
    parts: list[str] = []
    for source in _sources(with_people=with_people):
        about = indent(ast.get_docstring(source.robot) or "", "# ", lambda line: True)
        parts.append("\n".join(line.rstrip() for line in about.splitlines()))
        parts.append("\n".join(map(ast.unparse, source.aliases)))
        parts += map(_describe_record, source.records)
        parts += map(_describe_function, source.functions)
    return "\n\n\n".join(parts) + "\n"


@functools.cache
def api_stub(*, with_people: bool = False) -> str:
    """Return the control API as a stub file: types only, nothing to read."""
    lines = ["from typing import Literal"]
    for source in _sources(with_people=with_people):
        lines += map(ast.unparse, source.aliases)
        for record in source.records:
            lines.append(f"class {record.name}:")
            lines += [f"    {field.name}: {field.kind}" for field in _fields(record)]
        lines += [f"{_signature(function)}: ..." for function in source.functions]
    return "\n".join(lines) + "\n"


class _Source(NamedTuple):
    """What a module of the API defines."""

    aliases: list[ast.Assign]
    records: list[ast.ClassDef]
    robot: ast.ClassDef
    functions: list[ast.FunctionDef]
    """Those of the robot without `self`."""


class _Field(NamedTuple):
    name: str
    kind: str
    text: str


def _sources(*, with_people: bool) -> list[_Source]:
    sources = [_read_source(api, api.Robot.__name__)]
    if with_people:
        sources.append(_read_source(asking, asking.AskingRobot.__name__))
    return sources


def _read_source(module: ModuleType, robot_name: str) -> _Source:
    body = ast.parse(inspect.getsource(module)).body
    classes = {item.name: item for item in body if isinstance(item, ast.ClassDef)}
    robot = classes.pop(robot_name)
    questions = [
        item
        for item in body
        if isinstance(item, ast.FunctionDef) and item.name in QUESTIONS
    ]
    methods = [item for item in robot.body if isinstance(item, ast.FunctionDef)]
    for method in methods:
        del method.args.args[0]
    aliases = [
        item
        for item in body
        if isinstance(item, ast.Assign) and isinstance(item.value, ast.Subscript)
    ]
    return _Source(aliases, list(classes.values()), robot, [*questions, *methods])


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
    """Return `def name(parameters) -> result`."""
    result = ast.unparse(function.returns) if function.returns else "None"
    return f"def {function.name}({ast.unparse(function.args)}) -> {result}"


def _describe_record(record: ast.ClassDef) -> str:
    lines = [f"class {record.name}:", f'    """{ast.get_docstring(record)}"""', ""]
    lines += [
        f"    {field.name}: {field.kind}  # {field.text}" for field in _fields(record)
    ]
    return "\n".join(lines)


def _describe_function(function: ast.FunctionDef) -> str:
    docstring = indent(f'"""{ast.get_docstring(function)}\n"""', "    ")
    return f"{_signature(function)}:\n{docstring}"
