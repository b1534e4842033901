"""Plans as numbered lines that a language model can read."""

from collections.abc import Sequence

from memorymaze.instructions.error_kinds import meaning_of
from memorymaze.writing.phrases import ORDINALS
from memorymaze.writing.steps import Cue, Leg, Mistake, StepPlan, Turn
from memorymaze.writing.things import with_article

THINGS = 4
"""Things named per stretch."""


def listed_steps(plan: StepPlan) -> str:
    """Return the steps of a plan, one per line."""
    lines: list[str] = []
    if plan.around:
        lines.append("first turn around and go back the other way")
    for turn in plan.turns:
        lines.append(_turn(turn))
    arrival = plan.arrival
    where = "straight ahead" if arrival.side is None else f"on the {arrival.side}"
    at = "" if arrival.claimed is None else f", at {arrival.claimed}"
    lines.append(f"{_leg(arrival.leg)}; {arrival.goal} is {where}{at}")
    return "\n".join(f"{number}. {line}" for number, line in enumerate(lines, 1))


def listed_errors(mistakes: Sequence[Mistake]) -> str:
    """Return the errors to put in, one per line."""
    if not mistakes:
        return "none: write only the right text"
    return "\n".join(
        f"{number}. {mistake.kind} ({meaning_of(mistake.kind)}): {mistake.detail}"
        for number, mistake in enumerate(mistakes, 1)
    )


def _turn(turn: Turn) -> str:
    side = turn.side.replace("_", " ")
    if not turn.told:
        return (
            f"{_leg(turn.leg)}; the way bends {side} by itself: do not tell this turn"
        )
    return f"{_leg(turn.leg)}; turn {side} {_cue(turn.cue)}"


def _cue(cue: Cue) -> str:
    if cue.kind == "ordinal":
        return f"at the {ORDINALS[cue.ordinal - 1]} way on that side"
    if cue.kind == "thing":
        return f"at {cue.words if cue.proper else 'the ' + cue.words}"
    if cue.kind == "end":
        return "where the way ahead ends"
    return "at the corner, which leaves no other way"


def _leg(leg: Leg) -> str:
    if leg.length == 0:
        return "go on"
    things = [
        f"{with_article(each.thing, definite=False)} ({each.side})"
        for each in leg.passing[:THINGS]
    ]
    past = f", past {', '.join(things)}" if things else ""
    return f"go {leg.length:.0f} m{past}"
