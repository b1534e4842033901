"""A client for servers that speak OpenAI's chat-completions protocol."""

import os
import time
from collections.abc import Iterator
from typing import Any, Literal, NoReturn
from urllib.parse import urlsplit

import httpx2
import openai

from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.language.batch_files import content_of
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    Usage,
    why_unusable,
)

LONGEST_ANSWER = 8 * 2**20
"""Bytes of an answer beyond which it is taken for garbage."""
_DEADLINE = "memorymaze_deadline"


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

        Args:
            model: The server's name for the model.
            base_url: Address up to and including `/v1`; else MEMORYMAZE_BASE_URL,
                OPENAI_BASE_URL or OpenAI's own.
            api_key: Else MEMORYMAZE_API_KEY or OPENAI_API_KEY; a server of one's own
                needs none.
            timeout: Seconds to wait for the end of a reply.
            retries: Attempts after the first.
            first_delay: Seconds before the second attempt.
            grammar_server: Kind of server, if it shall hold replies to the grammars
                of requests; None asks for free replies.

        Raises:
            SettingsError: OpenAI's own server is meant and there is no key for it, the
                address is none, or an argument has no meaning.
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
        self._client = openai.OpenAI(
            base_url=None if base_url is None else _checked(base_url),
            api_key=api_key or "none",
            timeout=timeout,
            max_retries=0,
            http_client=bounded_client(timeout),
        )

    @property
    def name(self) -> str:
        """The server's name for the model."""
        return self._model

    @property
    def takes_grammar(self) -> bool:
        """Whether replies are held to the grammars of requests."""
        return self._grammar_server is not None

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask the server.

        Raises:
            LanguageModelError: No usable answer came, after all retries.
        """
        attempt = 0
        while True:
            began = time.monotonic()
            try:
                return self._read(self._ask(request), time.monotonic() - began)
            except openai.OpenAIError as error:
                if self._adapt(error):
                    continue
                delay = self._delay(error, attempt)
                if delay is None:
                    self._fail(error, attempt + 1)
            except ValueError as error:
                # The server said it sent JSON and did not.
                raise self._unusable(f"not JSON ({_one_line(error)})") from error
            attempt += 1
            time.sleep(delay)

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
                cause = f"cannot be reached: {_one_line(error.__cause__ or error)}"
            case openai.APIStatusError():
                cause = f"answered {error.status_code}: {_one_line(error)}"
            case _:
                cause = _one_line(error)
        raise LanguageModelError(
            f"language model {self._model} at {self._server} {cause}{tried}"
        ) from error

    def _read(self, answer: Any, latency: float) -> Completion:
        """Return the reply in a server's answer."""
        choices = getattr(answer, "choices", None)
        if not isinstance(choices, list) or not choices:
            raise self._unusable("without a choice in it")
        message = getattr(choices[0], "message", None)
        text: Any = getattr(message, "content", None)
        wrong = why_unusable(
            text,
            getattr(choices[0], "finish_reason", None),
            getattr(message, "refusal", None),
        )
        if wrong is not None:
            raise self._unusable(wrong)
        usage = getattr(answer, "usage", None)
        prompt, completion = (
            _count(getattr(usage, name, None))
            for name in ("prompt_tokens", "completion_tokens")
        )
        model = getattr(answer, "model", None)
        return Completion(
            text=text,
            model=model if isinstance(model, str) and model else self._model,
            usage=Usage(prompt, completion),
            latency=latency,
        )

    def _unusable(self, what: str) -> LanguageModelError:
        return LanguageModelError(
            f"language model {self._model} at {self._server} sent an answer {what}"
        )


def _from_environment(name: str) -> str | None:
    for prefix in ("MEMORYMAZE", "OPENAI"):
        value = os.environ.get(f"{prefix}_{name}")
        if value:
            return value
    return None


def _checked(address: str) -> str:
    """Return a server's address if it is one."""
    try:
        parts = urlsplit(address)
        good = parts.scheme in {"http", "https"} and parts.hostname and parts.port != 0
    except ValueError:
        good = False
    if not good:
        raise SettingsError(
            "language model server: expected an address such as "
            f"http://localhost:8000/v1, got {address!r}"
        )
    return address


def _asked_wait(error: openai.APIStatusError) -> float:
    """Return the seconds a server asks to be left alone."""
    try:
        return max(0.0, float(error.response.headers.get("retry-after", "0")))
    except ValueError:
        return 0.0


def _count(value: object) -> int:
    return value if isinstance(value, int) and value > 0 else 0


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split())[:300] or type(error).__name__


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
