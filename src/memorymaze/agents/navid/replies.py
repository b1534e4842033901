"""Reads the next motion from what a model says; two readers, which refuse by `ValueError`.

`read_navid_reply` takes JSON or one clear sentence, and nothing else moves the robot.
`read_reply_as_released` does as the released NaVid evaluation does, faults and all. What
they say of a reply that they refuse is for people and the model.
"""

import functools
import json
import math
import re
from collections.abc import Iterator
from typing import Any, cast

from memorymaze.agents.asking import without_thoughts
from memorymaze.agents.navid.motions import Command, Motion, Motions

LONGEST_REPLY = 20_000
"""Characters beyond which a reply is not read."""


_NUMBER = r"[-+]?[0-9]{1,6}(?:\.[0-9]{1,6})?"
_END = r"(?=\s*(?:[.,;:!?)\]}\"'`*]|$))"
_FORWARD = re.compile(
    rf"\bforward\s*(?:by|for)?\s*(?P<amount>{_NUMBER})"
    rf"(?:\s*(?P<unit>cm|centimet(?:er|re)s?|m|met(?:er|re)s?)\b|{_END})",
    re.MULTILINE,
)
_TURN = re.compile(
    rf"\b(?P<side>left|right)\s*(?:by)?\s*(?P<amount>{_NUMBER})"
    rf"(?:\s*(?:degrees?\b|deg\b|°)|{_END})",
    re.MULTILINE,
)
_MOVES: tuple[Motion, ...] = ("forward", "left", "right")
_QUOTES = r"[\"'*`]*"
_STOP = re.compile(
    rf"(?:^|\baction(?: is)?:? (?:to )?){_QUOTES}stop{_QUOTES}[.!]?{_QUOTES}$",
    re.MULTILINE,
)
"""A line of its own, or the end of one: the next action is stop."""
_NEGATION = re.compile(
    r"(?:\bnot|\bnever|\bcannot|n['\u2019]t|\bwithout)\s+(?:\w+\s+)?$"
)
_ACTIONS: dict[str, Motion] = {
    "forward": "forward",
    "move forward": "forward",
    "go forward": "forward",
    "left": "left",
    "turn left": "left",
    "right": "right",
    "turn right": "right",
    "stop": "stop",
}


def read_navid_reply(text: str, motions: Motions) -> Command:
    """Read a reply strictly.

    A JSON object with `action` and `amount` decides, wherever in the reply it is.
    Without one, the reply must have exactly one command such as `move forward 50 cm`,
    `turn left 30 degrees` or `stop`. What contradicts itself, negates, names no amount
    or less than one primitive is refused. Thoughts between `<think>` marks do not count.

    Amounts beyond the largest of the motions are cut to it.
    """
    text = without_thoughts(text)
    if len(text) > LONGEST_REPLY:
        raise ValueError(f"the reply has more than {LONGEST_REPLY} characters")
    objects = list(_objects_with_action(text))
    if objects:
        return _agreed([_read_object(each, motions) for each in objects])
    return _read_sentence(text, motions)


def read_reply_as_released(text: str, motions: Motions) -> Command:
    """Read a reply as the released evaluation does.

    Its last character is dropped, because a full stop is expected there: a bare `stop`
    becomes `sto`. Of `stop`, `forward`, `left` and `right` the first in this order
    that occurs anywhere counts, with the first whole number anywhere as its amount.

    Amounts beyond the largest of the motions are cut to it.
    """
    text = text[:-1]
    if "stop" in text:
        return Command("stop")
    named: list[Motion] = [motion for motion in _MOVES if motion in text]
    if not named:
        raise ValueError("the reply names no motion")
    number = re.search(r"-?[0-9]+", text)
    if number is None:
        raise ValueError(f"the reply names no amount for {named[0]}")
    # Longer numbers than Python reads at once are the largest amount anyway.
    return _counted(named[0], float(number[0][:20]), motions)


