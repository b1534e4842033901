from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from memorymaze.basics.errors import LabelFileError
from memorymaze.texts.corpus import Failure, Instruction, load_instructions
from memorymaze.texts.labels.agreement import (
    Agreement,
    agreement,
    agreement_table,
    cohens_kappa,
    file_labels,
    fleiss_kappa,
)
from memorymaze.texts.labels.consensus import consensus, merged
from memorymaze.texts.labels.labels import Label, latest_labels
from memorymaze.world.sites import Site

Told = Callable[..., Instruction]
MakeLabel = Callable[..., Label]
ALTERNATIVE = "route_r1_alternative"


def _found(
    labels: Iterable[Label], told: list[Instruction], sites: dict[str, Site]
) -> dict[str, Agreement]:
    found = agreement(latest_labels(labels), told, sites, np.random.default_rng(0))
    return {each.question: each for each in found}


def test_the_corpus_and_its_second_reader_agree_as_published(
    builtin_sites: dict[str, Site],
) -> None:
    told = load_instructions()
    by_file = file_labels(told, "writers")
    by_reader = {
        ("reader", name): replace(
            label,
            annotator="reader",
            failures=() if name == "onl-museum_5f-r2-22-2" else label.failures,
        )
        for (_, name), label in by_file.items()
    }
    found = _found([*by_file.values(), *by_reader.values()], told, builtin_sites)
    failing = found["has a failure"]
    assert failing.items == 564
    assert failing.kappa.value == pytest.approx(0.9943, abs=5e-5)
    assert failing.low is not None
    assert 0.97 < failing.low < failing.kappa.value <= (failing.high or 0) <= 1.0
    assert found["alternative way"].kappa.value == 1.0


def test_a_kappa_without_meaning_is_a_dash_that_the_table_explains(
    told: Told, label: MakeLabel, tiny_sites: dict[str, Site]
) -> None:
    instructions = [told(name) for name in "abcd"]
    labels = [label(who, name) for who in ("ada", "bob") for name in "abcd"]
    found = _found(labels, instructions, tiny_sites)
    text = agreement_table(list(found.values()), ["ada", "bob"]).text()
    assert text.startswith("2 annotators: ada, bob\n")
    [row] = [line for line in text.splitlines() if line.startswith("has a failure")]
    assert row.split()[-5:] == ["1", "100.0", "%", "Cohen", "-"]
    assert "everyone always gave the same answer, so kappa is not defined" in text


def test_only_texts_that_all_labelled_count(
    told: Told, label: MakeLabel, tiny_sites: dict[str, Site]
) -> None:
    instructions = [told(name) for name in "abcd"]
    labels = [label(who, name) for who in ("ada", "bob") for name in "abc"]
    labels += [label("ada", "d", "extra_turn"), label("cy", "a"), label("cy", "b")]
    found = _found(labels, instructions, tiny_sites)
    assert found["has a failure"].items == 2
    assert found["has a failure"].statistic == "Fleiss"
    assert found["has a failure"].kappa.value is None


def test_kinds_and_ways_are_compared_too(
    told: Told, label: MakeLabel, tiny_sites: dict[str, Site]
) -> None:
    instructions = [told(name) for name in "abcd"]
    labels = [
        label("ada", "a", "extra_turn", "missing_turn"),
        label("bob", "a", "missing_turn", "extra_turn"),
        label("ada", "b", "extra_turn"),
        label("bob", "b", "missing_turn"),
        label("ada", "c", way=ALTERNATIVE),
        label("bob", "c", way="none"),
        label("ada", "d"),
        label("bob", "d"),
    ]
    found = _found(labels, instructions, tiny_sites)
    assert {name: each.kappa.agreement for name, each in found.items()} == {
        "has a failure": 1.0,
        "kinds of failures": 0.75,
        "alternative way": 1.0,
        "which way": 0.75,
    }


@pytest.mark.parametrize(
    ("who", "said"),
    [
        pytest.param(
            [("ada", "a")], "two annotators or more, got those of ada", id="one"
        ),
        pytest.param(
            [("ada", "a"), ("bob", "b")], "all labelled, got none", id="apart"
        ),
    ],
)
def test_nothing_to_compare_is_an_error(
    told: Told,
    label: MakeLabel,
    tiny_sites: dict[str, Site],
    who: list[tuple[str, str]],
    said: str,
) -> None:
    labels = [label(name, instruction) for name, instruction in who]
    with pytest.raises(LabelFileError, match=said):
        _found(labels, [told("a"), told("b")], tiny_sites)


