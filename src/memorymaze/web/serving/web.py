"""What every page needs: limits, templates, forms that only our pages send, servers.

No page's content.
"""

import hmac
import secrets
import socket
import threading
import time
from collections.abc import Awaitable, Callable, Generator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.datastructures import MutableHeaders
from starlette.exceptions import HTTPException
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response
from starlette.routing import BaseRoute, Mount
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.templates import templates_of
from memorymaze.basics.wording import printable

ROOM = "memorymaze.web.serving"

MAX_BODY = 1_000_000
"""Bytes that a request may bring."""
RATE = 6000
"""Requests a minute from one address; a whole laboratory may stand behind one."""
HEADERS = {
    "Content-Security-Policy": "default-src 'self'; img-src 'self' data: blob:; "
    "media-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'self'; "
    "frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(self)",
}
THIS_MACHINE = ("127.0.0.1", "localhost", "::1")
"""Names by which it is asked for from itself alone."""
LAST_PORT = 65535
FORM_KEY = "form-key"
"""The cookie that a page's forms are bound to."""
READING = frozenset({"GET", "HEAD", "OPTIONS"})
ERROR_TEXTS = {
    400: "The request could not be read.",
    403: "This page was open too long or was sent from elsewhere. Go back, load the "
    "page again, and send it once more.",
    404: "There is no such page here.",
    405: "This address takes no such request.",
    413: "What was sent is too large.",
    429: "Too many requests came from your network. Wait a minute and try again.",
    500: "Something went wrong here. What you sent before is kept.",
}


def make_app(
    routes: Sequence[BaseRoute],
    *rooms: str,
    max_body: int = MAX_BODY,
    rate: int | None = RATE,
    hosts: Sequence[str] | None = None,
) -> Starlette:
    """Return an application of pages, with static files at `/static`.

    `rooms` are the packages with the pages' templates and static files.
    `rate` is of requests a minute and address; None for no limit. `hosts` are the names
    it answers to, without ports; None for every name.
    """
    limit = None if rate is None else RateLimit(rate)
    rooms = (*rooms, ROOM)
    static = StaticFiles(packages=[(room, "static") for room in rooms])
    app = Starlette(
        routes=[*routes, Mount("/static", static)],
        middleware=[Middleware(Guard, max_body=max_body, limit=limit, hosts=hosts)],
        exception_handlers={HTTPException: _say_refusal, 500: _say_fault},
    )
    app.state.templates = templates_of(*rooms)
    return app


def render(
    request: Request, template: str, status_code: int = 200, **context: Any
) -> Response:
    """Return a page; every text of the context is escaped."""
    known = {"language": "en", "csrf_token": csrf_token(request), **context}
    text = request.app.state.templates.get_template(template).render(known)
    return HTMLResponse(printable(text), status_code=status_code)


Fields = dict[str, str]
"""What a form sent: texts by name, with line ends as they are everywhere else."""


def posted(
    take: Callable[[Request, Fields], Response],
) -> Callable[[Request], Awaitable[Response]]:
    """Return the endpoint of a form, from a function that may wait for the disk."""

    async def endpoint(request: Request) -> Response:
        form = await request.form()
        fields = {
            name: value.replace("\r\n", "\n")
            for name, value in form.items()
            if isinstance(value, str)
        }
        return await run_in_threadpool(take, request, fields)

    return endpoint


def csrf_token(request: Request) -> str:
    """Return what a form or script of this browser must send along.

    It follows from a cookie that other sites can neither read nor guess, so that a form
    outlives a restart of the server.
    """
    return _token(request.state.form_key)


def _token(form_key: str) -> str:
    return sha256(b"form of " + form_key.encode()).hexdigest()


def _error_page(request: Request, status: int, detail: str | None = None) -> Response:
    text = detail or ERROR_TEXTS.get(status, ERROR_TEXTS[400])
    return render(request, "error.html", status, status=status, text=text)


