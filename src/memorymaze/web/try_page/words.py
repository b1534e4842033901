"""What a robot understood, believes and did, in words for somebody who is new to it."""

from collections.abc import Sequence
from typing import NamedTuple

from memorymaze.agents.notes import ArrivalNote, BeliefNote, GaveUpNote, RepairNote
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.trace_entries import CallEntry, NoteEntry, TraceEntry
from memorymaze.runs.story.following import (
    Following,
    count_decisions,
    decisions_of,
    followed_along,
)
from memorymaze.world.sites import Route, Site

REPAIRS = {
    "wrong start": "one may have to begin the other way",
    "wrong side": "turn {leg} may go to the other side",
    "no such turn": "there may be no turn {leg}",
    "turn left out": "a turn may be missing before turn {leg}",
    "lost": "the way may have been told wrongly",
}
"""By the reason of a note about a repair."""
FOLLOWERS = {
    "guide": "The robot you watch (guide)",
    "explorer": "One that searches everywhere (explorer)",
}
"""Agents in words, by their names."""
ENDINGS = {
    "budget": "The time for the walk ran out.",
    "stuck": "It got stuck.",
    "crash": "The program failed.",
    "unsafe": "Its program was refused.",
    "model_error": "The language model gave no usable answer.",
}
"""By `EpisodeResult.stopped_by`, where it did not stop by itself."""


DOUBTS = 0.5
"""How probable an error in what was told must be to be spoken of."""


class Thought(NamedTuple):
    """Something a robot said, or thought by itself."""

    kind: str
    """`says` or `thinks`."""
    text: str


def thought_of(entry: TraceEntry) -> Thought | None:
    """Return what an entry of a trace tells a listener; None where it tells nothing."""
    if isinstance(entry, CallEntry):
        said = entry.arguments
        if entry.call == "say":
            return Thought("says", str(said.get("text")))
        if entry.call == "ask" and entry.result is not None:
            return Thought("says", f"{said.get('question')} The answer: {entry.result}")
        return None
    match entry.note if isinstance(entry, NoteEntry) else None:
        case RepairNote(leg=leg, reason=reason):
            told = REPAIRS.get(reason, "something else may be meant")
            return Thought("thinks", f"Goes back: {told.format(leg=leg)}.")
        case ArrivalNote(confidence=confidence):
            return Thought("says", f"We are there.{_sure(confidence)}")
        case GaveUpNote(reason=reason, confidence=confidence):
            return Thought("thinks", f"Gives up: {reason}.{_sure(confidence)}")
        case _:
            return None


def belief_words(belief: BeliefNote) -> str:
    """Say where in the description a robot believes to be."""
    most, steps = belief.likeliest, belief.legs
    return f"Probably at step {most + 1} of {len(steps)} ({steps[most]:.0%})"


def change_of_mind(
    before: BeliefNote | None, now: BeliefNote, steps: Sequence[str]
) -> Thought | None:
    """Say what a robot newly believes; None where it is the same step as before."""
    if before is not None and before.doubt < DOUBTS <= now.doubt:
        return Thought("thinks", "Something it was told may be wrong.")
    if before is not None and before.likeliest == now.likeliest:
        return None
    if now.likeliest >= len(steps):
        return None
    step = f"Now comes step {now.likeliest + 1}: {steps[now.likeliest]}."
    return Thought("thinks", step)


class Verdict(NamedTuple):
    """How a walk ended."""

    arrived: bool
    headline: str
    sentences: list[str]
    lost: tuple[float, float] | None
    """Where it left the way that was shown, metres; None where it did not."""


def verdict_of(
    result: EpisodeResult, walk: Trajectory, site: Site, route: Route, near: float
) -> Verdict:
    """Judge a walk: whether it arrived, how sure it was, where it lost the way."""
    headline = "The robot arrived." if result.success else "The robot did not arrive."
    sentences = [
        f"It walked {result.path_length:.0f} m in {result.duration_s:.0f} s and ended "
        f"{result.spd:.1f} m on foot from {route.goal}."
    ]
    if result.stopped_by != "agent":
        sentences.append(ENDINGS[result.stopped_by])
    if result.confidence is not None:
        what = "gave up" if result.gave_up else "said that it was there"
        sentences.append(f"It {what}, {result.confidence:.0%} sure to be there.")
    following = followed_along(list(route.line.coords), walk.points, near)
    sentences.append(_followed(following, site, route, arrived=result.success))
    if not result.success and result.oracle_success:
        sentences.append("On its way it had been at the goal without noticing.")
    lost = following.place if following.how in {"left", "turned_back"} else None
    return Verdict(result.success, headline, sentences, lost)


def _followed(following: Following, site: Site, route: Route, *, arrived: bool) -> str:
    """Say how far it followed the way that was shown."""
    along = f"{following.along:.0f} m from the start"
    if following.how == "end":
        return "It followed the way on the plan to its end."
    if following.how == "passed":
        return "It followed the way on the plan, and then went past its end."
    if following.how == "stopped":
        return f"It followed the way on the plan and stopped too early, {along}."
    wrong = [
        each
        for each in count_decisions(decisions_of(site, route), route, [following])
        if each.wrong
    ]
    did = f"It left the way on the plan {along}"
    if following.how == "turned_back":
        did = f"It turned back {along}"
    elif wrong:
        instead = wrong[0].instead[0][0]
        did += f", where one would {wrong[0].decision.way}; it {instead}"
    return f"{did}{', and arrived all the same' if arrived else ''}."


def _sure(confidence: float | None) -> str:
    return "" if confidence is None else f" ({confidence:.0%} sure)"
