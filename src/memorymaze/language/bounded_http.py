"""An HTTP client whose answers end: after some time and some bytes, however they come.

Ordinary time-outs are for each part of an answer, so that a server that sends a byte
now and then, for ever, would hold up a run.
"""

import time
from collections.abc import Iterator

import httpx2
import openai

from memorymaze.errors import LanguageModelError

LONGEST_ANSWER = 8 * 2**20
"""Bytes of an answer beyond which it is taken for garbage."""

_DEADLINE = "memorymaze_deadline"


def bounded_client(timeout: float) -> httpx2.Client:
    """Make a client for the OpenAI library.

    Args:
        timeout: Seconds from a request to the end of its answer, at most. Later the
            client raises what it raises when nothing comes at all.
    """

    def begin(request: httpx2.Request) -> None:
        request.extensions = {
            **request.extensions,
            _DEADLINE: time.monotonic() + timeout,
        }

    def bound(response: httpx2.Response) -> None:
        if isinstance(response.stream, httpx2.SyncByteStream):
            response.stream = _BoundedStream(response.stream, response.request)

    return openai.DefaultHttpxClient(
        timeout=timeout, event_hooks={"request": [begin], "response": [bound]}
    )


class _BoundedStream(httpx2.SyncByteStream):
    """The bytes of an answer, until it takes too long or gets too long."""

    def __init__(self, stream: httpx2.SyncByteStream, request: httpx2.Request) -> None:
        self._stream = stream
        self._request = request

    def __iter__(self) -> Iterator[bytes]:
        deadline: float = self._request.extensions[_DEADLINE]
        came = 0
        for part in self._stream:
            came += len(part)
            if came > LONGEST_ANSWER:
                raise LanguageModelError(
                    f"the language model's server at {self._request.url} sent more than "
                    f"{LONGEST_ANSWER} bytes in one answer"
                )
            if time.monotonic() > deadline:
                raise httpx2.ReadTimeout(
                    "the answer does not end", request=self._request
                )
            yield part

    def close(self) -> None:
        self._stream.close()
