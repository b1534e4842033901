from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from memorymaze.errors import InstructionFileError
from memorymaze.instructions import load_instructions
from memorymaze.instructions.published import published_tables
from memorymaze.instructions.statistics import describe_corpus, word_count
from memorymaze.sites import Site

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