def _objects_with_action(text: str) -> Iterator[dict[str, Any]]:
    """Yield the JSON objects of a reply that have an `action`, outermost ones."""
    decoder = json.JSONDecoder()
    start = text.find("{")
    while start >= 0:
        end = start + 1
        try:
            value, end = decoder.raw_decode(text, start)
        except (ValueError, RecursionError):
            value = None
        if isinstance(value, dict):
            named = cast(dict[str, Any], value)
            lowered = {name.strip().lower(): part for name, part in named.items()}
            if "action" in lowered:
                yield lowered
        start = text.find("{", end)


def _read_object(value: dict[str, Any], motions: Motions) -> Command:
    action = value["action"]
    if not isinstance(action, str):
        raise ValueError(f"`action` is not a text but {_shown(action)}")
    motion = _ACTIONS.get(" ".join(re.split(r"[\s_-]+", action.strip().lower())))
    amount = value.get("amount")
    if motion == "stop":
        return Command("stop")
    if motion is None:
        # The whole sentence may stand in `action`.
        return _read_sentence(action, motions)
    if isinstance(amount, str):
        return _read_sentence(f"{motion} {amount}", motions)
    if isinstance(amount, int | float) and not isinstance(amount, bool):
        return _counted(motion, amount, motions)
    raise ValueError(f"`amount` is not a number but {_shown(amount)}")


def _read_sentence(text: str, motions: Motions) -> Command:
    # One blank between words: patterns with room for blanks stay linear.
    lines = (" ".join(line.split()) for line in text.lower().splitlines())
    text = "\n".join(line for line in lines if line)
    read: list[Command] = []
    for command in (*_FORWARD.finditer(text), *_TURN.finditer(text)):
        before = text[max(0, command.start() - 40) : command.start()]
        if _NEGATION.search(before):
            raise ValueError(f"the reply negates a command: {command[0].strip()!r}")
        said = command.groupdict()
        motion = cast(Motion, said.get("side", "forward"))
        scale = 100 if (said.get("unit") or "cm").startswith("m") else 1
        read.append(_counted(motion, float(said["amount"]) * scale, motions))
    stops = [Command("stop")] * len(_STOP.findall(text))
    if len(re.findall(r"\bstop\b", text)) > len(stops):
        raise ValueError("the reply speaks of a stop, but not as the next action")
    read += stops
    if not read:
        raise ValueError("the reply has no command with an amount, and no stop")
    return _agreed(read)


def _counted(motion: Motion, amount: float, motions: Motions) -> Command:
    if not math.isfinite(amount):
        raise ValueError(f"the amount of {motion} is {amount}")
    if (count := motions.count(motion, amount)) < 1:
        unit = motions.unit(motion)
        raise ValueError(f"{motion} {amount:g} is less than one motion of {unit}")
    return Command(motion, count)


def _agreed(read: list[Command]) -> Command:
    """Return what all say."""
    if any(each != read[0] for each in read):
        raise ValueError("the reply has several different commands")
    return read[0]


def _shown(value: object) -> str:
    return repr(value)[:40]


@functools.cache
def navid_reply_grammar(motions: Motions) -> str:
    """Return the grammar of the JSON object that the prompt asks for."""
    rules = [
        r'root ::= "{\"reason\": \"" reason "\", \"action\": \"" action "}"',
        "reason ::= [A-Z] [a-zA-Z0-9 ,.'-]{4,140}",
        r'action ::= "stop\"" | forward | turn',
        rf'forward ::= "forward\", \"amount\": " {_one_of(motions.amounts("forward"))}',
        r'turn ::= ("left" | "right") "\", \"amount\": " '
        + _one_of(motions.amounts("left")),
    ]
    return "\n".join(rules) + "\n"


def _one_of(amounts: tuple[int, ...]) -> str:
    return "(" + " | ".join(f'"{amount}"' for amount in amounts) + ")"
