"""Calls to servers that end, however a server answers, and the addresses of servers."""

from collections.abc import Callable
from concurrent.futures import Future
from threading import Thread
from typing import TypeVar
from urllib.parse import urlsplit

from memorymaze.basics.errors import SettingsError

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


def checked_address(what: str, address: str, example: str) -> str:
    """Return a server's address if it is one.

    Args:
        what: What a message begins with.
        address: What a user gave.
        example: Of what is expected.

    Raises:
        SettingsError: It is none.
    """
    try:
        parts = urlsplit(address)
        good = parts.scheme in {"http", "https"} and parts.hostname and parts.port != 0
        good = good and not (parts.query or parts.fragment)
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
