"""The GBNF grammar of a plan as JSON, for models that can be held to one.

It is made from the records, so that it knows each of their fields: required ones come
first, the others in the records' order, and what is left out has its default. Bounded, so
that a small model comes to an end.
"""

import types
import typing
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import cache
from typing import Any, Literal

from memorymaze.language.plans.files import ALWAYS, KEYS
from memorymaze.language.plans.records import Doubt, Leg, Ordinal, RoutePlan

MOST_TOLD, MOST_PARTS = 12, 4
"""Legs of a plan, and parts of any other list, at most."""
_TERMINALS = r"""
boolean ::= "true" | "false"
share ::= "0" ("." [0-9]{1,2})? | "1"
whole ::= [1-9] [0-9]?
ordinal ::= "-1" | whole
number ::= [1-9] [0-9]{0,3} ("." [0-9])?
string ::= "\"" [a-zA-Z0-9] [a-zA-Z0-9 '&.-]{0,48} "\""
"""


@cache
def plan_grammar() -> str:
    """Return the grammar of one plan, without spaces between its parts."""
    rules: dict[str, str] = {}
    root = _rule(RoutePlan, rules)
    lines = [f"{name} ::= {body}" for name, body in rules.items()]
    return "\n".join([f"root ::= {root}", *lines, _TERMINALS.strip()]) + "\n"


def _rule(kind: Any, rules: dict[str, str]) -> str:
    """Return what a value of a type is written as; records become rules of their own."""
    if kind in {Doubt, Ordinal}:
        return "share" if kind == Doubt else "ordinal"
    if typing.get_origin(kind) is typing.Annotated:
        return _rule(typing.get_args(kind)[0], rules)
    if is_dataclass(kind):
        name = str(getattr(kind, "__name__", "")).lower()
        if name not in rules:
            rules[name] = ""
            rules[name] = _record(kind, name, rules)
        return name
    given = typing.get_args(kind)
    origin = typing.get_origin(kind)
    if origin is Literal:
        return "(" + " | ".join(_written(each) for each in given) + ")"
    if origin in {types.UnionType, typing.Union}:
        [one] = [each for each in given if each is not type(None)]
        return _rule(one, rules)
    if origin is tuple:
        part = _rule(given[0], rules)
        most = MOST_TOLD if given[0] is Leg else MOST_PARTS
        return f'"[" ({part} ("," {part}){{0,{most - 1}}})? "]"'
    return {bool: "boolean", int: "whole", float: "number", str: "string"}[kind]


def _record(kind: Any, name: str, rules: dict[str, str]) -> str:
    hints = typing.get_type_hints(kind, include_extras=True)
    members = {
        field: f'{_written(KEYS.get(field.name, field.name))} ":" '
        + _rule(hints[field.name], rules)
        for field in fields(kind)
    }
    needed = [text for field, text in members.items() if _is_needed(field)]
    others = [text for field, text in members.items() if not _is_needed(field)]
    for number, text in enumerate(others, start=1):
        rest = f"{name}-{number + 1}"
        more = number < len(others)
        after = f' ("," {rest})? | {rest}' if more else ""
        rules[f"{name}-{number}"] = text + after
    begun = ' "," '.join(needed)
    if others:
        begun += f' ("," {name}-1)?' if needed else f" {name}-1?"
    return f'"{{" {begun} "}}"'


def _is_needed(field: "Field[Any]") -> bool:
    return field.default is MISSING or field.name in ALWAYS


def _written(text: str) -> str:
    return f'"\\"{text}\\""'
