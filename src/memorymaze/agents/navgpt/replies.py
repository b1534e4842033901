"""What a reply may be held to, and what the model wants by it: to go, to end, or neither."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

MOVE_ACTION = "go_to_viewpoint"
"""The only action there is."""

LONGEST_WORDS = 80
"""Characters of an id or action that is none."""

Fault = Literal["both", "unknown_action", "no_input", "no_action"]

_THINKING = re.compile(r"<think>.*?(?:</think>|\Z)", re.DOTALL | re.IGNORECASE)
_OBSERVATION = re.compile(r"^[ \t*#_]*Observation\b[^\n]*:", re.MULTILINE | re.I)


def _label(words: str, rest: str, flags: re.RegexFlag = re.NOFLAG) -> re.Pattern[str]:
    """Return what finds a label: in any case at a line's start, as written within."""
    return re.compile(
        rf"(?:^[ \t*#_]*(?i:{words})|(?<![A-Za-z]){words})[ \t*_\d]*:[ \t*_]*{rest}",
        re.MULTILINE | flags,
    )


_ACTION = _label("Action", r"(.*?)(?=[ \t*_#]*Action[ \t]+Input|$)")
_INPUT = _label(r"Action[ \t]+Input", "(.*)$")
_FINAL = _label(r"Final[ \t]+Answer", r"(.*)\Z", re.DOTALL)
_THOUGHT = re.compile(r"^[ \t*#_]*Thought[ \t*_]*:[ \t*_]*", re.MULTILINE | re.I)
_ID = re.compile(r"(?<![0-9a-f])[0-9a-f]{32}(?![0-9a-f])", re.I)
_QUOTES = " \t\"'`*.()[]<>{}"


@dataclass(frozen=True, slots=True)
class Move:
    """The model wants to go to a viewpoint."""

    viewpoint: str
    """An id as the model wrote it, which may be none."""


@dataclass(frozen=True, slots=True)
class Finish:
    """The model says that it has arrived."""

    answer: str


@dataclass(frozen=True, slots=True)
class Unreadable:
    """The reply says neither, or both."""

    fault: Fault
    told: str
    """What the model is told about it."""


def read_navgpt_reply(reply: str) -> Move | Finish | Unreadable:
    r"""Read a reply.

    What follows an `Observation:` is left out: models without a stop word go on and
    invent one. Thoughts between `<think>` marks are left out too.

    >>> read_navgpt_reply('Thought: On.\nAction: go_to_viewpoint\nAction Input: "0f"')
    Move(viewpoint='0f')
    >>> read_navgpt_reply("Final Answer: here")
    Finish(answer='here')
    >>> read_navgpt_reply("Hello!").fault
    'no_action'
    """
    text = _own_words(reply)
    final, action = _FINAL.search(text), _ACTION.search(text)
    if final and action:
        return Unreadable(
            "both",
            "Your reply has both an action and a final answer. Write one of the two.",
        )
    if final:
        return Finish(final[1].strip())
    if action is None:
        return Unreadable(
            "no_action",
            "Your reply has no action. After the thought write a line `Action: "
            f"{MOVE_ACTION}` and a line `Action Input:` with a viewpoint, or a line "
            "`Final Answer:` if the destination is reached.",
        )
    called = action[1].strip(_QUOTES)
    if called.casefold() != MOVE_ACTION:
        return Unreadable(
            "unknown_action",
            f"There is no action {called[:LONGEST_WORDS]!r}. The only action is "
            f"{MOVE_ACTION}.",
        )
    given = _INPUT.search(text, action.start())
    # The id may stand on the line beneath.
    wanted = "" if given is None else text[given.start(1) :].strip().partition("\n")[0]
    identity = _ID.search(wanted)
    viewpoint = (
        identity[0].lower() if identity else wanted.strip(_QUOTES)[:LONGEST_WORDS]
    )
    if not viewpoint:
        return Unreadable(
            "no_input",
            f"The action {MOVE_ACTION} needs a viewpoint. Write a line `Action Input:` "
            "with one of the viewpoints listed.",
        )
    return Move(viewpoint)


def thought_in_reply(reply: str) -> str:
    """Return the thought in a reply, without the action or answer after it."""
    text = _own_words(reply)
    ends = [found.start() for each in (_ACTION, _FINAL) if (found := each.search(text))]
    return _THOUGHT.sub("", text[: min(ends, default=len(text))], count=1).strip()


def _own_words(reply: str) -> str:
    text = _THINKING.sub("", reply.replace("\r\n", "\n"))
    invented = _OBSERVATION.search(text)
    return text[: invented.start()] if invented else text


def navgpt_reply_grammar(viewpoints: Sequence[str]) -> str:
    """Return the grammar of one thought with a move or a final answer."""
    rules = [
        r'root ::= "Thought: " thought "\n" (finish | move)'
        if viewpoints
        else r'root ::= "Thought: " thought "\n" finish',
        r"thought ::= [A-Z] [a-zA-Z0-9 ,.'-]{9,160}",
        'finish ::= "Final Answer: arrived"',
    ]
    if viewpoints:
        known = " | ".join(f'"{each}"' for each in viewpoints)
        rules += [
            rf'move ::= "Action: {MOVE_ACTION}\nAction Input: " id',
            f"id ::= {known}",
        ]
    return "\n".join(rules) + "\n"
