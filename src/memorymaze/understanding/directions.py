"""Telling `turn left` from `the bench on the left`: what a direction word does."""

import re

from memorymaze.understanding.chunks import Chunk
from memorymaze.understanding.clause import (
    Clause,
    is_aside,
    towards_a_side,
)

_SIGN = re.compile(
    r"\b(?:sign|board|arrow|screen|signs|arrows|shows?|points?|pointing)\b"
)
_STARTS = re.compile(r"(?:start|begin|open|continue|lead)")
_EXISTS = re.compile(r"come|there|here")
_DOOR = re.compile(r"^(?:hand )?(?:door|wall|window|room)s?\b")
_LOOSE = ("with", "among")
_AWAY = re.compile(r"(?:away|from|out|off)\b")
_FACE = re.compile(r"(?:turn to )?face")


def is_turn(clause: Clause, at: int, *, after_turn: bool) -> bool:
    """Tell whether the direction at an index is a turn to make.

    Args:
        clause: The clause.
        at: Index of an `L` or `S`.
        after_turn: Whether the last thing read in this clause is a turn, or nothing.
    """
    chunk = clause.chunks[at]
    before = clause.kinds[:at].rstrip("H")
    after = clause.kinds[at + 1 :]
    if chunk.way in {None, "forward"}:
        return False
    last = before[-1:]
    if chunk.kind == "S" and is_aside(chunk) and last == "G":
        if chunk.text.endswith(("side", "sides")) or "N" in before:
            return False
        verb = clause.chunks[len(before) - 1].text
        return re.match(r"keep|leav|stay", verb) is None and not after.startswith("B")
    if last == "K" and is_aside(chunk) and "side" in chunk.text:
        return False
    if last in {"T", "K"} or (last == "G" and not after.startswith("N")):
        return not (after.startswith("B") and last == "G")
    if is_of_a_sign(clause, at) and towards_a_side(chunk):
        return True
    if "T" in before and not re.search("[NJBV]", before[before.rindex("T") :]):
        return True
    if chunk.kind == "S":
        return _is_turn_to_side(clause, chunk, before, after)
    return _is_bare_turn(clause, at, before, after, after_turn=after_turn)


def _is_bare_turn(
    clause: Clause, at: int, before: str, after: str, *, after_turn: bool
) -> bool:
    """Decide about `left` without `to the` or `on the`."""
    last = before[-1:]
    if not before and after.startswith("B"):
        return False
    if not before and after.startswith("N"):
        return _DOOR.search(clause.chunks[at + 1].text) is None
    if last == "N":
        bound = re.search("([AwQPUtV])N+$", before)
        return bound is not None and not clause.chunks[bound.start()].text.startswith(
            _LOOSE
        )
    if last == "B":
        return "N" not in before or "J" in before
    if last in {"A", "w"}:
        return False
    if last in {"L", "S"}:
        return after_turn
    return True


def _is_turn_to_side(clause: Clause, chunk: Chunk, before: str, after: str) -> bool:
    """Decide about `to the left`, `on the left`, `nine o'clock`."""
    if ("G" in before and not is_aside(chunk)) or "K" in before:
        return re.search("[NJ]", before) is None and not after.startswith("BN")
    bound = re.search("([AU])N+$", before)
    if towards_a_side(chunk) and bound is not None:
        loose = clause.chunks[bound.start()].text.startswith(_LOOSE)
        return re.search("[BV]", before) is None and not loose
    if re.search("TN$", before) and not re.match("[BN]", after):
        return True
    if before or re.match("[BN]", after):
        return before.endswith("Z") and not is_aside(chunk)
    clock = "clock" in chunk.text and re.match(r"(?:on|at|in) ", chunk.text) is None
    if not (towards_a_side(chunk) or clock):
        return False
    last = clause.last_event()
    if last is None:
        return True
    if last.kind == "turn" and last.way == chunk.way:
        return False
    return last.kind != "thing" or clock or _place_is_named(clause)


def _place_is_named(clause: Clause) -> bool:
    """Tell whether this sentence has named a place to turn at."""
    for event in reversed(clause.before):
        if event.kind in {"sentence", "turn"}:
            return False
        if event.kind == "end" or event.relation in {"at", "until", "after"}:
            return True
    return False


def faces(clause: Clause, at: int) -> bool:
    """Tell whether a verb only turns one to what is named next.

    `Face the clock` and `turn towards the clock`, but neither `when you face the clock`
    nor `turn left towards the clock`.
    """
    chunk = clause.chunks[at]
    after = clause.kinds[at + 1 :]
    if re.search("[LSO2M]", after.split("G")[0]) or not re.match("[AUtSH]?N", after):
        return False
    if _AWAY.match(clause.chunks[at + 1].text):
        return False
    if chunk.kind == "V":
        asked = _FACE.fullmatch(chunk.text) is not None
        return asked and re.search("[GTBVPUJ]", clause.kinds[:at]) is None
    if chunk.kind == "T" and chunk.text in {"turn", "rotate", "swing"}:
        return re.match("[AUt]N", after) is not None
    return False


def is_of_a_sign(clause: Clause, at: int) -> bool:
    """`The board says Offices, right`: where a sign points, not yet a turn."""
    verbs = [chunk.text for chunk in clause.chunks[:at] if chunk.kind in "TG"]
    if any(not verb.startswith("follow") for verb in verbs):
        return False
    words = " ".join(chunk.text for chunk in clause.chunks[:at])
    return _SIGN.search(words) is not None


def is_on_both_sides(clause: Clause, at: int) -> bool:
    """`Rooms left and right` is no turn; `at the windows left-right` is two."""
    if "-" in clause.chunks[at].text:
        return False
    before = clause.kinds[:at]
    return before.endswith("N") and re.search("[AwQPUt]N+$", before) is None


def names_a_way(clause: Clause, at: int, *, turn: bool) -> bool:
    """`There is a left`, `carpet starts to the left`: a way, not yet taken.

    Args:
        clause: The clause.
        at: Index of an `L` or `S`.
        turn: Whether it would else be read as a turn.
    """
    chunk = clause.chunks[at]
    before = clause.chunks[at - 1] if at else None
    if chunk.kind == "L":
        if before is not None and before.kind == "B" and _EXISTS.match(before.text):
            return True
    elif towards_a_side(chunk):
        if before is not None and _STARTS.match(before.text):
            return True
        if clause.kinds == "S" and not turn:
            return True
    return turn and is_of_a_sign(clause, at)


def speaks_of_ways(clause: Clause) -> bool:
    """`Right takes you to the labs`: the direction is what the clause is about."""
    if re.match("[LS][GKT]", clause.kinds) is None:
        return False
    return re.match(r"goes|lead|bring|takes", clause.chunks[1].text) is not None


def comes_before_its_thing(clause: Clause, at: int) -> bool:
    """`On the left is the bench`: the side is said before its thing."""
    follows = re.match("[BVZ]?n?O?N", clause.kinds[at + 1 :]) is not None
    return follows and "N" not in clause.kinds[:at]
