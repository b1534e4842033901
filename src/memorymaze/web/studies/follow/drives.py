"""Robots that participants drive: each command is on the disk before the robot moves.

A walk is its commands in the store. The process with the robot may end at any time, as
when a browser vanishes: another one repeats the commands and goes on from there.
"""

import json
import threading
import time
from base64 import b64encode
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from memorymaze.basics.errors import StudyError
from memorymaze.basics.processes import start_server
from memorymaze.texts.corpus.records import Episode
from memorymaze.web.serving.live_process import LiveProcess, ProcessLost
from memorymaze.web.studies.follow.texts import TextsToFollow
from memorymaze.web.studies.follow.walk import (
    COMMANDS,
    Ended,
    RobotToDrive,
    Said,
    SeenOnWalk,
)
from memorymaze.web.studies.schedule import StudyStep, steps_of
from memorymaze.web.studies.store import Participant, SentAnswer, Store, Taken

MOST = 6
"""Robots at a time; each takes some 500 MB."""
STILL_THERE = 15.0
"""Seconds after a command for which a robot is not taken away for another participant."""
IDLE = 300.0
"""Seconds without a command after which a robot is put away."""
LONGEST_WAIT = 60.0
"""Seconds for a robot to be set up, or to do a command."""
TEXT, DRIVE = "text.", "drive."
"""Beginnings of events: which text is followed, and a command."""


class NoRobotNow(StudyError):
    """All robots are being driven, or one is too slow; the same may be asked again."""


class WalkElsewhere(StudyError):
    """The walk has gone on in another window."""


class Walked(NamedTuple):
    """A finished walk."""

    text: str
    """Id of the text followed."""
    told: str
    """The text itself, as it was shown."""
    commands: tuple[str, ...]
    said: Said | None
    """None where the robot's budget ended it."""
    place: tuple[float, float] | None
    """Where the robot stood at the end; None where nobody saw it."""
    seconds: float
    """From the first look at the page to the end."""
    at: float


@dataclass(eq=False)
class _Live:
    """A process, and what it said last."""

    process: LiveProcess | None = None
    seen: SeenOnWalk | None = None
    ended: bool = False
    lost: str = ""
    used: float = 0.0
    changed: threading.Condition = field(default_factory=threading.Condition)

    def hear(self, message: object) -> None:
        """Take what the process says, in its own thread."""
        with self.changed:
            if isinstance(message, SeenOnWalk):
                self.seen = message
            elif isinstance(message, Ended):
                self.ended = True
            elif isinstance(message, ProcessLost):
                self.lost = self.lost or str(message)
            self.changed.notify_all()

    def wait(self, done: int) -> SeenOnWalk | None:
        """Return what is seen after some commands; None where the walk is over."""
        with self.changed:
            self.changed.wait_for(lambda: self._has(done), LONGEST_WAIT)
            if self.ended:
                return None
            if self.seen is None or self.seen.done < done:
                raise NoRobotNow(self.lost or "The robot is too slow just now.")
            return self.seen

    def _has(self, done: int) -> bool:
        seen = self.seen is not None and self.seen.done >= done
        return seen or self.ended or bool(self.lost)


