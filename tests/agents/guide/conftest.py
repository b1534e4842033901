"""A model that walks by a plan and reads nothing but the log that it is shown."""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import pytest

from memorymaze.language.model import CompletionRequest
from memorymaze.language.scripted_model import ScriptedLanguageModel
from memorymaze.routes import Leg, RoutePlan

_HERE = re.compile(r"The robot is at place (-?\d+) after (\d+) m\.")
_WAY = re.compile(
    r"(?:: |; )([A-Z]) ((?:slight |sharp )?(?:left|right)|ahead|back)(?: [+-]\d+°)?, "
    r"(?:not tried|leads to place)"
)
_NOTE = re.compile(r"leg (\d+) since (\d+) m")
_DEGREES = {"slight": 40, "sharp": 140}
ENOUGH, OVER = 0.7, 4.0
"""Share of a told length, less some metres, from which on a turn may come."""


@dataclass(frozen=True)
class Shown:
    """What a log says of where the robot is."""

    place: int
    walked: int
    ways: Mapping[str, int]
    """Degrees to the left, by letters."""
    leg: int
    since: int
    """Metres walked when the leg began."""


def read_log(request: CompletionRequest) -> Shown:
    """Read the log as it is shown, and the own note in it."""
    text = request.messages[1].content
    place, walked = map(int, _HERE.findall(text)[-1])
    [line] = re.findall(rf"^Place {place} \(.*$", text, re.MULTILINE)
    ways = {letter: _degrees(words) for letter, words in _WAY.findall(line)}
    leg, since = map(int, [("0", "0"), *_NOTE.findall(text)][-1])
    return Shown(place, walked, ways, leg, since)


def _degrees(words: str) -> int:
    *how, side = words.split()
    if side in {"ahead", "back"}:
        return 0 if side == "ahead" else 180
    return (1 if side == "left" else -1) * _DEGREES.get("".join(how), 90)


class FollowsPlan:
    """Turns at the first way to the side told, about as far on as told; then stops."""

    def __init__(self, plan: RoutePlan) -> None:
        self._plan = plan
        names = [each.removeprefix("the ") for each in plan.arrival.destinations]
        self._name = names[0] if names else None

    def __call__(self, request: CompletionRequest) -> str:
        shown = read_log(request)
        on = {way: angle for way, angle in shown.ways.items() if abs(angle) < 180}
        legs = self._plan.legs
        if shown.leg >= len(legs):
            return self._arrive(shown, on)
        turn = self._turn_of(legs[shown.leg], shown, on)
        if turn is not None:
            more = {} if shown.leg + 1 < len(legs) else self._last_stretch(0)
            return self._say(shown.leg + 1, shown.walked, way=turn, **more)
        if not on:
            return self._say(shown.leg, shown.since, action="give_up", confidence=0.1)
        ahead = min(on, key=lambda way: abs(on[way]))
        return self._say(shown.leg, shown.since, way=ahead)

    def _turn_of(self, leg: Leg, shown: Shown, on: Mapping[str, int]) -> str | None:
        walked = shown.walked - shown.since
        if leg.length is not None and walked < ENOUGH * leg.length.metres - OVER:
            return None
        if leg.turn.forced and len(on) > 1:
            return None
        wanted = 45 if leg.turn.way.startswith("slight") else 90
        wanted *= -1 if leg.turn.way.endswith("right") else 1
        near = [way for way, angle in on.items() if abs(angle - wanted) <= 60 and angle]
        return min(near, key=lambda way: abs(on[way] - wanted), default=None)

    def _last_stretch(self, walked: float) -> dict[str, Any]:
        length = self._plan.arrival.length
        more: dict[str, Any] = {"until": self._name} if self._name else {}
        if length is not None:
            more["metres"] = max(length.metres + 1 - walked, 1)
        return more

    def _arrive(self, shown: Shown, on: Mapping[str, int]) -> str:
        length = self._plan.arrival.length
        walked = shown.walked - shown.since
        there = walked >= length.metres - 2 if length else shown.place < 0
        if there or not on:
            return self._say(shown.leg, shown.since, action="stop")
        ahead = min(on, key=lambda way: abs(on[way]))
        more = self._last_stretch(walked)
        if shown.place < 0:
            # It was a sign that points on, by the length told.
            more.pop("until", None)
        return self._say(shown.leg, shown.since, way=ahead, **more)

    def _say(self, leg: int, since: int, **fields: Any) -> str:
        said = {
            "note": f"leg {leg} since {since} m",
            "turns_done": leg,
            "doubt": 0.1,
            "confidence": 0.9,
            "action": "walk",
            **fields,
        }
        if leg >= len(self._plan.legs) - 1 and self._name:
            said["look_for"] = [self._name]
        return json.dumps(said)


@pytest.fixture
def follows_plan() -> Callable[[RoutePlan], ScriptedLanguageModel]:
    """Make a model that walks by a plan."""
    return lambda plan: ScriptedLanguageModel(FollowsPlan(plan), name="stand-in")
