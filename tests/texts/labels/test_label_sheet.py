import csv
from collections.abc import Callable
from pathlib import Path

import pytest

from memorymaze.basics.errors import LabelFileError, LabelFileWarning
from memorymaze.texts.corpus import Failure, Instruction
from memorymaze.texts.labels.label_sheet import read_label_sheet, write_label_sheet
from memorymaze.texts.labels.labels import Label, append_labels, read_labels
from memorymaze.texts.labels.questions import questions
from memorymaze.world.sites import Site

Told = Callable[..., Instruction]
Labelled = Callable[..., Label]


@pytest.fixture
def instructions(told: Told) -> list[Instruction]:
    """Three texts, one of which would be a formula in a spreadsheet."""
    wrong = (Failure("extra_turn", "tp_nw", "SECRET"),)
    return [told("a", failures=wrong), told("b", text="=1+1, right"), told("c")]


@pytest.fixture
def kept(
    instructions: list[Instruction], tiny_sites: dict[str, Site], tmp_path: Path
) -> Callable[[], list[Label]]:
    """Read what is kept."""
    return lambda: read_labels([tmp_path / "ada.jsonl"], instructions, tiny_sites)


def test_a_line_that_a_kill_broke_off_is_cut_away(
    label: Labelled, kept: Callable[[], list[Label]], tmp_path: Path
) -> None:
    file = tmp_path / "ada.jsonl"
    append_labels(file, [label("ada", "a")])
    file.write_bytes(file.read_bytes() + b'{"instruction": "b", "te')
    with pytest.warns(LabelFileWarning, match=r"ada\.jsonl:2: .* broken off"):
        [first] = kept()
    append_labels(file, [first])
    assert kept() == [first, first]


def test_a_last_label_without_a_line_end_counts_and_stays(
    label: Labelled, kept: Callable[[], list[Label]], tmp_path: Path
) -> None:
    file = tmp_path / "ada.jsonl"
    first, second = label("ada", "a"), label("ada", "c")
    append_labels(file, [first, second])
    file.write_bytes(file.read_bytes().rstrip(b"\n"))
    assert kept() == [first, second]
    append_labels(file, [first])
    assert kept() == [first, second, first]


def test_a_last_line_that_no_label_begins_with_is_refused_and_stays(
    label: Labelled, kept: Callable[[], list[Label]], tmp_path: Path
) -> None:
    file = tmp_path / "ada.jsonl"
    append_labels(file, [label("ada", "a")])
    written = file.read_bytes() + b"by hand"
    file.write_bytes(written)
    with pytest.raises(LabelFileError, match=r"ada\.jsonl:2: expected JSON"):
        kept()
    append_labels(file, [])
    assert file.read_bytes().startswith(written)


def test_labels_of_another_text_or_way_are_refused(
    label: Labelled,
    instructions: list[Instruction],
    tiny_sites: dict[str, Site],
    tmp_path: Path,
    told: Told,
) -> None:
    file = tmp_path / "ada.jsonl"
    append_labels(file, [label("ada", "a")])
    with pytest.raises(LabelFileError, match=r"ada\.jsonl:1: .*text of 'a' is another"):
        read_labels([file], [told("a", text="Changed.")], tiny_sites)
    bad = file.read_text(encoding="utf-8").replace("route_r1_reference", "route_x")
    file.write_text(bad, encoding="utf-8")
    with pytest.raises(
        LabelFileError, match=r"expected route_r1_reference, .* 'route_x'"
    ):
        read_labels([file], instructions, tiny_sites)


def _add_column(sheet: Path, name: str, filled: str) -> None:
    head, first, *rest = sheet.read_text(encoding="utf-8").splitlines()
    lines = [f"{head};{name}", f"{first};{filled}", *rest]
    sheet.write_text("\n".join(lines), encoding="utf-8")


def _fill(sheet: Path, *rows: dict[str, str]) -> None:
    with sheet.open(encoding="utf-8-sig", newline="") as file:
        table = list(csv.DictReader(file))
    for row, filled in zip(table, rows, strict=False):
        row |= filled
    with sheet.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(table[0]), delimiter=";")
        writer.writeheader()
        writer.writerows(table)


