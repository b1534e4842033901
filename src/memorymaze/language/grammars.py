"""Grammars that hold a model's reply to a form: numbered steps, or a program.

They are in GBNF, the notation of llama.cpp. A reply of the program grammar parses,
passes the type check, ends, and calls nothing but the control API: the grammar is made
from the API's signatures, so that it knows each call that there is.
"""

import dataclasses
import functools
import inspect
import types
import typing
from collections.abc import Iterator

from memorymaze.robot.api import DIRECTIONS, Robot
from memorymaze.robot.specification import API_NAMES

MOST_STEPS = 12
DEPTH = 2
"""Loops and conditions inside one another, at most."""
TOP_STATEMENTS = 12
BLOCK_STATEMENTS = 4
"""At most in a block; with the depth this bounds the length of a program, so that no
reply is cut off in the middle."""

TERMINALS = r"""
number ::= [1-9] [0-9]? ("." [05])?
count ::= [1-9] [0-9]?
words ::= [a-zA-Z] [a-zA-Z0-9]{0,14} (" " [a-zA-Z0-9]{1,15}){0,4}
"""


@functools.cache
def steps_grammar() -> str:
    """Return the grammar of a list of one to twelve numbered steps, a line each."""
    rules = ["root ::= item1", r"step ::= [A-Z] [a-zA-Z0-9 ,.'-]{4,140}"]
    for number in range(1, MOST_STEPS + 1):
        rest = f' ("\\n" item{number + 1})?' if number < MOST_STEPS else ""
        rules.append(f'item{number} ::= "{number}. " step{rest}')
    return "\n".join(rules) + "\n"


@functools.cache
def program_grammar() -> str:
    """Return the grammar of a fenced Python program that ends with `stop()`.

    Its statements are calls of the control API, `for` loops with a fixed count, `if`
    and `else` with what a call returns as the condition, and `break`.
    """
    signatures = {name: inspect.signature(getattr(Robot, name)) for name in API_NAMES}
    hints = {name: typing.get_type_hints(getattr(Robot, name)) for name in API_NAMES}
    calls = {
        name: _call(name, signature, hints[name])
        for name, signature in signatures.items()
    }
    actions = [call for name, call in calls.items() if name != "stop"]
    conditions = [
        condition
        for name, call in calls.items()
        for condition in _conditions(call, hints[name]["return"])
    ]
    rules = [
        f'root ::= "```python\\n" top{{1,{TOP_STATEMENTS}}} "stop()\\n```"',
        "top ::= " + _statement(0, looped=False),
        f"action ::= {' | '.join(actions)}",
        f"condition ::= {' | '.join(conditions)}",
        f"direction ::= {_choice(DIRECTIONS)}",
        TERMINALS.strip(),
    ]
    for depth in range(1, DEPTH + 1):
        for name, looped in (("block", False), ("loop", True)):
            rules.append(f"{name}{depth} ::= {name}line{depth}{{1,{BLOCK_STATEMENTS}}}")
            rules.append(f"{name}line{depth} ::= {_statement(depth, looped=looped)}")
    return "\n".join(rules) + "\n"


def _statement(depth: int, *, looped: bool) -> str:
    """Return the alternatives of a statement, each with its indentation and line end."""
    indent = " " * 4 * depth
    choices = [f'"{indent}" action "\\n"']
    if looped:
        choices.append(f'"{indent}break\\n"')
    if depth < DEPTH:
        inner = f"{'loop' if looped else 'block'}{depth + 1}"
        choices += [
            f'"{indent}for _ in range(" count "):\\n" loop{depth + 1}',
            f'"{indent}if " condition ":\\n" {inner} ("{indent}else:\\n" {inner})?',
        ]
    return " | ".join(choices)


def _call(name: str, signature: inspect.Signature, hints: dict[str, object]) -> str:
    """Return the rule of a call with all that can stand between its brackets."""
    given: list[str] = []
    for parameter in list(signature.parameters.values())[1:]:
        kind = hints[parameter.name]
        if kind is float:
            given.append("number")
        elif kind is str:
            rule = "direction" if parameter.name == "direction" else "words"
            given.append(f'"\\"" {rule} "\\""')
        else:
            raise TypeError(f"{name}: no grammar for its parameter {parameter.name}")
    between = ' ", " '.join(given)
    return f'"{name}(" {between} ")"' if given else f'"{name}()"'


def _conditions(call: str, result: object) -> Iterator[str]:
    """Yield what can be asked of what a call returns."""
    origin, arguments = typing.get_origin(result), typing.get_args(result)
    if origin is list:
        for negation in ("", '"not " '):
            yield f"{negation}{call}"
        if typing.get_origin(arguments[0]) is typing.Literal:
            for word in ("in", "not in"):
                yield f'"\\"" direction "\\" {word} " {call}'
    elif origin in (typing.Union, types.UnionType) and type(None) in arguments:
        for word in ("is", "is not"):
            yield f'{call} " {word} None"'
    elif result is float:
        for sign in ("<", ">"):
            yield f'{call} " {sign} " number'
    elif dataclasses.is_dataclass(result):
        hints = typing.get_type_hints(result)
        for field, kind in hints.items():
            if kind is bool:
                yield f'{call} ".{field}"'
                yield f'"not " {call} ".{field}"'
            elif typing.get_origin(kind) is typing.Literal:
                words = f"({_choice(typing.get_args(kind))})"
                for sign in ("==", "!="):
                    yield f'{call} ".{field} {sign} \\"" {words} "\\""'


def _choice(words: tuple[str, ...]) -> str:
    return " | ".join(f'"{word}"' for word in words)
