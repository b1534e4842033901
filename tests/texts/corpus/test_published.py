from statistics import fmean

import pytest

from memorymaze.texts.corpus.published import published_tables


def test_tables_two_and_three_have_every_cell_of_the_paper() -> None:
    tables = published_tables()
    assert len(tables.models) == 6 * 4 * 2
    assert len(tables.iterations) == 6 * 2 * 2
    assert {row.site for row in tables.models} == {
        "university",
        "museum_5f",
        "museum_7f",
    }


@pytest.mark.parametrize(("study", "rate"), [("online", 0.113), ("onsite", 0.082)])
def test_the_papers_best_mean_success_over_routes(study: str, rate: float) -> None:
    rows = [
        row.sr
        for row in published_tables().models
        if (row.method, row.parser, row.study) == ("proposed", True, study)
    ]
    assert fmean(rows) == pytest.approx(rate, abs=5e-4)