class Drives:
    """The walks of a study; use it in a `with`, which puts all robots away at its end."""

    def __init__(
        self,
        store: Store,
        texts: TextsToFollow,
        *,
        most: int = MOST,
        draws: bool = True,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Drive for the participants of a store; without pictures where nobody looks."""
        self._store, self._texts, self._site = store, texts, store.study.site
        self._most, self._draws, self._clock = most, draws, clock
        self._lives: dict[tuple[str, str], _Live] = {}
        self._lock = threading.Lock()
        self._walks: defaultdict[tuple[str, str], threading.Lock] = defaultdict(
            threading.Lock
        )

    def __enter__(self) -> "Drives":
        """Prepare processes; StudyError says that a text is gone that is followed."""
        for who in self._store.participants():
            for route in self._store.study.design.routes:
                known = _text_of(self._store, who.id, _step(route.route))
                if known is not None:
                    self._texts.episode(known)
        start_server("memorymaze.web.studies.follow.walk")
        return self

    def __exit__(self, *_: object) -> None:
        """Put all robots away."""
        for walk in list(self._lives):
            self._put_away(walk)

    def text_for(self, who: Participant, step: StudyStep) -> Episode:
        """Return the text that somebody follows: at first one that fewest have followed."""
        with self._lock:
            known = _text_of(self._store, who.id, step)
            if known is not None:
                return self._texts.episode(known)
            free_since = self._store.now() - 60 * self._store.study.design.held_minutes
            taken = Counter(
                _text_of(self._store, other.id, step)
                for other in self._store.participants()
                if other.state != "active"
                or other.seen > free_since
                or step in self._store.answers(other.id)
            )
            choice = min(
                self._texts.of_route(step.route), key=lambda each: taken[each.id]
            )
            self._store.add_event(who.id, step, TEXT + choice.id)
            return choice

    def see(self, who: Participant, step: StudyStep) -> dict[str, Any]:
        """Return what the robot's camera sees, with the robot set up where it is not."""
        with self._walks[who.id, step]:
            if step in self._store.answers(who.id):
                return _OVER
            commands = commands_of(self._store, who.id, step)
            live = self._live(who, step, commands)
            return self._shown(who, step, live.wait(len(commands)), last=True)

    def drive(
        self, who: Participant, step: StudyStep, number: int, command: str
    ) -> dict[str, Any]:
        """Give the robot its command of a number, from 0; one that it had counts once."""
        if command not in COMMANDS:
            raise StudyError(f"command: expected one of {', '.join(COMMANDS)}")
        with self._walks[who.id, step]:
            if step in self._store.answers(who.id):
                return _OVER
            commands = commands_of(self._store, who.id, step)
            if number > len(commands):
                raise WalkElsewhere("This walk goes on in another window.")
            live = self._live(who, step, commands)
            if number == len(commands):
                live.wait(number)
                kept = self._store.add_event(who.id, step, DRIVE + command, number)
                if not kept:
                    raise StudyError("There are too many commands already.")
                assert live.process is not None
                live.process.tell(command)
                commands.append(command)
            again = number + 1 < len(commands)
            return self._shown(who, step, live.wait(len(commands)), last=again)

    def ending(self, who: Participant, step: StudyStep, said: Said | None) -> Taken:
        """Return what is kept of a walk that ends, and put its robot away."""
        episode = self.text_for(who, step)
        live = self._lives.get((who.id, step))
        seen = None if live is None else live.seen
        commands = len(commands_of(self._store, who.id, step))
        place = None
        # Of a command under way nobody saw where it ends.
        if said is not None and seen is not None and seen.done == commands:
            place = seen.place
        answer = {
            "text": episode.id,
            "commands": commands,
            "said": None if said is None else said._asdict(),
            "place": place,
        }
        self._put_away((who.id, step))
        return Taken(json.dumps(answer), shown=episode.instruction.text)

    def _keep_as_over(self, who: Participant, step: StudyStep) -> None:
        """Keep a walk that the robot's budget ended: nobody has to say so."""
        taken = self.ending(who, step, None)
        is_last = steps_of(self._store.study.design, who.order)[-1] == step
        state = "complete" if is_last else "active"
        self._store.add_answer(who.id, step, taken.text, taken.shown, state=state)

    def _shown(
        self, who: Participant, step: StudyStep, seen: SeenOnWalk | None, *, last: bool
    ) -> dict[str, Any]:
        if seen is None:
            self._keep_as_over(who, step)
            return _OVER
        frames = seen.frames[-1:] if last else seen.frames
        return {
            "over": False,
            "done": seen.done,
            "metres": round(seen.metres, 1),
            "answer": seen.answer,
            "frames": [b64encode(each).decode() for each in frames],
        }

    def _live(self, who: Participant, step: StudyStep, commands: list[str]) -> _Live:
        """Return the robot of a walk, set up anew where there is none."""
        walk = (who.id, step)
        with self._lock:
            live = self._lives.get(walk)
            if live is not None and not live.lost:
                live.used = self._clock()
                return live
            self._lives.pop(walk, None)
            self._make_room()
            live = self._lives[walk] = _Live(used=self._clock())
        robot = RobotToDrive(
            self._site,
            self.text_for(who, step),
            self._texts.settings,
            tuple(commands),
            self._draws,
        )
        live.process = LiveProcess(robot, live.hear)
        return live

    def _make_room(self) -> None:
        now = self._clock()
        for walk, live in sorted(self._lives.items(), key=lambda each: each[1].used):
            idle = now - live.used
            full = len(self._lives) >= self._most
            if idle > IDLE or (full and idle > STILL_THERE):
                self._put_away(walk)
        if len(self._lives) >= self._most:
            raise NoRobotNow("All robots are being driven. Please wait a minute.")

    def _put_away(self, walk: tuple[str, str]) -> None:
        live = self._lives.pop(walk, None)
        if live is not None and live.process is not None:
            live.process.end()


_OVER: dict[str, Any] = {"over": True}


def commands_of(store: Store, who: str, step: StudyStep) -> list[str]:
    """Return the commands of a walk, in order."""
    events = store.events(who, step)
    return [e.kind.removeprefix(DRIVE) for e in events if e.kind.startswith(DRIVE)]


def finished_walks(store: Store, routes: list[str]) -> list[tuple[str, Walked]]:
    """Return every walk that was ended, with its participant, in the order they ended."""
    walks: list[tuple[str, Walked]] = []
    for who in store.participants():
        answers = store.answers(who.id)
        for step in map(_step, routes):
            if who.state != "excluded" and step in answers:
                walks.append((who.id, _walked(store, who.id, step, answers[step])))
    return sorted(walks, key=lambda each: each[1].at)


def _walked(store: Store, who: str, step: StudyStep, answer: SentAnswer) -> Walked:
    kept = json.loads(answer.text)
    said = None if kept["said"] is None else Said(**kept["said"])
    commands = commands_of(store, who, step)[: kept["commands"]]
    opened = [each.at for each in store.events(who, step) if each.kind == "opened"]
    seconds = answer.at - min(opened, default=answer.at)
    place = None if kept["place"] is None else tuple(kept["place"])
    return Walked(
        kept["text"], answer.shown, tuple(commands), said, place, seconds, answer.at
    )


def _step(route: str) -> StudyStep:
    return StudyStep.of("follow", route)


def _text_of(store: Store, who: str, step: StudyStep) -> str | None:
    kinds = (each.kind for each in store.events(who, step))
    return next((k.removeprefix(TEXT) for k in kinds if k.startswith(TEXT)), None)
