"""Visitors who try the robot: each has one of a few processes, and it ends with the page."""

import secrets
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal

from memorymaze.basics.errors import MemoryMazeError
from memorymaze.basics.processes import start_server
from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.web.serving.live_process import LiveProcess, ProcessLost
from memorymaze.web.try_page.walk import (
    News,
    Pace,
    Ready,
    RobotToTry,
    SetOut,
    ShownPicture,
)
from memorymaze.world.sites import Route, Site

PATIENCE = 90.0
"""Seconds without a sign of life of the page after which its robot is put away; browsers
let pages in the background ask once a minute."""
LEAVING = 5.0
"""Seconds after a page was closed in which it may come back, as when it is loaded anew."""
KEPT = 50
"""Visitors that are remembered, with robots or without."""
DEFAULT_PACE = 5.0

_State = Literal["opening", "ready", "walking", "over", "away"]
"""`opening`: the robot is set up; `ready`: it listens; `away`: there is no robot."""


class NoRobotFree(MemoryMazeError):
    """All robots are in use."""


@dataclass(eq=False)
class PageVisit:
    """What a visitor's page shows; others than its own session only read it."""

    id: str
    browser: str
    """Whose it is; a browser has one robot at a time."""
    site: Site
    route: Route
    seen: float
    """When the page gave its last sign of life."""
    state: _State = "opening"
    text: str = ""
    """What the robot follows, or followed last."""
    waiting: bool = False
    """Whether the text is to be followed as soon as the robot is ready."""
    walk: int = 0
    """Number of the walk, from 1 on."""
    pace: float = DEFAULT_PACE
    paused: bool = False
    trouble: str = ""
    """Why there is no robot."""
    blind: str = ""
    """Why the robot takes no pictures."""
    news: list[dict[str, Any]] = field(default_factory=list[dict[str, Any]])
    """Of this walk."""
    pictures: dict[str, bytes] = field(default_factory=dict[str, bytes])
    drawn: int = 0
    """Pictures of the camera so far."""
    process: LiveProcess | None = None
    robots: int = 0
    """Processes so far, which tells what the present one says from what others said."""


class Visits:
    """All visitors; use it in a `with`, which puts all robots away at its end."""

    def __init__(
        self,
        settings: RunSettings,
        beside: Sequence[AgentSettings],
        *,
        most: int,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Have no visitor yet, and robots for `most` at a time."""
        self._settings, self._beside = settings, tuple(beside)
        self._most, self._clock = most, clock
        self._visits: dict[str, PageVisit] = {}
        self._lock = threading.RLock()
        self._closed = threading.Event()

    def __enter__(self) -> "Visits":
        """Begin to look after those who left."""
        start_server("memorymaze.web.try_page.walk")
        threading.Thread(target=self._look_after, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        """Put all robots away."""
        self._closed.set()
        with self._lock:
            for visit in self._visits.values():
                self._put_away(visit)

    def begin(self, site: Site, route: Route, browser: str) -> PageVisit:
        """Give a visitor a robot, and take back the one that the browser had.

        `NoRobotFree` says that there are too many visitors.
        """
        with self._lock:
            name = secrets.token_urlsafe(12)
            visit = PageVisit(name, browser, site, route, self._clock())
            self._start(visit)
            self._visits[visit.id] = visit
            while len(self._visits) > KEPT:
                self._forget_oldest()
        return visit

    def find(self, visit_id: str) -> PageVisit | None:
        """Return a visitor, who is there at this moment."""
        with self._lock:
            visit = self._visits.get(visit_id)
            if visit is not None:
                visit.seen = self._clock()
            return visit

    def set_out(self, visit: PageVisit, text: str) -> bool:
        """Let the robot follow a text once it is ready; False while it follows one."""
        with self._lock:
            if visit.state == "walking" or visit.waiting:
                return False
            if visit.process is None:
                self._start(visit)
            visit.text, visit.paused = text, False
            if visit.state == "opening":
                visit.waiting = True
            else:
                self._send_out(visit)
            return True

    def change_pace(self, visit: PageVisit, pace: float | None, paused: bool) -> None:
        """Go on at another pace, or stand still."""
        with self._lock:
            visit.pace, visit.paused = pace or visit.pace, paused
            if visit.process is not None and visit.state == "walking":
                visit.process.tell(Pace(0.0 if paused else visit.pace))

    def leave(self, visit: PageVisit) -> None:
        """Take note that the page was closed, or is loaded anew."""
        with self._lock:
            visit.seen = self._clock() - PATIENCE + LEAVING

    def stop(self, visit: PageVisit) -> None:
        """End the walk, and have a robot at the start again."""
        with self._lock:
            self._put_away(visit)
            visit.news.clear()
            self._start(visit)

    def news_after(self, visit: PageVisit, walk: int, known: int) -> Mapping[str, Any]:
        """Return how things stand, with the news of this walk that are not known."""
        with self._lock:
            fresh = visit.news[known:] if walk == visit.walk else visit.news
            return {
                "state": visit.state,
                "walk": visit.walk,
                "paused": visit.paused,
                "trouble": visit.trouble,
                "blind": visit.blind,
                "looked_round": "round" in visit.pictures,
                "camera": visit.drawn,
                "known": len(visit.news),
                "news": fresh,
            }

    # With the lock held.

    def _start(self, visit: PageVisit) -> None:
        for other in self._visits.values():
            if other.browser == visit.browser:
                self._put_away(other, "The robot is on another way now.")
        in_use = sum(each.process is not None for each in self._visits.values())
        if in_use >= self._most:
            raise NoRobotFree(
                f"All {self._most} robots are being tried by others. Please try again "
                "in a minute."
            )
        robot = RobotToTry(visit.site, visit.route.id, self._settings, self._beside)
        visit.state, visit.trouble = "opening", ""
        visit.robots += 1
        visit.process = LiveProcess(robot, partial(self._hear, visit, visit.robots))

    def _send_out(self, visit: PageVisit) -> None:
        assert visit.process is not None
        visit.walk += 1
        visit.state, visit.waiting = "walking", False
        visit.news.clear()
        visit.process.tell(SetOut(visit.text, visit.pace))

    def _put_away(self, visit: PageVisit, why: str = "") -> None:
        if visit.process is not None:
            process, visit.process = visit.process, None
            process.end()
            visit.state, visit.trouble, visit.waiting = "away", why, False

    def _forget_oldest(self) -> None:
        oldest = min(self._visits.values(), key=lambda each: each.seen)
        self._put_away(oldest)
        del self._visits[oldest.id]

    # In threads of their own.

    def _hear(self, visit: PageVisit, robot: int, message: object) -> None:
        with self._lock:
            if visit.process is None or visit.robots != robot:
                return  # what a robot said last that was put away
            if isinstance(message, ShownPicture):
                visit.pictures[message.name] = message.jpeg
                visit.drawn += message.name == "camera"
            elif isinstance(message, News):
                visit.news.append(message.content)
            elif isinstance(message, ProcessLost):
                self._put_away(visit, str(message))
            elif isinstance(message, Ready):
                visit.blind = message.blind
                visit.state = "ready" if visit.state == "opening" else "over"
                if visit.waiting:
                    self._send_out(visit)

    def _look_after(self) -> None:
        while not self._closed.wait(1.0):
            with self._lock:
                for visit in self._visits.values():
                    if self._clock() - visit.seen > PATIENCE:
                        self._put_away(
                            visit, "The robot was put away: nobody was watching."
                        )