def test_the_majority_is_merged_and_ties_stay_as_they_were(
    told: Told, label: MakeLabel
) -> None:
    kept = (Failure("wrong_direction", "tp_nw", "as in the file"),)
    instructions = [
        told(name, failures=kept) for name in ("right", "kind", "tie", "new")
    ]
    labels = [
        label("ada", "right"),
        label("bob", "right"),
        label("cy", "right", "extra_turn"),
        label("ada", "kind", "extra_turn", way=ALTERNATIVE),
        label("bob", "kind", "extra_turn", "missing_turn", way=ALTERNATIVE),
        label("cy", "kind", "missing_turn", "extra_turn"),
        label("ada", "tie"),
        label("bob", "tie", "extra_turn", way="none"),
    ]
    agreed = consensus(latest_labels(labels))
    result = {each.id: each for each in merged(instructions, agreed)}
    assert result["right"].failures == ()
    assert result["kind"].failures == (
        Failure("extra_turn", "tp_nw", "by ada"),
        Failure("missing_turn", "tp_nw", "by bob"),
    )
    assert result["kind"].reference_route == ALTERNATIVE
    assert result["tie"] == instructions[2]
    assert result["new"] == instructions[3]
    [tie] = [each for each in agreed if each.open]
    assert tie.open == (
        "way: route_r1_reference (1), none (1)",
        "has a failure: no (1), yes (1)",
    )


def test_kinds_named_equally_often_are_left_open(label: MakeLabel) -> None:
    labels = [label("ada", "a", "extra_turn"), label("bob", "a", "missing_turn")]
    [agreed] = consensus(latest_labels(labels))
    assert agreed.failures is None
    assert agreed.open == ("kind of failure: extra_turn (1), missing_turn (1)",)


FLEISS_1971_STYLE = [
    [0, 0, 0, 0, 14],
    [0, 2, 6, 4, 2],
    [0, 0, 3, 5, 6],
    [0, 3, 9, 2, 0],
    [2, 2, 8, 1, 1],
    [7, 7, 0, 0, 0],
    [3, 2, 6, 3, 0],
    [2, 5, 3, 2, 2],
    [6, 5, 2, 1, 0],
    [0, 2, 2, 3, 7],
]
"""Fourteen raters, ten subjects, five answers: kappa 0.210."""

TABLES = arrays(np.int64, (3, 3), elements=st.integers(0, 9)).filter(lambda t: t.any())


@pytest.mark.parametrize(
    ("table", "kappa"),
    [
        pytest.param([[88, 14, 18], [10, 40, 10], [2, 6, 12]], 0.492, id="Cohen"),
        pytest.param([[45, 15], [25, 15]], 0.1304, id="equal agreement, low"),
        pytest.param([[25, 35], [5, 35]], 0.2593, id="equal agreement, higher"),
        pytest.param([[0, 5], [5, 0]], -1.0, id="never agree"),
        # What the README beside the shipped corpus reports of its second reader.
        pytest.param([[107, 1], [0, 456]], 0.9943, id="second reader"),
    ],
)
def test_cohens_kappa_equals_published_values(
    table: list[list[int]], kappa: float
) -> None:
    assert cohens_kappa(table).value == pytest.approx(kappa, abs=5e-4)


def test_fleiss_kappa_equals_the_published_value() -> None:
    found = fleiss_kappa(FLEISS_1971_STYLE)
    assert found.agreement == pytest.approx(0.378, abs=5e-4)
    assert found.expected == pytest.approx(0.213, abs=5e-4)
    assert found.value == pytest.approx(0.210, abs=5e-4)


@given(TABLES)
def test_kappa_does_not_depend_on_who_is_first_or_how_answers_are_ordered(
    table: np.ndarray,
) -> None:
    kappa = cohens_kappa(table).value
    for same in (table.T, table[::-1, ::-1], 3 * table):
        other = cohens_kappa(same).value
        assert other == (None if kappa is None else pytest.approx(kappa))
    assert kappa is None or kappa <= 1.0


@given(TABLES)
def test_fleiss_kappa_of_two_is_cohens_with_shared_shares(table: np.ndarray) -> None:
    answers = np.array([
        np.eye(3)[i] + np.eye(3)[j]
        for i, j in np.ndindex(3, 3)
        for _ in range(table[i, j])
    ])
    found = fleiss_kappa(answers).value
    shared = cohens_kappa(table + table.T).value
    assert found == (None if shared is None else pytest.approx(shared))


@given(st.integers(1, 20))
def test_full_agreement_is_one_and_undefined_where_nothing_differs(count: int) -> None:
    assert cohens_kappa([[count, 0], [0, 3]]).value == pytest.approx(1.0)
    assert cohens_kappa([[count, 0], [0, 0]]).value is None
    assert fleiss_kappa([[3, 0]] * count).value is None


@pytest.mark.parametrize(
    ("table", "said"),
    [
        pytest.param([[2, 0], [3, 0]], "got 2 to 3", id="other numbers of raters"),
        pytest.param([[1, 0], [0, 1]], "got 1 to 1", id="one rater"),
        pytest.param([[-1, 3]], "numbers >= 0", id="negative"),
        pytest.param([], "two dimensions", id="empty"),
    ],
)
def test_what_has_no_meaning_is_refused(table: list[list[int]], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        fleiss_kappa(table)
