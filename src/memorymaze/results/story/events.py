"""The entries of a trace in words, in the order of time."""

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from memorymaze.wording import printable

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

HIDDEN_NOTES = frozenset({"plan", "steps", "program", "belief"})
"""Shown beside the timeline instead."""


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


def events_of(entries: Sequence[Mapping[str, Any]]) -> Iterator[Event]:
    """Tell the entries of a trace, or of a piece of one."""
    asked: list[Mapping[str, Any]] = []
    for number, entry in enumerate(entries):
        kind = entry["kind"]
        asks = kind == "call" and entry.get("call") in ASKING
        if asked and not (asks and entry["time"] == asked[0]["time"]):
            yield from _asked_events(asked, number)
            asked = []
        if asks:
            asked.append(entry)
        elif kind == "call":
            yield _call_event(entry, number)
        elif kind == "note":
            yield from _note_events(entry, number)
        elif kind == "passer_by":
            yield _answered_event(entry, number)
        elif kind in {"collision", "near_miss"}:
            yield _met_event(entry, number)
    if asked:
        yield from _asked_events(asked, len(entries))


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


def _asked_events(asked: Sequence[Mapping[str, Any]], after: int) -> Iterator[Event]:
    """Tell the questions asked at one moment: what was looked for, what else."""
    looked, found, seen, others = [], [], [], []
    for entry in asked:
        result = entry["result"]
        if entry["call"] == "detect_from_RGB_image":
            looked.append(str(entry["arguments"].get("object")))
            found += [f"{each['label']} {_where(each)}" for each in result or ()]
            seen += [_place(entry["pose"], each) for each in result or ()]
        elif entry["call"] == "read_signs":
            found += [f"“{each['text']}” {_where(each)}" for each in result or ()]
            looked.append("signs")
        else:
            others.append(f"{entry['call']}() → {_value(result)}")
    time = float(asked[0]["time"])
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


def _call_event(entry: Mapping[str, Any], number: int) -> Event:
    """Tell a call of the control API."""
    call, result = str(entry["call"]), entry["result"]
    arguments = ", ".join(_value(each) for each in entry["arguments"].values())
    text = f"{call}({arguments})"
    kind = "other"
    if call == "ask":
        answer = "nobody near" if result is None else f"“{result}”"
        text = f"“{arguments}” → {answer}"
        return Event(float(entry["time"]), "say", _cut(text), number)
    if call in {"move_forward", "follow"} or call.startswith("step_"):
        kind = "move"
    elif call in {"turn", "turn_by"}:
        kind = "turn"
    elif call in {"say", "stop"}:
        kind = call
    if isinstance(result, dict) and {"distance", "reason"} <= result.keys():
        text += f" → {float(result['distance']):.2f} m, {result['reason']}"
    elif isinstance(result, dict) and "message" in result:
        text += f" → {result['message']}"
    elif result is not None:
        text += f" → {_value(result)}"
    return Event(float(entry["time"]), kind, _cut(text), number)


def _note_events(entry: Mapping[str, Any], number: int) -> Iterator[Event]:
    """Tell what an agent noted; nothing of what is shown elsewhere."""
    about = str(entry["about"])
    if about in HIDDEN_NOTES:
        return
    told = {k: v for k, v in entry.items() if k not in {"kind", "time", "about"}}
    kind = "note"
    if about == "model_reply":
        kind = "model"
        stage, text = told.get("stage"), told.get("text")
        text = f"{told.get('model')} replied ({stage}): {text}"
    elif list(told) == ["text"]:
        text = f"{about}: {told['text']}"
    else:
        text = f"{about}: " + "; ".join(f"{k} {_value(v)}" for k, v in told.items())
    yield Event(float(entry["time"]), kind, _cut(text), number)


def _answered_event(entry: Mapping[str, Any], number: int) -> Event:
    """Tell what was true of a passer-by's answer, which the agent does not learn."""
    told = {
        "right": "is right",
        "wrong": "is WRONG",
        "unknown": "tells nothing",
    }
    error = f": {entry['error']}" if entry["error"] else ""
    text = f"the answer of {entry['person']} {told[entry['truth']]}{error}"
    if entry.get("model") is not None:
        text += f" (in the words of a language model, {entry['model']}; not checked)"
    ended = float(entry["time"]) + float(entry["seconds"])
    return Event(ended, "other", _cut(text), number)


def _met_event(entry: Mapping[str, Any], number: int) -> Event:
    """Tell a collision, or that a person came close."""
    if entry["kind"] == "collision":
        text = f"touched a {entry['with']} ({entry['object_id']})"
    else:
        text = f"came within {float(entry['gap']):.2f} m of {entry['object_id']}"
    return Event(float(entry["time"]), "touch", _cut(text), number)


def _where(found: Mapping[str, Any]) -> str:
    bearing = round(float(found["bearing_deg"]))
    side = (
        f"{abs(bearing)}° {'left' if bearing > 0 else 'right'}" if bearing else "ahead"
    )
    return f"{float(found['distance']):.1f} m {side}"


def _place(pose: Sequence[float], found: Mapping[str, Any]) -> tuple[float, float, str]:
    x, y, heading = map(float, pose)
    angle = heading + math.radians(float(found["bearing_deg"]))
    distance = float(found["distance"])
    label = _cut(str(found["label"]))
    return x + distance * math.cos(angle), y + distance * math.sin(angle), label


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
