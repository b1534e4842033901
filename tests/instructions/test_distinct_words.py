import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from memorymaze.instructions.distinct_words import (
    COUNTING_RULES,
    distinct_words,
    type_token_curve,
)

TEXTS = [
    "1. Turn LEFT, then go 20 m.",
    "Don\u2019t turn left \u2013 it's the lift's end!",
]
SOME_TEXTS = st.lists(st.text("ab' ,.", min_size=1), min_size=1, max_size=8)


@pytest.mark.parametrize(
    ("rule", "count"),
    [
        # turn left then go m don't it's the lift's end
        pytest.param("letters", 10, id="letters"),
        pytest.param("as written", 15, id="as written"),
        # with 1 and 20 on top
        pytest.param("bare", 12, id="bare"),
        # don t turn left then go m it s the lift end
        pytest.param("only letters", 12, id="only letters"),
        # turn left go m lift's end
        pytest.param("content", 6, id="content"),
        # turn left go lift end
        pytest.param("cloud", 5, id="cloud"),
        pytest.param("twice", 2, id="twice"),
        pytest.param("three times", 0, id="three times"),
    ],
)
def test_each_counting_rule_counts_as_it_says(rule: str, count: int) -> None:
    [chosen] = [each for each in COUNTING_RULES if each.name == rule]
    assert distinct_words(TEXTS, chosen) == count


@settings(deadline=None)
@given(SOME_TEXTS)
def test_the_order_of_texts_changes_no_count(texts: list[str]) -> None:
    for rule in COUNTING_RULES:
        assert distinct_words(texts, rule) == distinct_words(texts[::-1], rule)
        assert distinct_words(texts * 3, rule) >= distinct_words(texts, rule)


@settings(deadline=None)
@given(SOME_TEXTS)
def test_a_type_token_curve_rises_and_ends_at_all_distinct_words(
    texts: list[str],
) -> None:
    everything = distinct_words(texts)
    if everything == 0:
        with pytest.raises(ValueError, match="at least one word"):
            type_token_curve(texts, np.random.default_rng(0))
        return
    curve = type_token_curve(texts, np.random.default_rng(0))
    assert curve.types[0] == 1.0
    assert curve.types[-1] == pytest.approx(everything)
    assert list(curve.types) == sorted(curve.types)
    assert curve == type_token_curve(texts, np.random.default_rng(0))
