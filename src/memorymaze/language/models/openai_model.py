"""A client for servers that speak OpenAI's chat-completions protocol."""

import os
import time
from collections.abc import Iterator
from functools import partial
from typing import Any, Literal, NoReturn

import httpx2
import openai

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.basics.server_calls import checked_address, one_line, within
from memorymaze.language.models.batch_files import content_of
from memorymaze.language.models.model import (
    MOST_TOKENS,
    Completion,
    CompletionRequest,
    UnusableReplyError,
    Usage,
    why_unusable,
)

LONGEST_ANSWER = 8 * 2**20
"""Bytes of an answer beyond which it is taken for garbage."""
LONGEST_DELAY = 60.0
"""Seconds that are waited at most before an attempt."""

_WORTH_ANOTHER_TRY = frozenset({408, 409, 429})


class OpenAIModel:
    """A language model behind an OpenAI-compatible server.

    A full or failing server (408, 409, 429, 5xx), a lost connection and a time-out
    are tried again, each time after twice the wait, or after the wait the server asks
    for.
    """

    def __init__(
        self,
        model: str,
        *,
        base_url: str | None = None,
        api_key: str | None = None,
        timeout: float = 120.0,
        retries: int = 4,
        first_delay: float = 1.0,
        grammar_server: Literal["llama.cpp", "vllm"] | None = None,
    ) -> None:
        """Prepare a client; nothing is sent yet.

        What is not given is taken from MEMORYMAZE_BASE_URL or OPENAI_BASE_URL, and from
        MEMORYMAZE_API_KEY or OPENAI_API_KEY; a server of one's own needs no key. Only a
        `grammar_server` is asked to hold replies to the grammars of requests.
        """
        if not model:
            raise SettingsError("model: expected the name of a language model, got ''")
        if timeout <= 0 or retries < 0 or first_delay < 0:
            raise SettingsError(
                "expected timeout > 0 s, retries >= 0 and first_delay >= 0 s, got "
                f"{timeout:g}, {retries} and {first_delay:g}"
            )
        base_url = base_url or _from_environment("BASE_URL")
        api_key = api_key or _from_environment("API_KEY")
        if api_key is None and base_url is None:
            raise SettingsError(
                "no key for the language model: set MEMORYMAZE_API_KEY or "
                "OPENAI_API_KEY, or give the address of a server that needs none"
            )
        self._model = model
        self._retries = retries
        self._first_delay = first_delay
        self._grammar_server = grammar_server
        self._limit_name = "max_tokens"
        self._server = base_url or "OpenAI"
        self._timeout = timeout
        if base_url is not None:
            checked_address(
                "language model server", base_url, "http://localhost:8000/v1"
            )
        self._connect = partial(
            openai.OpenAI,
            base_url=base_url,
            api_key=api_key or "none",
            timeout=timeout,
            max_retries=0,
        )
        self._client = self._connect(http_client=_client(timeout))

    @property
    def name(self) -> str:
        """The server's name for the model."""
        return self._model

    @property
    def _who(self) -> str:
        return f"language model {self._model} at {self._server}"

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask the server."""
        attempt = 0
        while True:
            began = time.monotonic()
            try:
                answer = self._ask_in_time(request)
                return self._read(answer, time.monotonic() - began)
            except openai.OpenAIError as error:
                if self._adapt(error):
                    continue
                delay = self._delay(error, attempt)
                if delay is None:
                    self._fail(error, attempt + 1)
            except (ValueError, RecursionError) as error:
                # The server said it sent JSON and did not.
                raise self._unusable(
                    f"not JSON ({one_line(error)})", Usage()
                ) from error
            attempt += 1
            time.sleep(delay)

    def _ask_in_time(self, request: CompletionRequest) -> Any:
        try:
            return within(self._timeout, partial(self._ask, request))
        except TimeoutError as error:
            self._client.close()
            self._client = self._connect(http_client=_client(self._timeout))
            asked = httpx2.Request("POST", self._client.base_url)
            raise openai.APITimeoutError(asked) from error
        except LanguageModelError as error:
            raise LanguageModelError(f"{self._who} {error}") from error

    def _ask(self, request: CompletionRequest) -> Any:
        optional: dict[str, Any] = {self._limit_name: request.max_tokens}
        if request.seed is not None:
            optional["seed"] = request.seed
        if request.grammar is not None and self._grammar_server is not None:
            grammar: dict[str, Any] = {"grammar": request.grammar}
            if self._grammar_server == "vllm":
                grammar = {"structured_outputs": grammar}
            optional["extra_body"] = grammar
        create: Any = self._client.chat.completions.create
        return create(
            model=self._model,
            messages=[
                {"role": message.role, "content": content_of(message)}
                for message in request.messages
            ],
            temperature=request.temperature,
            **optional,
        )

    def _adapt(self, error: openai.OpenAIError) -> bool:
        """Whether asking otherwise helps: newer models renamed the length limit."""
        renamed = "max_completion_tokens"
        if (
            isinstance(error, openai.BadRequestError)
            and renamed in str(error)
            and self._limit_name != renamed
        ):
            self._limit_name = renamed
            return True
        return False

    def _delay(self, error: openai.OpenAIError, attempt: int) -> float | None:
        """Return the seconds to wait before another attempt; None for no more."""
        if attempt >= self._retries:
            return None
        delay = self._first_delay * 2**attempt
        if isinstance(error, openai.APIStatusError):
            retryable = (
                error.status_code in _WORTH_ANOTHER_TRY or error.status_code >= 500
            )
            if not retryable or error.code == "insufficient_quota":
                return None
            delay = max(delay, _asked_wait(error))
        elif not isinstance(error, openai.APIConnectionError):
            return None
        return min(delay, LONGEST_DELAY)

    def _fail(self, error: openai.OpenAIError, attempts: int) -> NoReturn:
        tried = f" ({attempts} attempts)" if attempts > 1 else ""
        match error:
            case openai.APITimeoutError():
                cause = "did not answer in time"
            case openai.APIConnectionError():
                cause = f"cannot be reached: {one_line(error.__cause__ or error)}"
            case openai.APIStatusError():
                cause = f"answered {error.status_code}: {one_line(error)}"
            case _:
                cause = one_line(error)
        raise LanguageModelError(f"{self._who} {cause}{tried}") from error

    def _read(self, answer: Any, latency: float) -> Completion:
        """Return the reply in a server's answer."""
        # First, since an answer without a reply has its price too.
        usage = self._usage(getattr(answer, "usage", None))
        choices = getattr(answer, "choices", None)
        if not isinstance(choices, list) or not choices:
            raise self._unusable("without a choice in it", usage)
        message = getattr(choices[0], "message", None)
        text: Any = getattr(message, "content", None)
        wrong = why_unusable(
            text,
            getattr(choices[0], "finish_reason", None),
            getattr(message, "refusal", None),
        )
        if wrong is not None:
            raise self._unusable(wrong, usage)
        model = getattr(answer, "model", None)
        return Completion(
            text=text,
            model=model if isinstance(model, str) and model else self._model,
            usage=usage,
            latency=latency,
        )

    def _unusable(self, what: str, usage: Usage) -> UnusableReplyError:
        return UnusableReplyError(f"{self._who} sent an answer {what}", usage)

    def _usage(self, told: Any) -> Usage:
        prompt, completion = (
            self._count(told, name) for name in ("prompt_tokens", "completion_tokens")
        )
        return Usage(prompt, completion)

    def _count(self, told: Any, name: str) -> int:
        """Return how many tokens a server counts; 0 where it does not tell."""
        count = getattr(told, name, None)
        if count is None:
            return 0
        if type(count) is not int or not 0 <= count <= MOST_TOKENS:
            raise self._unusable(f"that counts {count!r:.30} {name}", Usage())
        return count


