"""What the type checker's findings on a program mean for it.

Only findings that leave no doubt count: the program is not Python, uses a name that
nothing defines, misuses the control API, or imports what the sandbox does not have.
What a type checker holds against careless but working code (a value that might be
None, an annotation that does not fit) is left to the run.
"""

import builtins
import json
import re
from dataclasses import dataclass
from typing import Any

from memorymaze.basics.errors import ProgramError
from memorymaze.robot.api.specification import API_NAMES, API_RECORDS

FORBIDDEN_BUILTINS = frozenset({
    "__import__",
    "breakpoint",
    "compile",
    "eval",
    "exec",
    "globals",
    "open",
})
"""Builtins by which a program reaches for what lies outside the sandbox."""

_OUTSIDE_MODULES = frozenset({"builtins", "os", "pathlib", "sys"})
_API_RECORD_WORDS = frozenset([
    *API_RECORDS,
    *(f"list[{record}]" for record in API_RECORDS),
])
_ALWAYS_COUNT = frozenset({"invalid-await", "invalid-syntax"})
_COUNT_ON_THE_API = frozenset({
    "call-non-callable",
    "missing-argument",
    "not-iterable",
    "not-subscriptable",
    "parameter-already-assigned",
    "too-many-positional-arguments",
    "unknown-argument",
    "unresolved-attribute",
    "unsupported-operator",
})
_DUNDER = re.compile(r"__\w+__")
_QUOTED = re.compile(r"`([^`]*)`")


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing the type checker holds against a program."""

    rule: str
    """The checker's name for it, such as `unresolved-reference`."""
    line: int
    """1-based line of the program."""
    message: str
    counts: bool
    """Whether the program is refused for it."""
    unsafe: bool = False
    """Whether the program reaches for something outside the API."""


def read_findings(
    diagnostics: str, names: tuple[str, ...] = API_NAMES
) -> list[Finding]:
    """Judge the type checker's diagnostics: one JSON object per line.

    `names` are the functions that the program is given.
    """
    # Not splitlines(): messages quote the program, with what else may end a line.
    entries = map(json.loads, filter(str.strip, diagnostics.split("\n")))
    return [_judge(entry, names) for entry in entries if entry["severity"] == "error"]


def first_error(findings: list[Finding]) -> ProgramError | None:
    """Return the error to refuse the program with, or None when nothing counts.

    What is no Python comes first, as all else may follow from it; then what is unsafe.
    """
    counted = [finding for finding in findings if finding.counts]
    if not counted:
        return None
    worst = min(
        counted,
        key=lambda finding: (finding.rule != "invalid-syntax", not finding.unsafe),
    )
    return ProgramError(
        f"line {worst.line}: {worst.message} [{worst.rule}]",
        line=worst.line,
        unsafe=worst.unsafe,
    )


def _judge(entry: dict[str, Any], names: tuple[str, ...]) -> Finding:
    rule: str = entry["code"]
    message: str = entry["message"]
    quoted = _QUOTED.findall(message)
    counts, unsafe = False, False
    match rule, quoted:
        case _ if "__future__" in message:
            pass  # does nothing here; the checker only dislikes its place
        case "unresolved-import", [module, *_]:
            counts = True
            unsafe = message.startswith("Cannot") or module in _OUTSIDE_MODULES
        case "unresolved-reference", [name, *_]:
            unsafe = name in FORBIDDEN_BUILTINS
            counts = unsafe or not hasattr(builtins, name)
        case "unresolved-attribute", [module, member] if message.startswith("Module"):
            counts = True
            unsafe = module in _OUTSIDE_MODULES and member != "exit"
        case "unresolved-attribute", _ if any(map(_DUNDER.fullmatch, quoted)):
            counts = unsafe = True
        case "invalid-argument-type", [function, _, found] if function in names:
            counts = _is_one_type(found)
        case _, _:
            counts = rule in _ALWAYS_COUNT or (
                rule in _COUNT_ON_THE_API
                and not _API_RECORD_WORDS.union(names).isdisjoint(quoted)
            )
    return Finding(rule, entry["location"]["row"], message, counts, unsafe)


def _is_one_type(found: str) -> bool:
    """Whether a type is no union: of several types, the right one may be at hand."""
    return " | " not in found and not re.match(r"Literal\[.*,", found)