def test_a_sheet_is_filled_in_and_read_back(
    instructions: list[Instruction], tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    sheet = tmp_path / "sheet.csv"
    waiting = questions(instructions, tiny_sites)
    write_label_sheet(sheet, waiting)
    written = sheet.read_text(encoding="utf-8-sig")
    assert "'=1+1" in written
    assert "route_r1_alternative: alternative, 33 m: left" in written
    assert ",people," in written
    assert "SECRET" not in written
    assert "extra_turn" not in written
    failing = {
        "way": "1",
        "arrives": "no",
        "kind_2": "missing_turn",
        "where_2": "tp_nw",
    }
    _fill(sheet, {"way": "none", "arrives": "YES"}, failing)
    [first, second] = read_label_sheet(sheet, waiting, "bob")
    assert (first.annotator, first.way, first.failures) == ("bob", "none", ())
    assert second.failures == (Failure("missing_turn", "tp_nw", ""),)


@pytest.mark.parametrize(
    ("filled", "said"),
    [
        pytest.param({"way": "1"}, "expected yes or no, got ''", id="no answer"),
        pytest.param({"arrives": "yes"}, "column 'way': expected", id="no way"),
        pytest.param({"way": "1", "arrives": "no"}, "column 'kind_1'", id="no kind"),
        pytest.param(
            {"way": "1", "arrives": "yes", "kind_1": "extra_turn"},
            "column 'arrives': expected no",
            id="contradiction",
        ),
        pytest.param(
            {"way": "1", "arrives": "no", "kind_1": "extra_trun"},
            "did you mean 'extra_turn'",
            id="misspelt",
        ),
        pytest.param(
            {"way": "1", "arrives": "no", "where_1": "here"},
            "column 'kind_1'",
            id="where",
        ),
        pytest.param({"way": "1", "text": "Other."}, "is not the one", id="text"),
    ],
)
def test_a_wrong_row_is_named_and_none_is_used(
    instructions: list[Instruction],
    tiny_sites: dict[str, Site],
    tmp_path: Path,
    filled: dict[str, str],
    said: str,
) -> None:
    sheet = tmp_path / "sheet.csv"
    waiting = questions(instructions, tiny_sites)
    write_label_sheet(sheet, waiting)
    _fill(sheet, {"way": "1", "arrives": "yes"}, filled)
    with pytest.raises(LabelFileError) as caught:
        read_label_sheet(sheet, waiting, "bob")
    assert f"{sheet}: row 3: " in str(caught.value)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("column", "said"),
    [
        pytest.param("kind4", "got 'kind4'; name", id="no line"),
        pytest.param("Kind_5", "got 'Kind_5'; name", id="upper case"),
        pytest.param("kind_04", "got 'kind_04'; name", id="zero"),
        pytest.param("", "got cells beneath no name", id="no name"),
    ],
)
def test_a_column_that_would_be_passed_over_is_refused(
    told: Told, tiny_sites: dict[str, Site], tmp_path: Path, column: str, said: str
) -> None:
    sheet = tmp_path / "sheet.csv"
    waiting = questions([told("a", text="Right.")], tiny_sites)
    write_label_sheet(sheet, waiting)
    _fill(sheet, {"ways": "", "way": "1", "arrives": "no", "kind_1": "extra_turn"})
    _add_column(sheet, column, "missing_turn")
    with pytest.raises(LabelFileError, match=said):
        read_label_sheet(sheet, waiting, "bob")


def test_failures_beyond_the_third_are_read(
    told: Told, tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    sheet = tmp_path / "sheet.csv"
    waiting = questions([told("a", text="Right.")], tiny_sites)
    write_label_sheet(sheet, waiting)
    _fill(sheet, {"ways": "", "way": "1", "arrives": "no"})
    _add_column(sheet, "kind_4", "missing_turn")
    [label] = read_label_sheet(sheet, waiting, "bob")
    assert label.failures == (Failure("missing_turn", "", ""),)


def test_a_text_that_is_labelled_in_two_rows_is_refused(
    instructions: list[Instruction], tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    sheet = tmp_path / "sheet.csv"
    waiting = questions([*instructions, instructions[0]], tiny_sites)
    write_label_sheet(sheet, waiting)
    right, wrong = {"way": "1", "arrives": "yes"}, {"way": "none", "arrives": "yes"}
    _fill(sheet, right, right, {}, wrong)
    with pytest.raises(LabelFileError, match=r"row 5: .* got a second one of 'a'"):
        read_label_sheet(sheet, waiting, "bob")


def test_a_file_that_is_no_sheet_is_named(
    instructions: list[Instruction], tiny_sites: dict[str, Site], tmp_path: Path
) -> None:
    sheet = tmp_path / "sheet.csv"
    sheet.write_text("a,b\n1,2\n", encoding="utf-8")
    with pytest.raises(LabelFileError, match="expected the columns of a sheet"):
        read_label_sheet(sheet, questions(instructions, tiny_sites), "bob")
