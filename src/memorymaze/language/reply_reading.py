"""Finds what was asked for in a language model's reply: steps or a program.

A reply has four parts: thought, first output, second thought, refined output; in a
single stage thought and output. Models keep to that more or less; the last output that
is there counts.
"""

import re
from collections.abc import Iterator
from textwrap import dedent

from memorymaze.errors import LanguageModelError
from memorymaze.robot.specification import API_NAMES

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

    Raises:
        LanguageModelError: The reply has no numbered list.
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

    Raises:
        LanguageModelError: The reply has no program.
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
