from collections.abc import Callable
from typing import Any

import pytest

Memorymaze = Callable[..., Any]


def test_all_agents_are_listed_with_what_they_need(memorymaze: Memorymaze) -> None:
    said = memorymaze("agents")
    assert (said.code, said.err) == (0, "")
    for name in ("code_generation", "guide", "oracle", "stop"):
        assert f"{name}: " in said.out
    assert "needs a language model" in said.out


def test_one_agent_is_listed_with_its_options(memorymaze: Memorymaze) -> None:
    said = memorymaze("agents", "code_generation")
    assert "guide: " not in said.out
    assert "  --set stages=two\n" in said.out
    assert "Takes two or single." in said.out
    assert "  --set repair=false\n" in said.out


def test_help_says_where_the_options_are_listed(memorymaze: Memorymaze) -> None:
    assert "see `memorymaze agents NAME`" in " ".join(
        memorymaze("evaluate", "--help").out.split()
    )


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["agents", "guid"], "did you mean 'guide'"),
        (["evaluate", "--agent", "stop", "--set", "x"], "expected NAME=VALUE, got 'x'"),
        (["evaluate", "--agent", "stop", "--set", "x=1"], "has no options to set"),
        (
            ["evaluate", "--agent", "code_generation", "--set", "stage=single"],
            "did you mean 'stages'",
        ),
    ],
)
def test_wrong_options_are_wrong_usage(
    memorymaze: Memorymaze, arguments: list[str], said: str
) -> None:
    answer = memorymaze(*arguments)
    assert (answer.code, answer.out) == (2, "")
    assert said in answer.err
