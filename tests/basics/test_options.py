from dataclasses import dataclass
from typing import Any, Literal

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import (
    Option,
    check_number,
    list_options,
    parse_options,
    read_options,
    write_options,
)


@dataclass(frozen=True, slots=True)
class WalkerOptions:
    stride: float = 0.5
    """Metres
    per step."""
    steps: int = 10
    """Most steps."""
    polite: bool = False
    """Whether it greets."""
    budget: Literal["released", "fair"] = "released"
    """Which budget counts."""
    angle: Literal[15, 30] = 15
    """Degrees per turn."""
    angles: tuple[int, ...] = (30, 60)
    """Degrees it can turn by."""
    seed: int | None = None
    """Passed on."""
    greeting: str | None = "hello"
    """What it says."""

    def __post_init__(self) -> None:
        if self.steps < 1:
            raise SettingsError(f"--set steps: expected at least 1, got {self.steps}")


def read(*pairs: tuple[str, str]) -> WalkerOptions:
    return read_options(WalkerOptions, pairs, agent="walker")


def test_nothing_set_gives_the_defaults() -> None:
    assert read() == WalkerOptions()


def test_values_are_read_as_the_fields_types() -> None:
    assert read(
        ("stride", "1"),
        ("steps", "3"),
        ("polite", "true"),
        ("budget", "fair"),
        ("angle", "30"),
        ("angles", "15, 30,45"),
        ("seed", "7"),
        ("greeting", "hey = you"),
    ) == WalkerOptions(1.0, 3, True, "fair", 30, (15, 30, 45), 7, "hey = you")


def test_none_is_none_where_it_is_allowed() -> None:
    assert read(("seed", "none"), ("greeting", "none")) == WalkerOptions(greeting=None)


def test_dashes_stand_for_underscores() -> None:
    @dataclass(frozen=True)
    class Options:
        max_tokens: int = 1
        """Longest reply."""

    assert read_options(Options, [("max-tokens", "2")], agent="a") == Options(2)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        pytest.param("strid", "1", "did you mean 'stride'", id="misspelt"),
        pytest.param("nothing", "1", "has the options stride, steps", id="unknown"),
        pytest.param(
            "stride", "long", "stride: expected a number, got 'long'", id="float"
        ),
        pytest.param("stride", "nan", "expected a number", id="nan"),
        pytest.param("stride", "inf", "expected a number", id="infinite"),
        pytest.param("steps", "1.5", "expected a whole number", id="int"),
        pytest.param("steps", "1_0", "expected a whole number", id="underscore"),
        pytest.param("stride", "٣", "expected a number", id="other digits"),
        pytest.param("steps", "", "expected a whole number, got ''", id="empty"),
        pytest.param("polite", "yes", "expected true or false", id="bool"),
        pytest.param("budget", "free", "expected released or fair", id="word"),
        pytest.param("angle", "20", "expected 15 or 30", id="number of several"),
        pytest.param("angles", "15,x", "a list such as 1,2,3", id="list"),
        pytest.param("seed", "x", "expected a whole number or none", id="optional"),
        pytest.param("steps", "0", "expected at least 1, got 0", id="own check"),
    ],
)
def test_a_value_without_meaning_is_explained(name: str, value: str, said: str) -> None:
    with pytest.raises(SettingsError, match=said):
        read((name, value))


def test_an_option_given_twice_is_refused() -> None:
    with pytest.raises(SettingsError, match="given twice"):
        read(("steps", "1"), ("steps", "2"))


def test_options_are_listed_with_defaults_and_meanings() -> None:
    listed = list_options(WalkerOptions)
    assert listed[0] == Option("stride", "a number", "0.5", "Metres per step.")
    assert [option.default for option in listed] == [
        "0.5", "10", "false", "released", "15", "30,60", "none", "hello",
    ]  # fmt: skip


def test_what_is_listed_as_default_can_be_given() -> None:
    assert read(
        *((each.name, each.default) for each in list_options(WalkerOptions))
    ) == (WalkerOptions())


def test_an_option_without_a_meaning_is_the_programmers_fault() -> None:
    @dataclass(frozen=True)
    class Options:
        silent: int = 1

    with pytest.raises(TypeError, match="a string beneath it"):
        list_options(Options)


def test_settings_are_read_from_one_text_and_written_as_one() -> None:
    text = "stride=2,polite=true,angles=15+30"
    settings = parse_options(WalkerOptions, text, subject="walker setting")

    assert settings == WalkerOptions(stride=2.0, polite=True, angles=(15, 30))
    assert write_options(settings, changed_from=WalkerOptions()) == text
    assert parse_options(WalkerOptions, write_options(settings), subject="") == settings


def test_settings_left_out_of_a_text_stay_as_they_were() -> None:
    start = WalkerOptions(stride=3.0, steps=5)

    read_again = parse_options(WalkerOptions, "steps=7", subject="", start=start)

    assert read_again == WalkerOptions(stride=3.0, steps=7)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("strid=1", "walker setting 'strid=1': .* stride, .* did you mean 'stride'"),
        ("stride", "expected NAME=VALUE"),
        ("stride=long", "walker setting stride: expected a number, got 'long'"),
        ("angles=15+x", r"angles: expected a list such as 1\+2\+3, each a whole"),
        ("stride=1,stride=2", "stride: given twice"),
        ("greeting=hi", "where NAME is one of stride, steps"),
    ],
)
def test_texts_that_are_no_settings_are_refused(text: str, said: str) -> None:
    with pytest.raises(SettingsError, match=said):
        parse_options(
            WalkerOptions,
            text,
            subject="walker setting",
            only=("stride", "steps", "angles"),
        )


@pytest.mark.parametrize(
    ("value", "bounds", "said"),
    [
        (2, {"least": 0, "most": 1}, "share: expected a number from 0 to 1, got 2"),
        (-1, {"least": 0}, "of at least 0"),
        (0, {"above": 0}, "greater than 0, got 0"),
        (3, {"above": 0, "most": 2}, "greater than 0 and at most 2"),
        (float("nan"), {}, "a finite number, got nan"),
        (float("inf"), {"least": 0}, "got inf"),
        (True, {"least": 0}, "got True"),
        (1.5, {"least": 0, "whole": True}, "a whole number of at least 0"),
        ("1", {"least": 0}, "got '1'"),
    ],
)
def test_numbers_without_meaning_are_refused(
    value: object, bounds: dict[str, Any], said: str
) -> None:
    with pytest.raises(SettingsError, match=said):
        check_number("share", value, **bounds)
