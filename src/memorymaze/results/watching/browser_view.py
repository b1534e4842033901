"""An episode in the browser: a page for this machine alone, gone with the episode."""

import sys
from collections.abc import Callable
from types import TracebackType
from typing import Any

import numpy as np

from memorymaze.drawing.pixels import draw_plan
from memorymaze.drawing.routes import route_color
from memorymaze.geometry.pose import Pose
from memorymaze.results.watching.page_server import PageServer
from memorymaze.results.watching.present import Present
from memorymaze.sites import Route, Site

PERIOD = 1 / 20
PLAN_SIZE = (1400, 1050)
"""Pixels."""
PATIENCE = 60.0
"""Seconds that a walk waits for somebody to open the page."""
FAREWELL = 5.0
"""Seconds in which pages may fetch the end."""


class BrowserView:
    """Serves a page on 127.0.0.1 while an episode goes on; use it in a `with`."""

    period = PERIOD

    def __init__(
        self,
        site: Site,
        route: Route,
        instruction: str,
        title: str,
        say: Callable[[str], None] | None = None,
    ) -> None:
        """Draw the plan, and prepare the page.

        Args:
            site: Where.
            route: The way that the instruction describes.
            instruction: The text.
            title: Of the page.
            say: Tells the user where the page is; on stderr when None.

        Raises:
            OSError: No port can be opened.
        """
        self._say = say or _on_stderr
        west, south, east, north = site.walkable_floor.bounds
        corners = np.array([(west, south), (east, north)])
        self._sheet = draw_plan(site, [route], corners, PLAN_SIZE, magnified=1.2)
        self._sent = 0
        self._finished = False
        self._step: object = None
        self._still: dict[str, Any] = {}
        about = {
            "title": title,
            "instruction": instruction,
            "width": PLAN_SIZE[0],
            "height": PLAN_SIZE[1],
            "scale": self._sheet.scale,
            "routeColor": route_color(route.route),
        }
        self._server = PageServer(self._sheet.picture, about)

    @property
    def address(self) -> str:
        """Where the page is."""
        return self._server.address

    def wait_for_somebody(self, patience: float = PATIENCE) -> bool:
        """Say where the page is and wait until it is open, so that no step is missed.

        Returns:
            Whether somebody opened it; nobody is waited for longer than `patience`.
        """
        self._say(
            f"watch at {self.address} (the robot sets out when the page is open, or in "
            f"{patience:.0f} s)"
        )
        return self._server.opened.wait(patience)

    def show(self, present: Present) -> None:
        """Send what is new to the pages."""
        path = present.path[self._sent :]
        self._sent = len(present.path)
        news: dict[str, Any] = {
            "time": round(present.time, 2),
            "distance": round(present.distance, 1),
            "robot": self._place(present.pose),
            "path": [_short(self._sheet.pixel(*each)) for each in path],
            "events": [
                {"time": round(event.time, 1), "kind": event.kind, "text": event.text}
                for event in present.fresh
            ],
            "people": [self._place(each) for each in present.people.values()],
        }
        if present.things and not self._still:
            self._still = {name: self._place(p) for name, p in present.things.items()}
            news["things"] = list(self._still.values())
        if present.step != self._step:
            self._step = present.step
            news["step"] = present.step._asdict()
        self._server.publish(news)

    def finish(self, words: str) -> None:
        """Send how the episode ended."""
        self._finished = True
        self._server.publish({"over": words})

    def __enter__(self) -> "BrowserView":
        """Begin to serve."""
        self._server.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Tell the pages that it is over, and close."""
        if error is not None or not self._finished:
            self._server.publish({"over": "The episode was broken off."})
        self._server.close(FAREWELL if error is None else 0.5)

    def _place(self, pose: Pose) -> list[float]:
        """Return column, row and degrees clockwise from east."""
        x, y = _short(self._sheet.pixel(pose.x, pose.y))
        return [x, y, round(-float(np.degrees(pose.heading)), 1)]


def _short(place: tuple[float, float]) -> list[float]:
    return [round(place[0], 1), round(place[1], 1)]


def _on_stderr(text: str) -> None:
    print(text, file=sys.stderr, flush=True)
