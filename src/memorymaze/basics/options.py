"""Options and settings: frozen dataclasses, set by name from the command line.

Whatever has options keeps a frozen dataclass of them in its own file: a default for each
field, and a string beneath it that says in one sentence what it does. That is all there
is to write; names, types, defaults and meanings are read from it.

    @dataclass(frozen=True, slots=True)
    class WalkerOptions:
        stride: float = 0.5
        \"\"\"Metres per step.\"\"\"

    options = read_options(WalkerOptions, [("stride", "0.75")], agent="walker")
    options = parse_options(WalkerOptions, "stride=0.75", subject="walker setting")
"""

import ast
import inspect
import math
import re
import textwrap
from collections.abc import Collection, Iterable, Mapping
from dataclasses import MISSING, dataclass, fields, replace
from functools import cache
from itertools import pairwise
from types import NoneType, UnionType
from typing import Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from memorymaze.basics.errors import SettingsError, did_you_mean

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


def list_options(cls: type, only: Collection[str] | None = None) -> list[Option]:
    """Return the options of an agent, in the order of its dataclass."""
    kinds = get_type_hints(cls)
    meanings = _strings_beneath(cls)
    found: list[Option] = []
    for field in fields(cls):
        if only is not None and field.name not in only:
            continue
        if field.default is MISSING or field.name not in meanings:
            raise TypeError(
                f"{cls.__name__}.{field.name}: expected a default and a string beneath "
                "it that says what it does"
            )
        default = as_given(field.default)
        meaning = meanings[field.name]
        # What a field reads itself is told by its meaning.
        reads_itself = "reader" in field.metadata
        allowed = "a text" if reads_itself else _allowed(kinds[field.name])
        found.append(Option(field.name, allowed, default, meaning))
    return found


def options_of(options: Any) -> tuple[tuple[str, str], ...]:
    """Return the names of options as they are set, with their values as one gives them."""
    return tuple(
        (each.name, as_given(getattr(options, each.name))) for each in fields(options)
    )


def read_options(
    cls: type[Options], pairs: Iterable[tuple[str, str]], *, agent: str
) -> Options:
    """Turn names and values from the command line into an agent's options.

    Whole numbers, numbers, `true` and `false`, words, one of several words (`Literal`),
    lists (`tuple[int, ...]`: `15,30,45`) and `none` are understood, as the fields' types
    say. What the dataclass itself refuses in `__post_init__` is passed on.

    The agent's name is for messages.
    """
    names = [field.name for field in fields(cls)]  # pyright: ignore[reportArgumentType]
    given: dict[str, str] = {}
    for name, text in pairs:
        # Dashes as everywhere on the command line.
        field = name.strip().replace("-", "_")
        if field not in names:
            raise SettingsError(_unknown(name, names, agent))
        _keep(given, field, text, "--set")
    return cls(**_values(cls, given, "--set"))


def read_value(cls: type, name: str, text: str, called: str) -> Any:
    """Turn a text into the value of a setting: a field of a dataclass, by its name.

    Besides what `read_options` understands, a type may have a class method `parse`, and a
    text `form` that says what it takes; or a field has a `reader` in its metadata, which
    says itself what it does not understand. Messages name the setting as it is `called`.
    """
    [field] = [each for each in fields(cls) if each.name == name]
    reader = field.metadata.get("reader")
    if reader is None:
        return _values(cls, {called: text}, "", {called: name})[name]
    return None if text == "none" and field.default is None else reader(text)


def called_on_command_line(cls: type, name: str) -> str:
    """Return how a setting is given there: by an option of its own, or with `--with`.

    Those have one that have a `metavar` in their metadata.
    """
    [field] = [each for each in fields(cls) if each.name == name]
    if "metavar" in field.metadata:
        return f"--{name.replace('_', '-')}"
    return f"--with {name}"


def parse_options(
    cls: type[Options],
    text: str,
    *,
    subject: str,
    start: Options | None = None,
    only: Collection[str] | None = None,
) -> Options:
    """Read settings that are written as one text: `things=4,kinds=cart+suitcase`.

    Values are understood as by `read_options`; lists are joined by `+`. A field whose
    metadata has `given_as` goes by that name.

    The subject, such as `obstacle setting`, begins messages. What is left out comes from
    `start`, or is as the fields' defaults; `only` names fields that may be given.
    """
    known = {
        field.metadata.get("given_as", field.name): field.name
        for field in fields(cls)  # pyright: ignore[reportArgumentType]
        if only is None or field.name in only
    }
    given: dict[str, str] = {}
    for part in filter(None, (piece.strip() for piece in text.split(","))):
        name, equals, value = (piece.strip() for piece in part.partition("="))
        if not equals or name not in known:
            raise SettingsError(
                f"{subject} {part!r}: expected NAME=VALUE, where NAME is one of "
                f"{', '.join(known)}{did_you_mean(name, known)}"
            )
        _keep(given, name, value, subject)
    values = _values(cls, given, subject, known)
    return cls(**values) if start is None else replace(start, **values)  # pyright: ignore[reportArgumentType, reportCallIssue]


def write_options(
    settings: Any,
    only: Collection[str] | None = None,
    *,
    changed_from: Any = None,
) -> str:
    """Write settings as `parse_options` reads them.

    `only` names fields to tell; those that are the same in `changed_from` are left out.
    """
    return ",".join(
        f"{field.metadata.get('given_as', field.name)}={as_given(_plain(value), '+')}"
        for field in fields(settings)
        if only is None or field.name in only
        for value in [getattr(settings, field.name)]
        if changed_from is None or value != getattr(changed_from, field.name)
    )


