from dataclasses import fields, replace

import numpy as np
import pytest
from benchmarks.fit import (
    FITTED,
    Case,
    Cases,
    Linear,
    comparison_row,
    fit,
    left_out_rows,
    linear_about,
    model_of,
    vector_of,
)

from memorymaze.agents.guide.likelihoods import Likelihoods
from memorymaze.instructions import Corpus
from memorymaze.routes import Arrival, Leg, RoutePlan, Turn


@pytest.fixture(scope="module")
def case(tiny_corpus: Corpus) -> Case:
    episode, route = next(
        (each, route)
        for each in tiny_corpus.episodes
        if (
            route := tiny_corpus.sites[each.instruction.site].route(
                each.instruction.reference_route
            )
        ).turns
    )
    legs = tuple(Leg(Turn(each.direction)) for each in route.turns)  # type: ignore[arg-type]
    plan = RoutePlan(legs=legs, arrival=Arrival(at_end=True))
    return Cases(tiny_corpus.sites, 4.0).case(episode, plan, 3.0)


def test_there_are_at_most_thirty_parameters() -> None:
    assert len(fields(Likelihoods)) <= 30


def test_parameters_come_back_from_their_vector() -> None:
    model = model_of(vector_of(Likelihoods()))
    for name in FITTED:
        assert getattr(model, name) == pytest.approx(getattr(Likelihoods(), name))


def test_a_fit_goes_where_the_texts_are_likelier_and_not_far() -> None:
    slopes = np.zeros((50, len(FITTED)))
    slopes[:, 0], slopes[:, 1] = 1.0, -1.0
    about = vector_of(Likelihoods())
    linear = Linear(about, 0.5, np.zeros(50), slopes)
    moved = linear.best(np.arange(50), about) - about
    assert moved[0] == pytest.approx(0.5)
    assert moved[1] == pytest.approx(-0.5)
    assert moved[2:] == pytest.approx(np.zeros(len(FITTED) - 2))


def test_a_parameter_that_says_nothing_of_a_text_has_no_slope(case: Case) -> None:
    linear = linear_about([case], vector_of(Likelihoods()), 1.0)
    assert linear.slopes[0, FITTED.index("side_right")] == pytest.approx(0.0)


def test_values_are_compared_by_what_they_give_the_goal(case: Case) -> None:
    row = comparison_row("all", "tiny", [case], replace(Likelihoods(), wrong_side=0.5))
    assert row["first_by_hand"] == 1.0
    assert float(str(row["log_by_hand"])) > float(str(row["log_fitted"]))


def test_texts_are_judged_by_values_fitted_without_them(case: Case) -> None:
    other = replace(case, writer="somebody else", site="another map")
    rows = list(left_out_rows([case, other], fit([case, other])))
    told = {str(row["name"]): row for row in rows}
    assert f"{case.writer} ({case.half})" in told
    assert {"another map", case.site} <= set(told)
    pooled = [row for row in rows if row["name"] == "all"]
    assert [row["n"] for row in pooled] == [2, 2]
    assert all(row["first_fitted"] == 1.0 for row in pooled)
