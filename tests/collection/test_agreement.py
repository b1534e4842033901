from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np
import pytest

from memorymaze.collection.agreement import Agreement, agreement, file_labels
from memorymaze.collection.consensus import consensus, merged
from memorymaze.collection.labels import Label, latest_labels
from memorymaze.errors import LabelFileError
from memorymaze.instructions import Failure, Instruction, load_instructions
from memorymaze.sites import Site

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