def _plain(value: Any) -> Any:
    """Return whole numbers without a decimal point."""
    return int(value) if type(value) is float and value.is_integer() else value


def _keep(given: dict[str, str], name: str, text: str, subject: str) -> None:
    if name in given:
        raise SettingsError(f"{subject} {name}: given twice; leave one out")
    given[name] = text.strip()


def _values(
    cls: type,
    given: Mapping[str, str],
    subject: str,
    known: Mapping[str, str] | None = None,
) -> dict[str, Any]:
    """Return values by field; `known` has the fields of the names that are given."""
    kinds = get_type_hints(cls)
    between = "," if known is None else "+"
    values: dict[str, Any] = {}
    for name, text in given.items():
        field = name if known is None else known[name]
        try:
            values[field] = _value(kinds[field], text)
        except ValueError:
            raise SettingsError(
                f"{subject} {name}".lstrip()
                + f": expected {_allowed(kinds[field], between)}, got {text!r}"
            ) from None
    return values


def _unknown(name: str, names: list[str], agent: str) -> str:
    if not names:
        return f"--set {name}: the agent {agent!r} has no options to set"
    meant = did_you_mean(name.replace("-", "_"), names)
    return (
        f"--set {name}: the agent {agent!r} has the options {', '.join(names)}; got "
        f"{name!r}{meant} (memorymaze agents {agent} says what each does)"
    )


def _value(kind: Any, text: str) -> Any:
    """Return what a text says, as a type."""
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
        return tuple(_value(parts[0], part.strip()) for part in re.split("[,+]", text))
    elif hasattr(kind, "parse"):
        return kind.parse(text)
    elif kind is NoneType and text == "none":
        return None
    elif kind is bool and text in {"true", "false"}:
        return text == "true"
    elif kind is str and text:
        return text
    elif kind in (int, float) and ("_" in text or not text.isascii()):
        # Python reads them, but nobody writes numbers so on purpose.
        raise ValueError(text)
    elif kind is int:
        return int(text)
    elif kind is float and math.isfinite(float(text)):
        return float(text)
    raise ValueError(text)


def _allowed(kind: Any, between: str = ",") -> str:
    """Say in words what `_value` takes for a type."""
    parts = get_args(kind)
    if get_origin(kind) in {Union, UnionType}:
        # `none` last, as one says it.
        ordered = sorted(parts, key=lambda part: part is NoneType)
        return " or ".join(_allowed(part, between) for part in ordered)
    if get_origin(kind) is Literal:
        *others, last = [str(part) for part in parts]
        return f"{', '.join(others)} or {last}" if others else last
    if get_origin(kind) is tuple and len(parts) == 2 and parts[1] is Ellipsis:
        return f"a list such as {between.join('123')}, each {_allowed(parts[0])}"
    if hasattr(kind, "form"):
        return kind.form
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


def as_given(value: Any, between: str = ",") -> str:
    """Write a value as it would be given."""
    if isinstance(value, tuple):
        return between.join(map(as_given, value))  # pyright: ignore[reportUnknownArgumentType]
    return str(value).lower() if value is None or type(value) is bool else str(value)


@cache
def _strings_beneath(cls: type) -> dict[str, str]:
    """Return the string beneath each field of a class, by the field's name."""
    found: dict[str, str] = {}
    for base in cls.__bases__:
        found |= {} if base is object else _strings_beneath(base)
    tree = ast.parse(textwrap.dedent(inspect.getsource(cls)))
    body = tree.body[0].body if isinstance(tree.body[0], ast.ClassDef) else []
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


def check_number(
    name: str,
    value: object,
    least: float = -math.inf,
    most: float = math.inf,
    *,
    above: float | None = None,
    whole: bool = False,
    may_be_infinite: bool = False,
) -> None:
    """Refuse what is no number, no finite one, or out of bounds; messages begin with `name`.

    It must be greater than `above`, besides; infinity may be where there is no `most`.
    """
    if (
        isinstance(value, int if whole else int | float)
        and not isinstance(value, bool)
        and (abs(value) < math.inf or (may_be_infinite and value == math.inf))
        and least <= value <= most
        and (above is None or value > above)
    ):
        return
    bounds = "" if above is None else f"greater than {above:g}"
    if above is None and math.isfinite(least):
        bounds = f"of at least {least:g}"
        if math.isfinite(most):
            bounds = f"from {least:g} to {most:g}"
    elif math.isfinite(most):
        bounds += f"{' and ' if bounds else 'of '}at most {most:g}"
    kind = "whole number" if whole else "number" if bounds else "finite number"
    raise SettingsError(
        f"{name}: expected a {kind} {bounds}".rstrip() + f", got {value!r}"
    )


def check_kind(name: str, value: object, kind: type | UnionType, wanted: str) -> None:
    """Refuse what is of another type than `kind`, which the message calls `wanted`."""
    if not isinstance(value, kind):
        raise SettingsError(f"{name}: expected {wanted}, got {value!r}")


def check_word(name: str, value: object, words: Any) -> None:
    """Refuse what is none of the words of a `Literal`."""
    if value not in get_args(words):
        raise SettingsError(
            f"{name}: expected one of {', '.join(map(str, get_args(words)))}; got "
            f"{value!r}"
        )


def check_whole(name: str, value: int, *, least: int) -> None:
    """Refuse what is not a whole number of at least `least`; see `check_number`."""
    check_number(name, value, least, whole=True)


def check_least(options: object, **least: int) -> None:
    """Refuse an agent's options that are given and no whole numbers of at least so much."""
    for name, lowest in least.items():
        value = getattr(options, name)
        if value is not None:
            check_whole(f"--set {name}", value, least=lowest)
