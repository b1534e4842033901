from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.texts.corpus.checking import CheckReport, check_instruction_files
from memorymaze.texts.corpus.text_damage import mojibake, text_damage
from memorymaze.world.sites import Site, load_sites

Line = Callable[..., dict[str, Any]]
Check = Callable[..., CheckReport]


@pytest.fixture
def check(
    line: Line, instruction_file: Callable[..., Path], tiny_sites: dict[str, Site]
) -> Check:
    """Check lines that differ from a right one as told."""

    def run(*changes: dict[str, Any]) -> CheckReport:
        lines = [
            line(
                **(
                    {"id": f"a-{n}", "participant": f"p{n}", "text": f"Left {n}."}
                    | each
                )
            )
            for n, each in enumerate(changes)
        ]
        return check_instruction_files([instruction_file(*lines)], tiny_sites)

    return run


def _failure(where: str, kind: str = "extra_turn") -> dict[str, Any]:
    return {"failures": [{"kind": kind, "where": where, "detail": ""}]}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        pytest.param("it\u00e2\u20ac\u2122s left", r"expected '\u2019'", id="mojibake"),
        pytest.param("caf\u00c3\u00a9", "expected 'é'", id="mojibake of Latin-1"),
        pytest.param("turn \ufffd left", "1 replacement character", id="lost"),
        pytest.param("turn\x07 left\x00", "U+0000, U+0007", id="control"),
    ],
)
def test_a_damaged_text_is_an_error(check: Check, text: str, said: str) -> None:
    report = check({"text": text}, {})
    assert report.good == 1
    [error] = report.errors
    assert error.message.startswith("field 'text': expected")
    assert (
        said.encode().decode("unicode_escape") in error.message or said in error.message
    )


@given(st.text(st.characters(codec="cp1252", exclude_categories=["Cc"])))
def test_what_was_read_in_a_wrong_encoding_is_recognised(text: str) -> None:
    garbled = text.encode("utf-8").decode("cp1252", "replace")
    if text.isascii():
        assert text_damage(text) == []
    elif "\ufffd" not in garbled:
        assert mojibake(garbled) is not None


def test_an_instruction_under_two_ids_is_an_error(check: Check) -> None:
    same = {"participant": "p", "text": "Right at the corner."}
    report = check(same, same | {"id": "b"}, same | {"iteration": 2})
    [error] = report.errors
    assert "'b', which is 'a-0'" in error.message
    assert len(report.notes) == 1


def test_a_wrong_text_and_its_right_counterpart_are_no_duplicates(check: Check) -> None:
    pair = {"participant": "p", "pair": "a", "source": "synthetic"}
    assert check(pair, pair | {"text": "LEFT 0"}, pair).notes == ()


def test_equal_and_nearly_equal_texts_are_noted(check: Check) -> None:
    report = check(
        {"text": "Turn left, then stop."}, {"text": "turn left THEN stop"}, {}
    )
    [note] = report.notes
    assert "'a-1' has nearly the same text as 'a-0'" in note.message
    assert (report.good, report.errors) == (3, ())


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        pytest.param(
            {"id": "onl-t_junction-r1-1"}, "names site 't_junction'", id="site"
        ),
        pytest.param({"id": " a"}, "spaces at an end", id="spaces"),
        pytest.param({"id": "A-0"}, "differ in capitals only", id="capitals"),
        pytest.param(
            {"participant": "p0", "study": "onsite"}, "is in study 'onsite'", id="study"
        ),
        pytest.param({"participant": "p0"}, "both of participant 'p0'", id="two texts"),
        pytest.param(
            {"reference_route": "route_r1_alternative"}, "alternative way", id="online"
        ),
        pytest.param(_failure("tp_nx"), "did you mean 'tp_nw'?", id="unknown id"),
        pytest.param(
            _failure("tp_se"), "is not on route_r1_reference", id="off the way"
        ),
        pytest.param(_failure("by the camel"), "names no turning point", id="no place"),
        pytest.param(_failure("tp_nw", "extra turn"), "mean 'extra_turn'?", id="kind"),
        pytest.param({"text": "Turn\u200b left."}, "U+200B", id="invisible"),
        pytest.param({"text": "左に曲がる"}, "are not Latin", id="language"),
    ],
)
def test_what_looks_odd_is_a_note_and_no_error(
    check: Check, changes: dict[str, Any], said: str
) -> None:
    report = check({}, changes)
    assert (report.good, report.errors) == (2, ())
    [note] = report.notes
    assert said in note.message
    assert note.place.endswith(":2")


@pytest.mark.parametrize(
    "where", ["tp_nw", "after tp_sw", "the start", "end of the way"]
)
def test_a_place_of_the_plan_is_no_note(check: Check, where: str) -> None:
    assert check(_failure(where)).notes == ()


def test_the_shipped_corpus_gives_neither_errors_nor_notes() -> None:
    from memorymaze.texts.corpus import BUILTIN_CORPUS

    report = check_instruction_files([BUILTIN_CORPUS], load_sites())
    assert (report.good, report.errors, report.notes) == (564, (), ())
