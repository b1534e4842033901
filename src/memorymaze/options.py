"""Options of agents: frozen dataclasses, set by name from the command line.

An agent that has options keeps a frozen dataclass of them in its own file: a default for
each field, and a string beneath it that says in one sentence what it does. That is all
there is to write; names, types, defaults and meanings are read from it.

    @dataclass(frozen=True, slots=True)
    class WalkerOptions:
        stride: float = 0.5
        \"\"\"Metres per step.\"\"\"

    options = read_options(WalkerOptions, [("stride", "0.75")], agent="walker")
"""

import ast
import inspect
import math
import textwrap
from collections.abc import Iterable
from dataclasses import MISSING, dataclass, fields
from itertools import pairwise
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from memorymaze.errors import SettingsError, did_you_mean

Options = TypeVar("Options")


@dataclass(frozen=True, slots=True)
class Option:
    """One field of an agent's options, as the command line shows it."""

    name: str
    allowed: str
    """What may be given, in words."""
    default: str
    """As it would be given."""
    meaning: str
    """The string beneath the field."""


def list_options(cls: type) -> list[Option]:
    """Return the options of an agent, in the order of its dataclass.

    Raises:
        TypeError: The class is no dataclass, a field has no default or no string beneath
            it, or its type cannot be given on the command line.
    """
    kinds = get_type_hints(cls)
    meanings = _strings_beneath(cls)
    found: list[Option] = []
    for field in fields(cls):
        if field.default is MISSING or field.name not in meanings:
            raise TypeError(
                f"{cls.__name__}.{field.name}: expected a default and a string beneath "
                "it that says what it does"
            )
        default = _as_given(field.default)
        meaning = meanings[field.name]
        found.append(Option(field.name, _allowed(kinds[field.name]), default, meaning))
    return found


def read_options(
    cls: type[Options], pairs: Iterable[tuple[str, str]], *, agent: str
) -> Options:
    """Turn names and values from the command line into an agent's options.

    Whole numbers, numbers, `true` and `false`, words, one of several words (`Literal`),
    lists (`tuple[int, ...]`: `15,30,45`) and `none` are understood, as the fields' types
    say. What the dataclass itself refuses in `__post_init__` is passed on.

    Args:
        cls: Dataclass of the agent's options; every field has a default.
        pairs: Names and values, each name once.
        agent: The agent's name, for messages.

    Raises:
        SettingsError: There is no such option, it is given twice, or its value has no
            meaning; names the option, what is allowed, and what came.
    """
    kinds = get_type_hints(cls)
    names = [field.name for field in fields(cls)]  # pyright: ignore[reportArgumentType]
    given: dict[str, Any] = {}
    for name, text in pairs:
        # Dashes as everywhere on the command line.
        field = name.strip().replace("-", "_")
        if field not in names:
            raise SettingsError(_unknown(name, names, agent))
        if field in given:
            raise SettingsError(f"--set {name}: given twice; leave one out")
        try:
            given[field] = _value(kinds[field], text.strip())
        except ValueError:
            raise SettingsError(
                f"--set {name}: expected {_allowed(kinds[field])}, got {text!r}"
            ) from None
    return cls(**given)


def _unknown(name: str, names: list[str], agent: str) -> str:
    if not names:
        return f"--set {name}: the agent {agent!r} has no options to set"
    meant = did_you_mean(name.replace("-", "_"), names)
    return (
        f"--set {name}: the agent {agent!r} has the options {', '.join(names)}; got "
        f"{name!r}{meant} (memorymaze agents {agent} says what each does)"
    )


def _value(kind: Any, text: str) -> Any:
    """Return what a text says, as a type.

    Raises:
        ValueError: It says nothing of this type.
    """
    parts = get_args(kind)
    if get_origin(kind) in {Union, UnionType}:
        # `none` first: a text could say it too.
        for part in sorted(parts, key=lambda part: part is not NoneType):
            try:
                return _value(part, text)
            except ValueError:
                continue
    elif get_origin(kind) is Literal:
        for part in parts:
            if str(part) == text:
                return part
    elif get_origin(kind) is tuple:
        return tuple(_value(parts[0], part.strip()) for part in text.split(","))
    elif kind is NoneType and text == "none":
        return None
    elif kind is bool and text in {"true", "false"}:
        return text == "true"
    elif kind is str and text:
        return text
    elif kind is int:
        return int(text)
    elif kind is float and math.isfinite(float(text)):
        return float(text)
    raise ValueError(text)


def _allowed(kind: Any) -> str:
    """Say in words what `_value` takes for a type.

    Raises:
        TypeError: It takes nothing for this type.
    """
    parts = get_args(kind)
    if get_origin(kind) in {Union, UnionType}:
        # `none` last, as one says it.
        ordered = sorted(parts, key=lambda part: part is NoneType)
        return " or ".join(_allowed(part) for part in ordered)
    if get_origin(kind) is Literal:
        *others, last = [str(part) for part in parts]
        return f"{', '.join(others)} or {last}" if others else last
    if get_origin(kind) is tuple and len(parts) == 2 and parts[1] is Ellipsis:
        return f"a list such as 1,2,3, each {_allowed(parts[0])}"
    if kind in _WORDS:
        return _WORDS[kind]
    raise TypeError(f"an option cannot be of the type {kind}")


_WORDS: dict[Any, str] = {
    bool: "true or false",
    float: "a number",
    int: "a whole number",
    NoneType: "none",
    str: "a text",
}


def _as_given(value: Any) -> str:
    """Write a value as it would be given."""
    if isinstance(value, tuple):
        return ",".join(map(_as_given, value))  # pyright: ignore[reportUnknownArgumentType]
    return str(value).lower() if value is None or type(value) is bool else str(value)


def _strings_beneath(cls: type) -> dict[str, str]:
    """Return the string beneath each field of a class, by the field's name."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(cls)))
    body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) else []
    found: dict[str, str] = {}
    for field, beneath in pairwise(body):
        match field, beneath:
            case (
                ast.AnnAssign(target=ast.Name(id=name)),
                ast.Expr(value=ast.Constant(value=str(text))),
            ):
                found[name] = " ".join(text.split())
            case _:
                pass
    return found


def check_whole(name: str, value: int, *, least: int) -> None:
    """Refuse what is not a whole number of at least `least`.

    Raises:
        SettingsError: It is not; names the setting.
    """
    if type(value) is not int or value < least:
        raise SettingsError(
            f"{name}: expected a whole number of at least {least}, got {value!r}"
        )
