"""A model that decides by the belief, and knows nothing but a plan and the log."""

import json
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import pytest

from memorymaze.agents.agent import Journal
from memorymaze.agents.closed_loop.walk_log import DOOR, way_name
from memorymaze.agents.guide.arriving import Ending
from memorymaze.agents.guide.choosing import _Step
from memorymaze.agents.guide.search import Search
from memorymaze.agents.walking.floor_map import Crossing, FloorMap, Sighting, Stretch
from memorymaze.basics.geometry.pose import wrap_angle
from memorymaze.language.models.model import CompletionRequest
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.language.plans import RoutePlan

_HERE = re.compile(r"The robot is at place (-?\d+) after (\d+) m\.")
_PLACE = re.compile(r"^Place (-?\d+) \([^)]*\): (.*)\.$", re.MULTILINE)
_WAY = re.compile(
    r"([A-Z]) ((?:slight |sharp )?(?:left|right)|ahead|back)(?: ([+-]\d+)°)?, "
    r"(?:not tried|(no way through)|leads to place (-?\d+), (\d+) m)(?:: (.*))?$"
)
_THINGS = re.compile(r"(?:^|, )(.+?) (\d+(?:, \d+)*) m(?=, |$)")
_DEGREES = {"slight": 40, "": 90, "sharp": 140}
_BESIDE = {"left": 1.5, "right": -1.5, "ahead": 0.0}
WITHIN_REACH = 4.0
"""Metres from which on it says to stop at a thing."""


@dataclass(frozen=True)
class Way:
    """A way out as the log tells it."""

    exit: int
    angle: float
    is_closed: bool
    end: int | None
    metres: float
    seen: str


def _angle(words: str, degrees: str | None) -> float:
    if degrees:
        return math.radians(float(degrees))
    *how, side = words.split()
    if side in {"ahead", "back"}:
        return 0.0 if side == "ahead" else math.pi
    sign = 1 if side == "left" else -1
    return math.radians(sign * _DEGREES["".join(how)])


def _ways(line: str) -> Iterator[Way]:
    for part in line.split("; "):
        told = _WAY.match(part)
        assert told, part
        letter, words, degrees, closed, end, metres, seen = told.groups()
        yield Way(
            ord(letter) - ord("A"),
            _angle(words, degrees),
            closed is not None,
            int(end) if end else None,
            float(metres or 0),
            seen or "",
        )


class ReadLog:
    """The sketch map that a log tells of."""

    def __init__(self, request: CompletionRequest) -> None:
        text = request.messages[1].content
        self.at, self.walked = map(int, _HERE.findall(text)[-1])
        places = text.partition("Places, each")[2].partition("Your answers")[0]
        # What was read may have any marks in it; what fits is told with some.
        places = re.sub(r'"[^"\n]*"', '"text"', places)
        places = re.sub(r"\[.*?\]", lambda fit: fit[0].replace("; ", "/"), places)
        self.ways = {
            int(number): sorted(_ways(line), key=lambda way: way.exit)
            for number, line in _PLACE.findall(places)
        }
        self.start = next(iter(self.ways))
        self.floor = FloorMap()
        self._place_all()

    def _place_all(self) -> None:
        headings, todo = {self.start: 0.0}, [(self.start, (0.0, 0.0))]
        while todo:
            number, (x, y) = todo.pop(0)
            exits = [wrap_angle(headings[number] + w.angle) for w in self.ways[number]]
            closed = {way.exit for way in self.ways[number] if way.is_closed}
            self.floor.crossings[number] = Crossing(number, (x, y), exits, closed)
            for way in self.ways[number]:
                if way.end is None or way.end in headings:
                    continue
                heading = exits[way.exit]
                back = next(w for w in self.ways[way.end] if w.end == number)
                headings[way.end] = wrap_angle(heading + math.pi - back.angle)
                along = way.metres * math.cos(heading), way.metres * math.sin(heading)
                todo.append((way.end, (x + along[0], y + along[1])))

    def draw(self, asked: dict[tuple[int, int], tuple[str, ...]]) -> FloorMap:
        """Return the map, where along some ways things were asked for."""
        tracks = iter(range(1_000_000))
        for number, crossing in self.floor.crossings.items():
            for way in self.ways.get(number, ()):
                key = number, way.exit
                if way.end is not None:
                    self.floor.stretches[key] = Stretch(
                        *key,
                        way.end,
                        crossing.exits[way.exit],
                        way.metres,
                        frozenset(asked.get(key, ())),
                    )
                for sighting in _sightings(crossing, way, tracks):
                    self.floor.note(sighting)
        return self.floor


