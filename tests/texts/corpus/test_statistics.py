from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus import load_instructions
from memorymaze.texts.corpus.published import published_tables
from memorymaze.texts.corpus.statistics import (
    COUNTING_RULES,
    describe_corpus,
    distinct_words,
    type_token_curve,
    word_count,
)
from memorymaze.world.sites import Site

Line = Callable[..., dict[str, Any]]
Write = Callable[..., Path]


@pytest.mark.parametrize(
    ("text", "count"),
    [
        pytest.param("Turn left.", 2, id="plain"),
        pytest.param("1. Turn left.\n2. Go 20 m - then stop", 7, id="list"),
        pytest.param("it's well-lit", 2, id="joined words"),
    ],
)
def test_words_are_what_spaces_separate_without_list_marks(
    text: str, count: int
) -> None:
    assert word_count(text) == count


def test_a_cells_numbers_equal_those_worked_by_hand(
    line: Line, instruction_file: Write, tiny_sites: dict[str, Site]
) -> None:
    alternative = next(r for r in tiny_sites["loop"].routes if r.role == "alternative")
    wrong = {"kind": "extra_turn", "where": "tp", "detail": ""}
    path = instruction_file(
        line(id="a", text="one two"),
        line(id="b", text="one two three four", failures=[wrong]),
        line(id="c", text="one two three", reference_route=alternative.id),
        line(id="d", text="one two three seven eight nine ten", failures=[wrong]),
    )
    [cell] = describe_corpus(load_instructions([path]), tiny_sites)
    assert (cell.instructions, cell.words_mean, cell.words_median) == (4, 4.0, 3.5)
    assert cell.words_sd == pytest.approx((14 / 4) ** 0.5)
    assert (cell.failure_rate, cell.alternative_rate) == (0.5, 0.25)


def test_no_instructions_are_an_error(tiny_sites: dict[str, Site]) -> None:
    with pytest.raises(InstructionFileError, match="no instructions"):
        describe_corpus([], tiny_sites)


def test_the_shipped_corpus_follows_the_published_table_cell_by_cell(
    builtin_sites: dict[str, Site],
) -> None:
    cells = {
        (cell.study, cell.site, cell.route, cell.iteration): cell
        for cell in describe_corpus(load_instructions(), builtin_sites)
    }
    published = published_tables().descriptions
    assert len(cells) == len(published) == 24
    for row in published:
        cell = cells[row.study, row.site, row.route, row.iteration]
        assert cell.words_mean == pytest.approx(row.words_mean, rel=0.05)
        assert cell.words_median == pytest.approx(row.words_median, rel=0.1)
        assert cell.words_sd == pytest.approx(row.words_sd, rel=0.1)
        assert cell.failure_rate == pytest.approx(row.failure_rate, abs=1e-3)
        if row.alternative_rate is not None:
            assert cell.alternative_rate == pytest.approx(
                row.alternative_rate, abs=5e-3
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


@given(SOME_TEXTS)
def test_the_order_of_texts_changes_no_count(texts: list[str]) -> None:
    for rule in COUNTING_RULES:
        assert distinct_words(texts, rule) == distinct_words(texts[::-1], rule)
        assert distinct_words(texts * 3, rule) >= distinct_words(texts, rule)


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