async def _say_refusal(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    page = _error_page(
        request,
        error.status_code,
        # Starlette's own details are only the names of the codes.
        None if error.status_code in {404, 405} else error.detail,
    )
    page.headers.update(error.headers or {})
    return page


async def _say_fault(request: Request, error: Exception) -> Response:
    page = _error_page(request, 500)
    page.headers.update(HEADERS)  # the guard stands inside of what calls this
    return page


class RateLimit:
    """Counts requests of addresses; each may have `rate` at once and again in a minute."""

    def __init__(self, rate: int, clock: Callable[[], float] = time.monotonic) -> None:
        """Begin with no request."""
        self._rate = rate
        self._clock = clock
        self._spent: dict[str, tuple[float, float]] = {}

    def allows(self, address: str) -> bool:
        """Count a request and tell whether it is within the limit."""
        now = self._clock()
        if len(self._spent) > 10_000:
            self._forget_idle(now)
        spent = self._left_over(address, now)
        if spent + 1 > self._rate:
            return False
        self._spent[address] = (spent + 1, now)
        return True

    def _left_over(self, address: str, now: float) -> float:
        spent, then = self._spent.get(address, (0.0, now))
        return max(0.0, spent - (now - then) * self._rate / 60)

    def _forget_idle(self, now: float) -> None:
        for address in list(self._spent):
            if self._left_over(address, now) == 0:
                del self._spent[address]


class Guard:
    """Stands before every page: rate, host, size, forms of our own, headers."""

    def __init__(
        self,
        app: ASGIApp,
        max_body: int,
        limit: RateLimit | None,
        hosts: Sequence[str] | None,
    ) -> None:
        """Take the pages and the limits."""
        self._app = app
        self._max_body = max_body
        self._limit = limit
        self._hosts = hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or hand it on."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        request = Request(scope, receive)
        known = request.cookies.get(FORM_KEY, "")
        is_new = len(known) < 32
        request.state.form_key = secrets.token_urlsafe(32) if is_new else known

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers.update(HEADERS)
                headers.setdefault("Cache-Control", "no-cache")
                if headers.get("content-type", "").startswith("text/html"):
                    headers["Cache-Control"] = "no-store"
                    if is_new:
                        headers.append("Set-Cookie", _form_key_cookie(request))
            await send(message)

        try:
            receive = await self._checked(request, receive)
        except HTTPException as error:
            page = await _say_refusal(request, error)
            await page(scope, receive, send_with_headers)
            return
        await self._app(scope, receive, send_with_headers)

    async def _checked(self, request: Request, receive: Receive) -> Receive:
        """Return what the pages read the body from; HTTPException refuses a request."""
        address = request.client.host if request.client else ""
        if self._limit is not None and not self._limit.allows(address):
            raise HTTPException(429, ERROR_TEXTS[429], {"Retry-After": "60"})
        if self._hosts is not None and request.url.hostname not in self._hosts:
            raise HTTPException(403, "This server does not answer to that name.")
        if request.method in READING:
            return receive
        if request.headers.get("sec-fetch-site") in {"cross-site", "same-site"}:
            raise HTTPException(403, ERROR_TEXTS[403])
        body = await self._body(request)
        given = request.headers.get("x-csrf-token")
        if given is None:
            form = await Request(request.scope, _replay(body)).form()
            given = form.get("csrf_token")
        right = _token(request.state.form_key)
        if not isinstance(given, str) or not hmac.compare_digest(
            given.encode(), right.encode()
        ):
            raise HTTPException(403, ERROR_TEXTS[403])
        return _replay(body)

    async def _body(self, request: Request) -> bytes:
        told = request.headers.get("content-length", "0")
        body = bytearray()
        if told.isdecimal() and int(told) <= self._max_body:
            async for chunk in request.stream():
                body += chunk
                if len(body) > self._max_body:
                    break
            else:
                return bytes(body)
        raise HTTPException(413, ERROR_TEXTS[413])


def _form_key_cookie(request: Request) -> str:
    made = Response()
    made.set_cookie(
        FORM_KEY,
        request.state.form_key,
        httponly=True,
        samesite="lax",
        secure=request.url.scheme == "https",
    )
    return made.headers["set-cookie"]


def _replay(body: bytes) -> Receive:
    messages: list[Message] = [
        {"type": "http.request", "body": body, "more_body": False}
    ]

    async def receive() -> Message:
        return messages.pop() if messages else {"type": "http.disconnect"}

    return receive


class Certificate(NamedTuple):
    """What https needs."""

    chain: Path
    key: Path


@dataclass(frozen=True, slots=True)
class ServedApplication:
    """An application and where it is to be found."""

    app: ASGIApp
    host: str = "127.0.0.1"
    port: int = 0
    """0 for any that is free."""
    certificate: Certificate | None = None


def wait_for_interrupt() -> None:
    """Return when somebody types Ctrl-C."""
    try:
        threading.Event().wait()
    except KeyboardInterrupt:
        return


@contextmanager
def serving(*doors: ServedApplication) -> Generator[list[str]]:
    """Serve, each door in a thread; yields their addresses, such as `http://[::1]:80`.

    Of a door to all networks it is the address that others in the network come to.
    """
    with ExitStack() as stack:
        # All are taken first: half a study is no use.
        sockets = [stack.enter_context(_listening(door)) for door in doors]
        for door, listener in zip(doors, sockets, strict=True):
            stack.enter_context(_running(door, listener))
        yield [_address(*each) for each in zip(doors, sockets, strict=True)]


@contextmanager
def _listening(door: ServedApplication) -> Generator[socket.socket]:
    if not 0 <= door.port <= LAST_PORT:
        raise SettingsError(
            f"--port: expected 0 (any free one) to {LAST_PORT}, got {door.port}"
        )
    try:
        family = socket.getaddrinfo(door.host, door.port, type=socket.SOCK_STREAM)[0][0]
        listener = socket.create_server((door.host, door.port), family=family)
    except OSError as error:
        raise SettingsError(
            f"{door.host} port {door.port}: cannot be served at ({error.strerror}); choose "
            "another host or port"
        ) from None
    with listener:
        yield listener


@contextmanager
def _running(door: ServedApplication, listener: socket.socket) -> Generator[None]:
    chain, key = door.certificate or (None, None)
    server = uvicorn.Server(
        uvicorn.Config(
            door.app,
            log_config=None,
            log_level="error",
            access_log=False,
            server_header=False,
            ws="none",
            # A page that listens for news would keep the server from ending.
            timeout_graceful_shutdown=2,
            ssl_certfile=chain,
            ssl_keyfile=key,
        )
    )
    thread = threading.Thread(target=server.run, args=([listener],), daemon=True)
    thread.start()
    try:
        while not server.started and thread.is_alive():
            time.sleep(0.005)
        yield
    finally:
        server.should_exit = True
        thread.join()


def _address(door: ServedApplication, listener: socket.socket) -> str:
    scheme = "http" if door.certificate is None else "https"
    host = door.host
    if host in {"0.0.0.0", "::"}:
        here = "127.0.0.1" if listener.family == socket.AF_INET else "::1"
        host = own_address(listener.family) or here
    host = f"[{host}]" if ":" in host else host
    return f"{scheme}://{host}:{listener.getsockname()[1]}"


def own_address(family: int = socket.AF_INET) -> str:
    """Return by which address others in the network reach this machine; empty for none."""
    other = "192.0.2.1" if family == socket.AF_INET else "2001:db8::1"
    with socket.socket(family, socket.SOCK_DGRAM) as asking:
        try:
            asking.connect((other, 9))  # sends nothing, only looks up the way
        except OSError:
            return ""
        return asking.getsockname()[0]
