"""With default rates the texts have the counts of the paper's Table I."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import SettingsError
from memorymaze.texts.corpus.published import published_tables
from memorymaze.texts.corpus.statistics import describe_corpus
from memorymaze.texts.writing import (
    ErrorRates,
    cells_of,
    parse_rates,
    sample_outlines,
    write_texts,
)
from memorymaze.texts.writing.sampling import stratified, wanted_lengths
from memorymaze.world.sites import Site

SAMPLE = 40


@pytest.mark.parametrize(
    ("study", "site", "route", "iteration"),
    [
        ("online", "museum_5f", "R1", 1),
        ("onsite", "museum_5f", "R2", 1),
        ("onsite", "museum_7f", "R2", 2),
        ("onsite", "university", "R2", 1),
    ],
)
def test_a_sample_of_a_cell_has_the_rates_and_lengths_of_table_one(
    builtin_sites: dict[str, Site], study: str, site: str, route: str, iteration: int
) -> None:
    (cell,) = [
        each
        for each in cells_of(builtin_sites[site], route=route)
        if (each.study, each.iteration) == (study, iteration)
    ]
    (paper,) = [
        each
        for each in published_tables().descriptions
        if (each.study, each.site, each.route, each.iteration)
        == (study, site, route, iteration)
    ]
    made = [
        text
        for outline in sample_outlines(cell, ErrorRates(), SAMPLE, 0)
        for text in write_texts(outline, paired=False)
    ]
    (found,) = describe_corpus(made, builtin_sites)
    assert found.failure_rate == pytest.approx(paper.failure_rate, abs=0.03)
    alternative = paper.alternative_rate or 0.0
    assert found.alternative_rate == pytest.approx(alternative, abs=0.03)
    assert found.words_mean == pytest.approx(paper.words_mean, rel=0.06)
    assert found.words_sd == pytest.approx(paper.words_sd, rel=0.2)


@given(mean=st.floats(30, 200), share=st.floats(0.2, 0.6), seed=st.integers(0, 2**32))
def test_wanted_lengths_have_their_mean_and_deviation(
    mean: float, share: float, seed: int
) -> None:
    drawn = wanted_lengths(mean, share * mean, 20, 500, np.random.default_rng(seed))
    assert drawn.mean() == pytest.approx(mean, rel=0.03)
    assert drawn.std() == pytest.approx(share * mean, rel=0.12)


@given(count=st.integers(1, 200), seed=st.integers(0, 2**32))
def test_strata_keep_shares_to_one_part(count: int, seed: int) -> None:
    levels = stratified(count, np.random.default_rng(seed))
    assert abs((levels < 0.3).sum() - 0.3 * count) <= 1


def test_a_route_that_the_paper_does_not_have_gets_mean_rates(t_site: Site) -> None:
    cells = cells_of(t_site, studies=["onsite"], iterations=[1])
    made = [list(sample_outlines(cell, ErrorRates(), 20, 0)) for cell in cells]
    for cell in made:
        assert sum(bool(outline.mistakes) for outline in cell) == 10  # 48.9 % of 20
        assert not any(outline.alternative for outline in cell)


def test_no_errors_means_none(t_site: Site) -> None:
    for cell in cells_of(t_site):
        assert not any(
            d.mistakes for d in sample_outlines(cell, parse_rates("none"), 5, 0)
        )


@pytest.mark.parametrize(
    "text",
    ["lots", "missing_turn", "missing_turn=2", "missing_turn=nan", "bear=0.1", "", "="],
)
def test_rates_without_meaning_are_refused_with_what_is_allowed(text: str) -> None:
    with pytest.raises(SettingsError, match="--errors: expected"):
        parse_rates(text)


@pytest.mark.parametrize(
    "text", ["failure=0.5,missing_turn=0.1", "missing_turn=0.1,missing-turn=0.2"]
)
def test_contradicting_rates_are_refused(text: str) -> None:
    with pytest.raises(SettingsError, match="got"):
        parse_rates(text)
