"""Calls to servers that end, however a server answers, and the addresses of servers."""

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import TypeVar
from urllib.parse import urlsplit

from memorymaze.errors import SettingsError

_Answer = TypeVar("_Answer")


def within(seconds: float, call: Callable[[], _Answer]) -> _Answer:
    """Return what a call returns, and raise what it raises.

    Time-outs of clients are for each part of an answer, so that a server that sends a
    byte now and then, for ever, would hold up a run. A call that takes too long is left
    to itself; close its connection, so that it ends.

    Raises:
        TimeoutError: It took longer.
    """
    future: Future[_Answer] = Future()

    def run() -> None:
        try:
            future.set_result(call())
        except BaseException as error:
            future.set_exception(error)

    # As a daemon: nobody waits for it at the end of the process either.
    Thread(target=run, daemon=True).start()
    return future.result(seconds)


def exchange(
    method: str, address: str, body: str | None, *, seconds: float, longest: int
) -> tuple[int, bytes]:
    """Send a message, JSON if any, and return status and body of the answer.

    The connection is the exchange's own: one that stays open would outlive an episode.

    Args:
        method: GET or POST.
        address: Where to.
        body: JSON.
        seconds: For the whole, from connecting to the answer's last byte.
        longest: Bytes of an answer beyond which it is given up.

    Raises:
        TimeoutError: It took longer.
        ConnectionError: Nobody is there, or it broke off; the message says which.
        ValueError: The address cannot be asked, or the answer is too long.
    """
    import httpx2  # takes a while, and most runs ask nobody

    headers = {"content-type": "application/json", "accept-encoding": "identity"}

    def ask(client: httpx2.Client) -> tuple[int, bytes]:
        received = bytearray()
        with client.stream(method, address, content=body, headers=headers) as answer:
            for piece in answer.iter_raw():
                received += piece
                if len(received) > longest:
                    raise ValueError(f"sent an answer of more than {longest:,} bytes")
            return answer.status_code, bytes(received)

    with httpx2.Client(timeout=seconds, follow_redirects=False) as client:
        try:
            return within(seconds, lambda: ask(client))
        except httpx2.TimeoutException as error:
            raise TimeoutError from error
        except httpx2.ConnectError as error:
            raise ConnectionError(
                f"cannot be reached: {one_line(error)}; is it running?"
            ) from error
        except httpx2.HTTPError as error:
            raise ConnectionError(f"broke off: {one_line(error)}") from error
        except httpx2.InvalidURL as error:
            raise ValueError(f"cannot be asked: {error}") from error


def checked_address(
    what: str, address: str, example: str, *, whole: bool = False
) -> str:
    """Return a server's address if it is one.

    Args:
        what: What a message begins with.
        address: What a user gave.
        example: Of what is expected.
        whole: Whether nothing will be added to it, so that it may have a query.

    Raises:
        SettingsError: It is none.
    """
    try:
        parts = urlsplit(address)
        good = parts.scheme in {"http", "https"} and parts.hostname and parts.port != 0
        good = good and (whole or not (parts.query or parts.fragment))
    except ValueError:
        good = False
    if not good:
        raise SettingsError(
            f"{what}: expected an address such as {example}, got {address!r}"
        )
    return address


def one_line(error: BaseException) -> str:
    """Return what an error says, in a line that fits a message."""
    return " ".join(str(error).split())[:300] or type(error).__name__
