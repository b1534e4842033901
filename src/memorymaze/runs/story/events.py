"""The entries of a trace in words, in the order of time."""

import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeGuard

from memorymaze.agents.notes import (
    BeliefNote,
    ModelReplyNote,
    PlanNote,
    ProgramNote,
    StepsNote,
)
from memorymaze.basics.geometry.pose import Pose, moved
from memorymaze.basics.wording import printable
from memorymaze.robot.api.control import Detection, MoveResult, SignText, TurnResult
from memorymaze.runs.episodes.trace_entries import (
    AnswerEntry,
    CallEntry,
    CollisionEntry,
    NearMissEntry,
    NoteEntry,
    TraceEntry,
)

KINDS = (
    "move",
    "turn",
    "look",
    "ask",
    "say",
    "stop",
    "note",
    "model",
    "touch",
    "other",
)
"""Of events; each has a lane of its own in a timeline, or shares one."""

LONGEST = 600
"""Characters that are shown of a text; traces hold them whole."""

ASKING = frozenset({
    "turning_point_id",
    "detect_turning_point",
    "distance_travelled",
    "detect_from_RGB_image",
    "read_signs",
})
"""Calls that move nothing; those at the same moment are told in one line."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened, in words."""

    time: float
    """Simulated seconds."""
    kind: str
    """One of `KINDS`."""
    text: str
    last: int
    """Number of the last entry of the trace that it tells of."""
    seen: tuple[tuple[float, float, str], ...] = ()
    """Things detected: x and y in metres, label."""


def events_of(entries: Sequence[TraceEntry]) -> Iterator[Event]:
    """Tell the entries of a trace, or of a piece of one."""
    asked: list[CallEntry] = []
    for number, entry in enumerate(entries):
        now = entry.time if _asks(entry) else None
        if asked and now != asked[0].time:
            yield from _asked_events(asked, number)
            asked = []
        match entry:
            case CallEntry() if _asks(entry):
                asked.append(entry)
            case CallEntry():
                yield _call_event(entry, number)
            case NoteEntry():
                yield from _note_events(entry, number)
            case AnswerEntry():
                yield _answered_event(entry, number)
            case CollisionEntry():
                text = f"touched a {entry.with_} ({entry.object_id})"
                yield Event(entry.time, "touch", _cut(text), number)
            case NearMissEntry():
                text = f"came within {entry.gap:.2f} m of {entry.object_id}"
                yield Event(entry.time, "touch", _cut(text), number)
            case _:
                pass
    if asked:
        yield from _asked_events(asked, len(entries))


def _asks(entry: TraceEntry) -> TypeGuard[CallEntry]:
    return isinstance(entry, CallEntry) and entry.call in ASKING


def news(events: Iterable[Event], told: dict[str, str] | None = None) -> list[Event]:
    """Return events in the order of time, without answers that are as before.

    Agents ask the same at every step; what stays the same is told once. `told` holds
    the last text told of each kind, and is brought up to date.
    """
    told = {} if told is None else told
    kept: list[Event] = []
    for event in sorted(events, key=lambda each: each.time):
        if event.kind in {"ask", "look"} and told.get(event.kind) == event.text:
            continue
        told[event.kind] = event.text
        kept.append(event)
    return kept


def _asked_events(asked: Sequence[CallEntry], after: int) -> Iterator[Event]:
    """Tell the questions asked at one moment: what was looked for, what else."""
    looked: list[str] = []
    found: list[str] = []
    seen: list[tuple[float, float, str]] = []
    others: list[str] = []
    for entry in asked:
        if entry.call == "detect_from_RGB_image":
            looked.append(str(entry.arguments.get("object")))
            pose = Pose(*entry.pose)
            for each in entry.found(Detection):
                found.append(f"{each.label} {_where(each)}")
                seen.append((*place_of_note(each, pose), _cut(each.label)))
        elif entry.call == "read_signs":
            found += [f"“{each.text}” {_where(each)}" for each in entry.found(SignText)]
            looked.append("signs")
        else:
            others.append(f"{entry.call}() → {_value(entry.result)}")
    time = asked[0].time
    if looked:
        # What is found is told once, however often it was looked for.
        what = ", ".join(dict.fromkeys(looked))
        told = "; ".join(dict.fromkeys(found)) or "nothing"
        places = tuple(dict.fromkeys(seen))
        yield Event(
            time, "look", _cut(f"saw {told} (looked for {what})"), after - 1, places
        )
    if others:
        told = "; ".join(dict.fromkeys(others))
        yield Event(time, "ask", _cut(told), after - 1)


