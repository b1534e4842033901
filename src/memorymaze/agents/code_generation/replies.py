"""What a reply may be held to and how it is read: numbered steps, or a program.

A reply has four parts: thought, first output, second thought, refined output; in a
single stage thought and output. Models keep to that more or less; the last output that
is there counts. The grammars are in GBNF, the notation of llama.cpp; a reply of the
program grammar parses, passes the type check, ends, and calls nothing but the control
API: the grammar is made from the API's signatures, so that it knows each call that
there is.
"""

import dataclasses
import functools
import re
import types
import typing
from collections.abc import Iterator
from textwrap import dedent

from memorymaze.basics.errors import LanguageModelError
from memorymaze.robot.api.control import DIRECTIONS, Robot
from memorymaze.robot.api.specification import API_NAMES

MOST_STEPS = 12
DEPTH = 2
"""Loops and conditions inside one another, at most."""
TOP_STATEMENTS = 12
BLOCK_STATEMENTS = 4
"""At most in a block; with the depth this bounds the length of a program, so that no
reply is cut off in the middle."""
TERMINALS = r"""
number ::= [1-9] [0-9]? ("." [05])?
angle ::= "-"? [1-9] [0-9]?
count ::= [1-9] [0-9]?
words ::= [a-zA-Z] [a-zA-Z0-9]{0,14} (" " [a-zA-Z0-9]{1,15}){0,4}
"""


_REFINED = re.compile(
    r"^[ \t#*_]*refined[ \t]+(?:steps|program|output|code)\b[ \t*_:]*"
    r"|^[ \t*_]*(?:steps|program)[ \t*_]*:[ \t*_]*",
    re.I | re.M,
)
_STEP = re.compile(r"([ \t]*)[*_]*(\d{1,3})[.):][*_]*[ \t]+(\S.*)")
_FENCE = re.compile(r"[ \t]*(```|~~~)[`~]*[ \t]*([\w+-]*)")
_PYTHON = frozenset({"", "python", "python3", "py", "py3"})
_API_CALL = re.compile(rf"^[ \t]*(?:\w+ = )?(?:{'|'.join(API_NAMES)})\(", re.M)


def read_steps(reply: str) -> list[str]:
    """Return the steps of the last numbered list, one line each.

    A step may run over several lines; an empty line ends it.
    """
    steps: list[str] = []
    in_step = False
    for line in _after_refined(_plain(reply)).splitlines():
        start = _STEP.match(line)
        number = int(start[2]) if start else 0
        if start and number == 1 and not (in_step and start[1]):
            steps = [start[3].strip()]
            in_step = True
        elif start and steps and number == len(steps) + 1:
            steps.append(start[3].strip())
            in_step = True
        elif in_step and line.strip():
            steps[-1] += " " + line.strip()
        else:
            in_step = False
    if not steps:
        raise LanguageModelError(
            f"the reply has no numbered list of steps: {_beginning(reply)}"
        )
    return steps


def read_program(reply: str) -> str:
    """Return the last program.

    A fence that is not closed ends with the reply. Without any fence, text after the
    heading of the refined program, or a reply that is nothing but a program, counts.
    """
    text = _plain(reply)
    programs = [
        block
        for language, block in _fenced_blocks(text)
        if language in _PYTHON and block.strip()
    ]
    if programs:
        return dedent(programs[-1]).strip("\n") + "\n"
    rest = _after_refined(text)
    if _API_CALL.search(rest) and (rest != text or _begins_with_code(text)):
        return dedent(rest).strip() + "\n"
    raise LanguageModelError(f"the reply has no program in it: {_beginning(reply)}")


def _plain(reply: str) -> str:
    return reply.replace("\r\n", "\n").replace("\r", "\n")


def _fenced_blocks(text: str) -> Iterator[tuple[str, str]]:
    """Yield language and text of each fenced block."""
    mark = language = ""
    block: list[str] = []
    for line in text.split("\n"):
        fence = _FENCE.match(line)
        if not mark and fence:
            mark, language, block = fence[1], fence[2].lower(), []
        elif mark and line.rstrip().endswith(mark) and not (fence and fence[2]):
            # Models forget the line end before the closing fence.
            last = line.rstrip().rstrip(mark[0])
            yield language, "\n".join([*block, *([last] if last.strip() else [])])
            mark = ""
        elif mark:
            block.append(line)
    if mark:
        yield language, "\n".join(block)


def _after_refined(text: str) -> str:
    """Return what follows the last heading of a refined output; all if there is none."""
    headings = list(_REFINED.finditer(text))
    return text[headings[-1].end() :] if headings else text


def _begins_with_code(text: str) -> bool:
    first = text.lstrip().partition("\n")[0]
    return bool(
        re.match(r"(def |#|import |from |for |while |if )", first)
        or re.match(r"\w+ = ", first)
        or _API_CALL.match(first)
    )


def _beginning(reply: str) -> str:
    return repr(" ".join(reply.split())[:80])


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
    hints = {name: typing.get_type_hints(getattr(Robot, name)) for name in API_NAMES}
    calls = {name: _call(name, kinds) for name, kinds in hints.items()}
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


def _call(name: str, hints: dict[str, object]) -> str:
    """Return the rule of a call with all that can stand between its brackets."""
    given: list[str] = []
    for parameter, kind in hints.items():
        if parameter == "return":
            continue
        if kind is float:
            given.append("angle" if parameter == "degrees" else "number")
        elif kind is str:
            rule = "direction" if parameter == "direction" else "words"
            given.append(f'"\\"" {rule} "\\""')
        else:
            raise TypeError(f"{name}: no grammar for its parameter {parameter}")
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