def _from_environment(name: str) -> str | None:
    for prefix in ("MEMORYMAZE", "OPENAI"):
        value = os.environ.get(f"{prefix}_{name}")
        if value:
            return value
    return None


def _asked_wait(error: openai.APIStatusError) -> float:
    """Return the seconds a server asks to be left alone."""
    try:
        return max(0.0, float(error.response.headers.get("retry-after", "0")))
    except ValueError:
        return 0.0


def _client(timeout: float) -> httpx2.Client:
    """Make a client whose answers are not compressed and not longer than allowed."""

    def bound(response: httpx2.Response) -> None:
        kind = response.headers.get("content-encoding", "identity")
        if kind != "identity":
            raise LanguageModelError(
                f"sent an answer that is compressed ({kind}), which was not asked for"
            )
        if isinstance(response.stream, httpx2.SyncByteStream):
            response.stream = _BoundedStream(response.stream)

    return openai.DefaultHttpxClient(
        timeout=timeout,
        headers={"accept-encoding": "identity"},
        event_hooks={"response": [bound]},
    )


class _BoundedStream(httpx2.SyncByteStream):
    """The bytes of an answer, until there are too many."""

    def __init__(self, stream: httpx2.SyncByteStream) -> None:
        self._stream = stream

    def __iter__(self) -> Iterator[bytes]:
        came = 0
        for part in self._stream:
            came += len(part)
            if came > LONGEST_ANSWER:
                raise LanguageModelError(
                    f"sent an answer of more than {LONGEST_ANSWER} bytes"
                )
            yield part

    def close(self) -> None:
        self._stream.close()
