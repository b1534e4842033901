"""Bring the steps of a right plan and of the same plan with errors into one order."""

from collections.abc import Mapping, Sequence

from memorymaze.writing.clauses import Focus
from memorymaze.writing.steps import Mistake, StepPlan

MERGED_WITHIN = 8.0
"""Metres between two turns that can be told as one."""


def error_label(number: int) -> str:
    """Return the label of the n-th error of a text."""
    return f"error|{number}"


def focus_of(mistakes: Sequence[Mistake]) -> dict[str, dict[str, str]]:
    """Return which part of which step gets which label."""
    focus: dict[str, dict[str, str]] = {}
    for number, mistake in enumerate(mistakes):
        part = "step" if mistake.part == "gone" else mistake.part
        focus.setdefault(mistake.key, {})[part] = error_label(number)
    return focus


def keys_in_order(
    plan: StepPlan, right: StepPlan, mistakes: Sequence[Mistake]
) -> list[str]:
    """Return the turns of a plan, and those that only its counterpart has.

    Args:
        plan: What is told: the right plan, or the one with errors.
        right: The right plan.
        mistakes: The errors between the two.
    """
    keys = [turn.key for turn in plan.turns]
    whole = [turn.key for turn in right.turns]
    for mistake in mistakes:
        wrong = [turn.key for turn in mistake.plan.turns]
        other = whole if mistake.part == "gone" else wrong
        if mistake.key in keys or mistake.key not in other:
            continue
        earlier = [key for key in other[: other.index(mistake.key)] if key in keys]
        keys.insert(keys.index(earlier[-1]) + 1 if earlier else 0, mistake.key)
    return keys


def in_one_breath(
    plan: StepPlan, right: StepPlan, key: str, focus: Mapping[str, Focus]
) -> bool:
    """Tell whether a turn can be told together with the one before it.

    They follow each other in both plans within a few metres, and none of the two needs
    words of its own for where it is or for an error.
    """
    keys = [turn.key for turn in plan.turns]
    whole = [turn.key for turn in right.turns]
    if key not in keys or key not in whole or not keys.index(key):
        return False
    place, number = whole.index(key), keys.index(key)
    before, turn = plan.turns[number - 1], plan.turns[number]
    if not place or whole[place - 1] != before.key:
        return False
    labelled = {*focus.get(key, {}), *focus.get(before.key, {})}
    if labelled & {"cue", "step"}:
        return False
    near = right.turns[place].leg.length < MERGED_WITHIN and turn.told and before.told
    return near and turn.cue.kind != "thing" and turn.cue.ordinal == 1
