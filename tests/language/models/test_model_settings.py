"""Which model answers, what it may cost, and how long the robot stands for a reply."""

from typing import Any

import pytest

from memorymaze.basics.errors import LanguageModelError, SettingsError
from memorymaze.basics.options import list_options, read_value
from memorymaze.language.models.building import build_language_model
from memorymaze.language.models.model import Completion, Usage
from memorymaze.language.models.model_settings import (
    InferenceTime,
    ModelSettings,
)
from memorymaze.runs.episodes.named_settings import model_settings, named_in_python


def inference_time(text: str) -> InferenceTime:
    return read_value(ModelSettings, "inference_time", text, "inference_time")


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
    setting = inference_time(text)
    assert setting.seconds(REPLY) == pytest.approx(seconds)
    assert words in setting.described


def test_the_default_is_what_was_measured() -> None:
    assert (
        ModelSettings().inference_time == InferenceTime() == inference_time("measured")
    )


@pytest.mark.parametrize("text", ["measured", "none", "2.5", "start=0.5,reply=60"])
def test_a_setting_is_written_as_it_was_given(text: str) -> None:
    assert str(inference_time(text)) == text


@pytest.mark.parametrize(
    "text",
    ["", "fast", "-1", "nan", "inf", "reply=0", "speed=3", "reply=5,reply=6", "start="],
)
def test_what_is_not_understood_is_explained(text: str) -> None:
    with pytest.raises(SettingsError, match=r"inference_time: expected measured, no"):
        inference_time(text)


def test_a_profile_of_tokens_needs_a_server_that_counts_them() -> None:
    silent = Completion("go", "m", Usage(), latency=1.0)
    assert inference_time("2").seconds(silent) == 2
    with pytest.raises(LanguageModelError, match="the server of m told none"):
        inference_time("prompt=500").seconds(silent)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        pytest.param({}, "name a language model with --model", id="no model"),
        pytest.param(
            {"replay": "x", "record": "y"}, "--replay and --record", id="both"
        ),
        pytest.param({"replay": "none"}, "no recorded replies", id="no file"),
        pytest.param({"model": "m", "base_url": "x"}, "expected an address", id="url"),
    ],
)
def test_settings_that_make_no_model_are_explained(
    options: dict[str, str], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        build_language_model(ModelSettings(**options))


def test_a_key_is_asked_for_only_by_openais_own_server(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for prefix in ("MEMORYMAZE", "OPENAI"):
        for name in ("API_KEY", "BASE_URL"):
            monkeypatch.delenv(f"{prefix}_{name}", raising=False)
    with pytest.raises(SettingsError, match="no key for the language model"):
        build_language_model(ModelSettings(model="m"))
    address = "http://localhost:1/v1"
    model = build_language_model(ModelSettings(model="m", base_url=address))
    assert model.name == "m"


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"max_cost": 1.0}, "max_cost: what replies cost is not known"),
        ({"request_timeout": 0.0}, "request_timeout: expected a number of at least"),
        ({"retries": -1}, "retries: expected a whole number of at least 0"),
        ({"max_requests": 0}, "max_requests: expected a whole number of"),
        ({"max_tokens_total": 0}, "max_tokens_total: expected a whole number of"),
    ],
)
def test_limits_without_meaning_are_explained(
    options: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        ModelSettings(**options)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        *(
            ({"price": text}, "setting price: expected PROMPT,COMPLETION in US dollars")
            for text in ("", "1", "1,", "1,two", "1,2,3")
        ),
        *(
            (
                {"price": text},
                "price: expected US dollars per million tokens, at least 0",
            )
            for text in ("-1,2", "nan,1", "1,inf")
        ),
        ({"max_cost": "much"}, "max_cost: expected a number or none, got 'much'"),
        ({"grammar": "x"}, "grammar: expected llama.cpp or vllm or none, got 'x'"),
    ],
)
def test_what_an_option_does_not_take_is_explained(
    given: dict[str, str], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        model_settings(named_in_python(given))


def test_every_option_says_what_it_does() -> None:
    assert all(each.meaning for each in list_options(ModelSettings))