def _sightings(
    crossing: Crossing, way: Way, tracks: Iterator[int]
) -> Iterator[Sighting]:
    x, y = crossing.place
    cos, sin = math.cos(crossing.exits[way.exit]), math.sin(crossing.exits[way.exit])
    for part in filter(None, way.seen.split(" | ")):
        side, _, things = part.partition(" ")
        off = _BESIDE[side]
        for words, metres in _THINGS.findall(things):
            label, _, fits = words.rstrip("]").partition(" [")
            if label.startswith('"'):
                continue
            for along in map(int, metres.split(", ")):
                there = (x + along * cos - off * sin, y + along * sin + off * cos)
                before = max(along - 1, 0)
                seen_from = (x + before * cos, y + before * sin)
                track = next(tracks)
                for fit in [*filter(None, fits.split("/")), label]:
                    phrase, _, score = fit.partition("? ")
                    yield Sighting(
                        phrase,
                        label,
                        float(score or 1),
                        there,
                        seen_from,
                        1.5,
                        track,
                        (crossing.number, way.exit),
                        side,
                    )


class Believes:
    """Answers with what the belief would do that has seen what the log tells."""

    def __init__(self, plan: RoutePlan) -> None:
        self._plan = plan
        self._asked: dict[tuple[int, int], tuple[str, ...]] = {}
        self._ending: Ending | None = None
        self._named = False

    def __call__(self, request: CompletionRequest) -> str:
        if self._ending is not None:
            return self._stop(self._ending)
        log = ReadLog(request)
        walker = SimpleNamespace(
            map=log.draw(self._asked),
            at=log.start,
            travelled=float(log.walked),
            heading=0.0,
            say=lambda words: None,
            survey=lambda phrases: None,
        )
        search = Search([self._plan], [0], walker, Journal())  # type: ignore[arg-type]
        search._begin()
        walker.at = log.at
        search._update()
        step = search._choice.best()
        return self._do(step, search, log.at)

    def _do(self, step: _Step | None, search: Search, at: int) -> str:
        if step is None:
            return _say("give_up")
        if not isinstance(step, Ending):
            phrases = [each for each in search._phrases(step) if len(each) <= 80]
            self._asked[step.at, step.exit] = (DOOR, *phrases[:12])
            way = way_name(step.exit)
            return _say("walk", place=step.at, way=way, look_for=phrases[:12])
        self._ending = step
        rest = step.distance - (WITHIN_REACH if step.sighting else 0.0)
        if step.exit is not None and rest > 0:
            way = way_name(step.exit)
            return _say("walk", place=step.at, way=way, metres=rest)
        return self._stop(step) if step.at == at else _say("go_back", place=step.at)

    def _stop(self, ending: Ending) -> str:
        if ending.sighting is None or self._named:
            return _say("stop")
        self._named = True
        return _say("stop", at=ending.sighting.phrase)


def _say(action: str, **fields: Any) -> str:
    said = {"note": "By the belief.", "turns_done": 0, "doubt": 0.1, "confidence": 0.5}
    return json.dumps({**said, "action": action, **fields})


@pytest.fixture
def believes() -> Callable[[RoutePlan], ScriptedLanguageModel]:
    """Make a model that decides by the belief in a plan."""
    return lambda plan: ScriptedLanguageModel(Believes(plan), name="stand-in")
