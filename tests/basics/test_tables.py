"""Tables in all forms."""

import csv
import io

import pandas
import pytest

from memorymaze.basics.tables import Column, Row, Table, write_tables


def table(*rows: Row, notes: tuple[str, ...] = ()) -> Table:
    return Table(
        "Walks",
        (
            Column("site", "Site", "group"),
            Column("route", "Route", "group"),
            Column("robot", "Robot", "label"),
            Column(
                "left", "Left (m)", digits=1, interval=("low", "high"), better="lower"
            ),
            Column("falls", "Falls"),
            Column("seed"),
        ),
        rows,
        notes,
        aside=lambda row: row["robot"] == "old",
    )


def walk(robot: str = "a_b", **changes: object) -> Row:
    right = {"site": "hall", "route": "R1", "robot": robot, "left": 2.25, "falls": 3}
    return right | changes


def test_text_stands_in_columns_with_numbers_below_each_other() -> None:
    text = table(walk(low=1.0, high=12.0), walk("old", left=110.5)).text()
    assert text.splitlines() == [
        "Walks",
        "",
        "hall",
        "  Robot  Left (m)           Falls",
        "---------------------------------",
        "R1",
        "  a_b      2.2 [1.0, 12.0]      3",
        "  old    110.5                  3",
    ]


def test_columns_that_do_not_fit_stand_below_with_the_labels() -> None:
    lines = table(walk(), walk("old")).text(width=18).splitlines()
    assert max(map(len, lines)) <= 18
    assert [line for line in lines if "Robot" in line] == [
        "  Robot  Left (m)",
        "  Robot  Falls",
    ]


def test_a_row_is_left_out_where_it_has_nothing_to_show() -> None:
    bare = {"site": "hall", "route": "R1", "robot": "old", "left": 1.0}
    text = table(walk(), bare).text(width=18)
    assert text.count("old") == 1


def test_what_is_unknown_is_a_dash_and_what_is_not_there_is_nothing() -> None:
    [row] = [
        line
        for line in table(
            walk(left=None), {"site": "hall", "route": "R1", "robot": "c"}
        )
        .markdown()
        .splitlines()
        if "| c |" in line
    ]
    assert row == "| R1 | c |  |  |"
    assert "| R1 | a_b | - | 3 |" in table(walk(left=None)).markdown()


def test_intervals_that_tell_nothing_are_said_in_words() -> None:
    rows = [
        walk(low=None, high=None),
        walk("b", low=2.25, high=2.25),
        walk("c"),
        walk("d", left=None, low=None, high=None),
        walk("e", left=3.0, low=2.99, high=3.01),
    ]
    lines = table(*rows).markdown().splitlines()
    assert [line.split(" | ")[2] for line in lines if line.startswith("| R1")] == [
        "2.2 (too few)",
        "2.2 (no spread)",
        "2.2",
        "-",
        "3.0 (within 0.1)",
    ]


def test_blocks_are_told_apart_in_every_form() -> None:
    both = table(walk(), walk(site="mall"))
    assert both.text().count("Left (m)") == 2
    assert both.markdown().count("**") == 4
    assert both.latex().count(r"\midrule") == 2
    assert both.html().count("<caption>") == 2


def test_latex_sets_the_best_measured_value_in_bold() -> None:
    text = table(walk(), walk("c", left=5.0), walk("old", left=0.0)).latex()
    assert r"\quad a\_b & \textbf{2.2} & 3" in text
    assert text.count(r"\textbf") == 1
    assert r"\textbf" not in table(walk(), walk("old")).latex()


def test_hostile_texts_stay_texts() -> None:
    hostile = table(walk("<b>&|", left=1.0), notes=("a | b",))
    assert "<b>" not in hostile.html()
    assert r"<b>&\|" in hostile.markdown()
    assert r"\textless{}b\textgreater{}\&|" in hostile.latex()


def test_brackets_in_words_are_no_intervals() -> None:
    columns = (Column("note", "Note"), Column("walk", "Walk", "label"))
    rows = ({"note": "on texts (dev)", "walk": "a [b]"},)
    made = Table("Notes", columns, rows)
    assert "interval" not in made.html()
    assert "scriptsize" not in made.latex()


def test_pages_sort_by_values_and_keep_published_rows_apart() -> None:
    text = table(walk(), walk("old")).html("results sortable")
    assert 'data-value="2.25"' in text
    assert text.count("<tbody>") == 1
    assert '<tr class="published">' in text


def test_pages_plot_a_value_with_its_interval_and_lead_to_routes() -> None:
    made = Table(
        "Rates",
        (
            Column("block", "Block", "group"),
            Column("route", "Route", "group", link=lambda row: f"{row['route']}.html"),
            Column("rate", "Rate", digits=2, interval=("low", "high"), plot=True),
        ),
        (
            {"block": "b", "route": "R1", "rate": 0.5, "low": 0.25, "high": 0.75},
            {"block": "b", "route": "R2", "rate": None},
        ),
    )
    page = made.html()
    assert 'colspan="2"><a href="R1.html">R1</a>' in page
    assert 'd="M25 7H75"' in page
    assert page.count("<circle") == 1
    assert 'cx="50"' in page
    assert "svg" not in made.markdown()


def test_data_has_all_fields_unrounded_and_those_that_nobody_is_shown() -> None:
    made = table(walk(seed=7), walk("old", low=0.5, high=3.5))
    names = ["site", "route", "robot", "left", "low", "high", "falls", "seed"]
    rows = list(csv.DictReader(io.StringIO(made.csv())))
    assert list(rows[0]) == list(made.frame().columns) == names
    assert (rows[0]["left"], rows[0]["low"], rows[1]["seed"]) == ("2.25", "", "")
    assert made.frame()["left"].tolist() == [2.25, 2.25]


@pytest.mark.parametrize("style", ["csv", "parquet"])
def test_data_of_several_tables_is_one_file(style: str) -> None:
    content = write_tables([table(walk(seed=1)), table(walk(seed=2))], style)  # pyright: ignore[reportArgumentType]
    read = pandas.read_csv if style == "csv" else pandas.read_parquet
    assert read(io.BytesIO(content))["seed"].tolist() == [1, 2]
