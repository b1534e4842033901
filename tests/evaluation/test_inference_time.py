"""How long the robot stands for a reply, and what users can say about it."""

import pytest

from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.evaluation.inference_time import (
    MEASURED,
    InferenceTime,
    describe_inference_time,
    parse_inference_time,
)
from memorymaze.language.model import Completion, Usage

REPLY = Completion("go", "m", Usage(1000, 60), latency=3.25)


@pytest.mark.parametrize(
    ("text", "seconds", "words"),
    [
        ("measured", 3.25, "the latency that was measured"),
        ("none", 0.0, "left out"),
        ("2.5", 2.5, "2.5 s, not"),
        ("start=0.5,prompt=2000,reply=60", 2.0, "0.5 s + 1 s per 2000 tokens read"),
        ("reply=30", 2.0, "1 s per 30 tokens written"),
        ("prompt=500, start=1", 3.0, "1 s + 1 s per 500 tokens read"),
    ],
)
def test_a_setting_says_how_long_the_robot_stands(
    text: str, seconds: float, words: str
) -> None:
    setting = parse_inference_time(text)
    assert setting.seconds(REPLY) == pytest.approx(seconds)
    assert words in describe_inference_time(setting)


def test_the_default_is_what_was_measured() -> None:
    assert parse_inference_time("measured") == MEASURED == InferenceTime()


@pytest.mark.parametrize(
    "text",
    ["", "fast", "-1", "nan", "inf", "reply=0", "speed=3", "reply=5,reply=6", "start="],
)
def test_what_is_not_understood_is_explained(text: str) -> None:
    with pytest.raises(SettingsError, match=r"--inference-time: expected measured, no"):
        parse_inference_time(text)


def test_a_profile_of_tokens_needs_a_server_that_counts_them() -> None:
    silent = Completion("go", "m", Usage(), latency=1.0)
    assert parse_inference_time("2").seconds(silent) == 2
    with pytest.raises(LanguageModelError, match="the server of m told none"):
        parse_inference_time("prompt=500").seconds(silent)