def _call_event(entry: CallEntry, number: int) -> Event:
    """Tell a call of the control API."""
    call, result = entry.call, entry.result
    arguments = ", ".join(_value(each) for each in entry.arguments.values())
    text = f"{call}({arguments})"
    kind = "other"
    if call == "ask":
        answer = "nobody near" if result is None else f"“{result}”"
        text = f"“{arguments}” → {answer}"
        return Event(entry.time, "say", _cut(text), number)
    if call in {"move_forward", "follow"} or call.startswith("step_"):
        kind = "move"
    elif call in {"turn", "turn_by"}:
        kind = "turn"
    elif call in {"say", "stop"}:
        kind = call
    match result:
        case MoveResult(distance, reason):
            text += f" → {distance:.2f} m, {reason}"
        case TurnResult(message=message):
            text += f" → {message}"
        case None:
            pass
        case _:
            text += f" → {_value(result)}"
    return Event(entry.time, kind, _cut(text), number)


def _note_events(entry: NoteEntry, number: int) -> Iterator[Event]:
    """Tell what an agent noted; nothing of what is shown elsewhere."""
    told, kind = entry.details, "note"
    match entry.note:
        case PlanNote() | StepsNote() | ProgramNote() | BeliefNote():
            return
        case ModelReplyNote() as reply:
            kind = "model"
            text = f"{reply.model} replied ({reply.stage}): {reply.text}"
        case _ if list(told) == ["text"]:
            text = f"{entry.about}: {told['text']}"
        case _:
            parts = (f"{name} {_value(value)}" for name, value in told.items())
            text = f"{entry.about}: {'; '.join(parts)}"
    yield Event(entry.time, kind, _cut(text), number)


def _answered_event(entry: AnswerEntry, number: int) -> Event:
    """Tell what was true of a passer-by's answer, which the agent does not learn."""
    told = {
        "right": "is right",
        "wrong": "is WRONG",
        "unknown": "tells nothing",
    }
    error = f": {entry.error}" if entry.error else ""
    text = f"the answer of {entry.person} {told[entry.truth]}{error}"
    if entry.model is not None:
        text += f" (in the words of a language model, {entry.model}; not checked)"
    return Event(entry.time + entry.seconds, "other", _cut(text), number)


def place_of_note(found: Detection, pose: Pose) -> tuple[float, float]:
    """Return where a thing is, metres, that was detected from a place."""
    angle = pose.heading + math.radians(found.bearing_deg)
    return moved((pose.x, pose.y), angle, found.distance)


def _where(found: Detection | SignText) -> str:
    bearing = round(found.bearing_deg)
    side = (
        f"{abs(bearing)}° {'left' if bearing > 0 else 'right'}" if bearing else "ahead"
    )
    return f"{found.distance:.1f} m {side}"


def _value(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.2f}"
    if value is None:
        return "nothing"
    if isinstance(value, str):
        return value
    if isinstance(value, list) and all(isinstance(each, str) for each in value):
        return ", ".join(value) or "nothing"
    return json.dumps(value, ensure_ascii=False)


def _cut(text: str) -> str:
    text = printable(text)
    if len(text) <= LONGEST:
        return text
    return f"{text[:LONGEST]}… ({len(text)} characters; the trace has them all)"
