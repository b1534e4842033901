"""A small web server on 127.0.0.1: one page, its plan, and a stream of news."""

import io
import json
import secrets
import threading
import time
from collections.abc import Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any, cast
from urllib.parse import urlsplit

import numpy as np
from numpy.typing import NDArray
from PIL import Image

HOST = "127.0.0.1"
KINDS = {
    "": ("page.html", "text/html; charset=utf-8"),
    "page.css": ("page.css", "text/css; charset=utf-8"),
    "page.js": ("page.js", "text/javascript; charset=utf-8"),
}
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src "
    "'self'; img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}
HEARTBEAT = 5.0
"""Seconds after which a silent stream shows that it lives."""


class PageServer:
    """Serves what was published so far, and then what is published, to every page.

    The address holds a secret, so that other users of the machine cannot look.
    """

    def __init__(self, plan: NDArray[np.uint8], about: Mapping[str, Any]) -> None:
        """Open a port; nothing is answered before `start`.

        Args:
            plan: Colours, (height, width, 3).
            about: Given to the page before all news.

        Raises:
            OSError: No port can be opened.
        """
        self.opened = threading.Event()
        """Set once a page listens."""
        self._news = [_event({"about": dict(about)})]
        self._grown = threading.Condition()
        self._over = False
        self._listening = 0
        content = io.BytesIO()
        Image.fromarray(plan).save(content, "PNG")
        self._plan = content.getvalue()
        self._secret = secrets.token_urlsafe(9)
        self._server = _Server(self)
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(0.05,), daemon=True
        )

    @property
    def address(self) -> str:
        """URL of the page."""
        return f"http://{HOST}:{self._server.server_port}/{self._secret}/"

    def start(self) -> None:
        """Begin to answer."""
        self._thread.start()

    def publish(self, news: Mapping[str, Any]) -> None:
        """Send news to all pages, also to those that are opened later."""
        with self._grown:
            self._news.append(_event(news))
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
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(timeout=2)

    def document(self, path: str) -> tuple[bytes, str] | None:
        """Return content and kind of a document; None where there is none."""
        name = self._name(path)
        if name == "plan.png":
            return self._plan, "image/png"
        if name in KINDS:
            file, kind = KINDS[name]
            return (
                files("memorymaze.results.watching") / "page" / file
            ).read_bytes(), kind
        return None

    def is_stream(self, path: str) -> bool:
        """Whether a path is that of the news."""
        return self._name(path) == "news"

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

    def _name(self, path: str) -> str | None:
        start = f"/{self._secret}/"
        path = urlsplit(path).path
        return path.removeprefix(start) if path.startswith(start) else None


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False

    def __init__(self, pages: PageServer) -> None:
        self.pages = pages
        super().__init__((HOST, 0), _Handler)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Pages that go away in the middle are no trouble."""


class _Handler(BaseHTTPRequestHandler):
    timeout = 30

    def do_GET(self) -> None:
        server = cast(_Server, self.server)
        pages = server.pages
        # A foreign page could have its own name point here.
        hosts = {f"{name}:{server.server_port}" for name in (HOST, "localhost")}
        if self.headers.get("Host") not in hosts:
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        if pages.is_stream(self.path):
            self._begin("text/event-stream", None)
            pages.stream_to(self)
            return
        document = pages.document(self.path)
        if document is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        content, kind = document
        self._begin(kind, len(content))
        self.wfile.write(content)

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing of requests."""

    def _begin(self, kind: str, length: int | None) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", kind)
        if length is not None:
            self.send_header("Content-Length", str(length))
        for name, value in HEADERS.items():
            self.send_header(name, value)
        self.end_headers()


def _event(news: Mapping[str, Any]) -> str:
    return f"data: {json.dumps(news, separators=(',', ':'))}\n\n"
