"""Which language model answers, how it is asked, and what that may cost."""

import math
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.basics.options import check_number
from memorymaze.language.models.model import Completion
from memorymaze.language.models.spending import TokenPrice


@dataclass(frozen=True, slots=True)
class InferenceTime:
    """How the simulated clock runs while a model thinks.

    Either by the latency that was measured, or by a profile: the same for every model
    and machine, so that agents can be compared on an equal footing.

    Raises:
        SettingsError: A value has no meaning.
    """

    form: ClassVar[str] = (
        "measured, none, seconds per reply such as 2.5, or start=SECONDS,"
        "prompt=TOKENS_PER_SECOND,reply=TOKENS_PER_SECOND"
    )

    measured: bool = True
    """Whether the latency of each reply counts; recorded replies keep theirs."""
    start_s: float = 0.0
    """Of a profile: seconds of every reply."""
    prompt_rate: float | None = None
    """Of a profile: tokens of the request read per second; None takes no time."""
    reply_rate: float | None = None
    """Of a profile: tokens of the reply written per second; None takes no time."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        rates = [
            rate for rate in (self.prompt_rate, self.reply_rate) if rate is not None
        ]
        good = math.isfinite(self.start_s) and self.start_s >= 0
        if not (good and all(math.isfinite(rate) and rate > 0 for rate in rates)):
            raise SettingsError(
                f"inference_time: expected {self.form}; got start={self.start_s!r}, "
                f"prompt={self.prompt_rate!r}, reply={self.reply_rate!r}"
            )
        if self.measured and (self.start_s or rates):
            raise SettingsError(
                f"inference_time: expected {self.form}; got a latency that is both "
                "measured and given"
            )

    @classmethod
    def parse(cls, text: str) -> "InferenceTime":
        """Read what `inference_time` says.

        Raises:
            ValueError: It says nothing that is understood.
            SettingsError: A number has no meaning.
        """
        if text in {"measured", "none"}:
            return cls(measured=text == "measured")
        if "=" not in text:
            return cls(measured=False, start_s=float(text))
        given = [part.split("=", 1) for part in text.split(",")]
        values = {name.strip(): float(value) for name, value in given}
        if len(values) < len(given) or not values.keys() <= {
            "start",
            "prompt",
            "reply",
        }:
            raise ValueError(text)
        return cls(
            measured=False,
            start_s=values.get("start", 0.0),
            prompt_rate=values.get("prompt"),
            reply_rate=values.get("reply"),
        )

    def __str__(self) -> str:
        """Write it as it is given."""
        if self.measured:
            return "measured"
        rates = (("prompt", self.prompt_rate), ("reply", self.reply_rate))
        parts = [f"{name}={rate:g}" for name, rate in rates if rate is not None]
        if not parts:
            return f"{self.start_s:g}" if self.start_s else "none"
        return ",".join([f"start={self.start_s:g}", *parts])

    @property
    def described(self) -> str:
        """What passes for each reply, in words, for tables."""
        if self.measured:
            return "standing time is the latency that was measured"
        parts = [f"{self.start_s:g} s"] if self.start_s else []
        if self.prompt_rate is not None:
            parts.append(f"1 s per {self.prompt_rate:g} tokens read")
        if self.reply_rate is not None:
            parts.append(f"1 s per {self.reply_rate:g} tokens written")
        if not parts:
            return "standing time is left out: replies take no simulated time"
        return (
            f"standing time per reply is {' + '.join(parts)}, not the latency measured"
        )

    def seconds(self, completion: Completion) -> float:
        """Return how long the robot stands for a reply, simulated seconds.

        Raises:
            LanguageModelError: The profile counts tokens, and the server told none.
        """
        if self.measured:
            return completion.latency
        usage = completion.usage
        pairs = (
            (usage.prompt_tokens, self.prompt_rate),
            (usage.completion_tokens, self.reply_rate),
        )
        passed = self.start_s
        for tokens, rate in pairs:
            if rate is None:
                continue
            if tokens == 0:
                raise LanguageModelError(
                    "inference_time: the profile counts tokens, and the server of "
                    f"{completion.model} told none; give seconds per reply instead"
                )
            passed += tokens / rate
        return passed


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelSettings:
    """Which language model answers, how it is asked, and what that may cost.

    The command line has an option for each field with a `metavar`; all others are given
    with `--with NAME=VALUE`, but for the folder that a run shares.

    Raises:
        SettingsError: A value has no meaning, or a cost is limited that is not known.
    """

    model: str | None = field(default=None, metadata={"metavar": "NAME"})
    """a server's name for it, or gguf:PATH, or smollm2; a name is such as gpt-4o-mini, the
    others run here, and smollm2 comes with the extra [local-llm]"""
    base_url: str | None = field(default=None, metadata={"metavar": "URL"})
    """an OpenAI-compatible server; none for OpenAI's, or OPENAI_BASE_URL"""
    record: str | None = field(default=None, metadata={"metavar": "FILE"})
    """keep the model's answers in a JSONL file, and ask for none that is there"""
    replay: str | None = field(default=None, metadata={"metavar": "FILE"})
    """take answers from a JSONL file; ask no model (docs/language_models.md)"""
    inference_time: InferenceTime = InferenceTime()
    """how long the robot stands for each reply, in simulated time: measured, none,
    SECONDS, or a profile in tokens per second such as start=0.5,prompt=2000,reply=60"""
    price: TokenPrice | None = field(
        default=None, metadata={"metavar": "PROMPT,COMPLETION"}
    )
    """what the server charges; US dollars per million tokens, such as 0.15,0.60"""
    max_cost: float | None = field(default=None, metadata={"metavar": "USD"})
    """end the run when this is spent; needs the price; what is finished is kept, and --resume
    goes on"""
    max_tokens_total: int | None = None
    """end the run when requests and replies have had so many tokens together"""
    max_requests: int | None = None
    """requests under way at once, over all workers; none for one per worker"""
    request_timeout: float = 120.0
    """longest wait for the end of a reply, seconds"""
    retries: int = 4
    """further attempts where a server is busy, fails or is silent"""
    grammar: Literal["llama.cpp", "vllm"] | None = None
    """have the server hold replies to well-formed steps and programs; says which kind of
    server it is: llama.cpp or vllm"""
    shared_folder: str | None = None
    """Where the processes of a run keep what they share: the run's own folder."""
    threads: int | None = None
    """processor cores that a local model uses; none for those that a run's workers have each,
    else half of all"""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_number("request_timeout", self.request_timeout, least=0.001)
        check_number("retries", self.retries, least=0, whole=True)
        if self.max_requests is not None:
            check_number("max_requests", self.max_requests, least=1, whole=True)
        if self.max_tokens_total is not None:
            check_number("max_tokens_total", self.max_tokens_total, least=1, whole=True)
        if self.max_cost is not None:
            check_number("max_cost", self.max_cost, least=0)
        if self.max_cost is not None and self.price is None:
            raise SettingsError(
                "max_cost: what replies cost is not known; give the server's prices "
                "with --price PROMPT,COMPLETION (US dollars per million tokens)"
            )


NOT_COMPARED = frozenset({
    "base_url",
    "record",
    "replay",
    "request_timeout",
    "retries",
    "max_requests",
    "max_cost",
    "max_tokens_total",
    "shared_folder",
    "threads",
})
"""Where answers come from and go to, and how patiently and how long they are asked for,
which does not change what they say."""
