"""Talks to a policy server; whatever it does, the outcome is an answer or one clear error."""

import time
from typing import Any, TypeVar
from urllib.parse import urlsplit

import httpx2
from pydantic import BaseModel, ValidationError

from memorymaze.agents.navid.protocol import (
    VERSION,
    Acknowledgement,
    ActReply,
    ActRequest,
    CloseRequest,
    Failure,
    ResetRequest,
    ServerInfo,
)
from memorymaze.errors import LanguageModelError, SettingsError

Reply = TypeVar("Reply", bound=BaseModel)

LONGEST_ANSWER = 1_000_000
"""Bytes of an answer beyond which it is given up."""


class PolicyServer:
    """A server of the NaVid protocol.

    What may pass is tried again: a connection that fails or breaks, a time-out, and
    statuses from 500. The protocol allows for a message that comes twice.
    """

    def __init__(
        self,
        address: str,
        *,
        timeout: float = 120.0,
        retries: int = 4,
        first_delay: float = 1.0,
    ) -> None:
        """Prepare a client; nothing is sent yet.

        Args:
            address: Such as `http://localhost:8765`.
            timeout: Seconds that an answer may take, from first byte sent to last
                received.
            retries: Attempts after the first.
            first_delay: Seconds before the second attempt; twice as many before each
                further one.

        Raises:
            SettingsError: The address is none.
        """
        self.address = _checked(address)
        self._timeout = timeout
        self._retries = retries
        self._first_delay = first_delay
        # Connections that stay open would outlive the episode and go stale.
        unkept = httpx2.Limits(max_keepalive_connections=0)
        self._client = httpx2.Client(
            timeout=timeout, follow_redirects=False, limits=unkept
        )

    def info(self) -> ServerInfo:
        """Ask who is there.

        Raises:
            LanguageModelError: Nobody who speaks this version of the protocol.
        """
        info = self._exchange("GET", "/info", None, ServerInfo)
        if info.protocol_version != VERSION:
            raise self._error(
                "/info",
                f"speaks version {info.protocol_version} of the protocol, expected "
                f"version {VERSION}; use a server made for this version",
            )
        return info

    def reset(self, request: ResetRequest) -> None:
        """Begin an episode.

        Raises:
            LanguageModelError: No usable answer came.
        """
        self._exchange("POST", "/reset", request, Acknowledgement)

    def observe(self, request: ActRequest) -> None:
        """Show a picture.

        Raises:
            LanguageModelError: No usable answer came.
        """
        self._exchange("POST", "/act", request, Acknowledgement)

    def act(self, request: ActRequest) -> ActReply:
        """Show a picture and ask for the next motion.

        Raises:
            LanguageModelError: No usable answer came.
        """
        reply = self._exchange("POST", "/act", request, ActReply)
        if not (reply.text.strip() or reply.actions):
            raise self._error("/act", "sent an answer with neither text nor actions")
        return reply

    def close(self, request: CloseRequest) -> None:
        """End an episode.

        Raises:
            LanguageModelError: No usable answer came.
        """
        self._exchange("POST", "/close", request, Acknowledgement)

    def _exchange(
        self, method: str, path: str, request: BaseModel | None, expected: type[Reply]
    ) -> Reply:
        body = None if request is None else request.model_dump_json()
        attempt = 0
        while True:
            try:
                status, answer = self._send(method, path, body)
                if status < 500:
                    return self._read(path, status, answer, expected)
                cause = f"answered {status}: {_said(answer)}"
            except httpx2.InvalidURL as error:
                raise self._error(path, f"cannot be asked: {error}") from error
            except httpx2.TimeoutException:
                cause = f"did not answer within {self._timeout:g} s"
            except httpx2.ConnectError as error:
                cause = f"cannot be reached: {_one_line(error)}; is it running?"
            except httpx2.HTTPError as error:
                cause = f"broke off: {_one_line(error)}"
            attempt += 1
            if attempt > self._retries:
                tried = f" ({attempt} attempts)" if attempt > 1 else ""
                raise self._error(path, cause + tried)
            time.sleep(self._first_delay * 2 ** (attempt - 1))

    def _send(self, method: str, path: str, body: str | None) -> tuple[int, bytes]:
        """Return status and body of the answer."""
        latest = time.monotonic() + self._timeout
        received = bytearray()
        with self._client.stream(
            method,
            self.address + path,
            content=body,
            headers={"content-type": "application/json", "accept-encoding": "identity"},
        ) as answer:
            for piece in answer.iter_raw():
                received += piece
                if len(received) > LONGEST_ANSWER:
                    raise self._error(
                        path, f"sent an answer of more than {LONGEST_ANSWER} bytes"
                    )
                # Each piece may come in time and the whole never end.
                if time.monotonic() > latest:
                    raise httpx2.ReadTimeout("the answer did not end")
            return answer.status_code, bytes(received)

    def _read(
        self, path: str, status: int, answer: bytes, expected: type[Reply]
    ) -> Reply:
        if status != 200:
            raise self._error(path, f"answered {status}: {_said(answer)}")
        try:
            return expected.model_validate_json(answer)
        except ValidationError as error:
            first: Any = error.errors()[0]
            where = ".".join(str(part) for part in first["loc"])
            what = f"where {where!r} is wrong" if where else "that is wrong"
            raise self._error(
                path,
                f"sent an answer {what} ({first['msg']}): {_beginning(answer)}",
            ) from None

    def _error(self, path: str, cause: str) -> LanguageModelError:
        return LanguageModelError(f"policy server {self.address}{path} {cause}")


def _checked(address: str) -> str:
    try:
        parts = urlsplit(address)
        good = parts.scheme in {"http", "https"} and parts.hostname and parts.port != 0
        good = good and not (parts.query or parts.fragment)
    except ValueError:
        good = False
    if not good:
        raise SettingsError(
            "--set server: expected an address such as http://localhost:8765, got "
            f"{address!r}"
        )
    return address.rstrip("/")


def _said(answer: bytes) -> str:
    try:
        return " ".join(Failure.model_validate_json(answer).error.split())[:300]
    except ValidationError:
        return _beginning(answer)


def _beginning(answer: bytes) -> str:
    return repr(" ".join(answer[:300].decode("utf-8", "replace").split())[:80])


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split())[:200] or type(error).__name__
