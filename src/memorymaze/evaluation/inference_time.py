"""How long the robot stands while a language model thinks, in simulated seconds."""

import math
from dataclasses import dataclass

from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.language.model import Completion

EXPECTED = (
    "--inference-time: expected measured, none, seconds per reply such as 2.5, or "
    "start=SECONDS,prompt=TOKENS_PER_SECOND,reply=TOKENS_PER_SECOND"
)


@dataclass(frozen=True, slots=True)
class InferenceTime:
    """How the simulated clock runs while a model thinks.

    Either by the latency that was measured, or by a profile: the same for every model
    and machine, so that agents can be compared on an equal footing.

    Raises:
        SettingsError: A value has no meaning.
    """

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
                f"{EXPECTED}; got start={self.start_s!r}, prompt={self.prompt_rate!r}, "
                f"reply={self.reply_rate!r}"
            )
        if self.measured and (self.start_s or rates):
            raise SettingsError(
                f"{EXPECTED}; got a latency that is both measured and given"
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
                    "--inference-time: the profile counts tokens, and the server of "
                    f"{completion.model} told none; give seconds per reply instead"
                )
            passed += tokens / rate
        return passed


MEASURED = InferenceTime()
"""The latency of each reply, as it was measured."""


def parse_inference_time(text: str) -> InferenceTime:
    """Read what `--inference-time` says.

    Raises:
        SettingsError: It says nothing that is understood; the message says what is.
    """
    if text == "measured":
        return MEASURED
    if text == "none":
        return InferenceTime(measured=False)
    try:
        if "=" not in text:
            return InferenceTime(measured=False, start_s=float(text))
        given = [part.split("=", 1) for part in text.split(",")]
        values = {name.strip(): float(value) for name, value in given}
    except ValueError:
        raise SettingsError(f"{EXPECTED}; got {text!r}") from None
    if len(values) < len(given) or not values.keys() <= {"start", "prompt", "reply"}:
        raise SettingsError(f"{EXPECTED}; got {text!r}")
    return InferenceTime(
        measured=False,
        start_s=values.get("start", 0.0),
        prompt_rate=values.get("prompt"),
        reply_rate=values.get("reply"),
    )


def describe_inference_time(setting: InferenceTime) -> str:
    """Say in words what a run let pass for each reply, for tables."""
    if setting.measured:
        return "standing time is the latency that was measured"
    parts = [f"{setting.start_s:g} s"] if setting.start_s else []
    if setting.prompt_rate is not None:
        parts.append(f"1 s per {setting.prompt_rate:g} tokens read")
    if setting.reply_rate is not None:
        parts.append(f"1 s per {setting.reply_rate:g} tokens written")
    if not parts:
        return "standing time is left out: replies take no simulated time"
    return f"standing time per reply is {' + '.join(parts)}, not the latency measured"
