"""An episode in the browser: a page for this machine alone, gone with the episode."""

import json
import math
import secrets
import sys
import threading
import time
from collections.abc import Callable, Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from types import TracebackType
from typing import Any, cast
from urllib.parse import urlsplit

from memorymaze.drawing.shapes import route_color
from memorymaze.drawing.svg import Frame, path_data, plan_frame, svg_plan
from memorymaze.geometry.pose import Pose
from memorymaze.results.watching.onlooker import Present
from memorymaze.sites import Route, Site

PERIOD = 1 / 20
AROUND = 8.0
"""Metres of plan shown round the way described; more when the robot leaves it."""
PATIENCE = 60.0
"""Seconds that a walk waits for somebody to open the page."""
FAREWELL = 5.0
"""Seconds in which pages may fetch the end."""
HEARTBEAT = 5.0
"""Seconds after which a silent stream shows that it lives."""
HOST = "127.0.0.1"
PAGE = {"": "page.html", "page.css": "page.css", "page.js": "page.js"}
TYPES = {"html": "text/html", "css": "text/css", "js": "text/javascript"}
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src "
    "'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}


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
        """Draw the plan, and prepare the page; `say` tells the user where it is."""
        self._say = say or _on_stderr
        self._sent = 0
        self._finished = False
        self._step: object = None
        self._still: list[list[float]] = []
        self._server = _Server(svg_plan(site).encode())
        west, south, east, north = route.line.buffer(AROUND).bounds
        about = {
            "title": title,
            "instruction": instruction,
            "plan": plan_frame(site),
            "view": Frame(west, -north, east - west, north - south),
            "way": path_data(list(route.line.coords)),
            "goal": _place(*route.line.coords[-1][:2]),
            "wayColor": route_color(route.route),
        }
        self._server.publish({"about": about})

    @property
    def address(self) -> str:
        """Where the page is; it holds a secret, so that other users cannot look."""
        return f"http://{HOST}:{self._server.server_port}{self._server.root}"

    def wait_for_somebody(self, patience: float = PATIENCE) -> bool:
        """Say where the page is, wait until it is open, and return whether it is."""
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
            "robot": _directed(present.pose),
            "path": [_place(*each) for each in path],
            "events": [
                {"time": round(event.time, 1), "kind": event.kind, "text": event.text}
                for event in present.fresh
            ],
            "people": [_place(each.x, each.y) for each in present.people.values()],
        }
        if present.things and not self._still:
            self._still = [_place(each.x, each.y) for each in present.things.values()]
            news["things"] = self._still
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
        self._server.thread.start()
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


def _place(x: float, y: float) -> list[float]:
    """Return a place in the coordinates of the page: metres, y down."""
    return [round(x, 2), round(-y, 2)]


def _directed(pose: Pose) -> list[float]:
    """Return a place with degrees clockwise from east."""
    return [*_place(pose.x, pose.y), round(-math.degrees(pose.heading), 1)]


def _on_stderr(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


class _Server(ThreadingHTTPServer):
    """Serves what was published so far, and then what is published, to every page."""

    daemon_threads = True
    block_on_close = False

    def __init__(self, plan: bytes) -> None:
        super().__init__((HOST, 0), _Handler)
        self.root = f"/{secrets.token_urlsafe(9)}/"
        folder = files("memorymaze.results.watching") / "page"
        self.documents = {f"{self.root}plan.svg": (plan, "image/svg+xml")}
        for name, file in PAGE.items():
            kind = f"{TYPES[file.rpartition('.')[2]]}; charset=utf-8"
            self.documents[self.root + name] = ((folder / file).read_bytes(), kind)
        self.opened = threading.Event()
        self.thread = threading.Thread(
            target=self.serve_forever, args=(0.05,), daemon=True
        )
        self._news: list[str] = []
        self._grown = threading.Condition()
        self._over = False
        self._listening = 0

    def publish(self, news: Mapping[str, Any]) -> None:
        """Send news to all pages, also to those that are opened later."""
        with self._grown:
            self._news.append(f"data: {json.dumps(news, separators=(',', ':'))}\n\n")
            self._grown.notify_all()

    def close(self, farewell: float) -> None:
        """Let open pages fetch the rest, and stop."""
        end = time.monotonic() + farewell
        with self._grown:
            self._over = True
            self._grown.notify_all()
            self._grown.wait_for(
                lambda: not self._listening, max(0.0, end - time.monotonic())
            )
        self.shutdown()
        self.server_close()
        self.thread.join(timeout=2)

    def stream_to(self, handler: BaseHTTPRequestHandler) -> None:
        """Write all news to a page, until it goes away or all is over."""
        sent = 0
        with self._grown:
            self._listening += 1
        self.opened.set()
        try:
            while True:
                with self._grown:
                    self._grown.wait_for(
                        lambda known=sent: self._over or len(self._news) > known,
                        HEARTBEAT,
                    )
                    fresh, over = self._news[sent:], self._over
                handler.wfile.write("".join(fresh).encode() or b": alive\n\n")
                handler.wfile.flush()
                sent += len(fresh)
                if over and not fresh:
                    return
        finally:
            with self._grown:
                self._listening -= 1
                self._grown.notify_all()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Pages that go away in the middle are no trouble."""


class _Handler(BaseHTTPRequestHandler):
    timeout = 30

    def do_GET(self) -> None:
        server = cast(_Server, self.server)
        path = urlsplit(self.path).path
        # A foreign page could have its own name point here.
        hosts = {f"{name}:{server.server_port}" for name in (HOST, "localhost")}
        if self.headers.get("Host") not in hosts:
            self.send_error(HTTPStatus.FORBIDDEN)
        elif path == f"{server.root}news":
            self._begin({"Content-Type": "text/event-stream"})
            server.stream_to(self)
        elif path in server.documents:
            content, kind = server.documents[path]
            length = str(len(content))
            self._begin({"Content-Type": kind, "Content-Length": length})
            self.wfile.write(content)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def _begin(self, headers: dict[str, str]) -> None:
        self.send_response(HTTPStatus.OK)
        for name, value in (headers | HEADERS).items():
            self.send_header(name, value)
        self.end_headers()

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing of requests."""
