from dataclasses import asdict, replace
from datetime import datetime
from pathlib import Path

import pyarrow
import pyarrow.parquet as parquet
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.record_format import tidied
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.corpus.spreadsheets import (
    _Kind,
    read_spreadsheet,
    write_spreadsheet,
)


@given(
    text=st.text(
        st.characters(exclude_categories=("Cs",), exclude_characters="\x00\r"),
        min_size=1,
    ).filter(str.strip)
)
def test_any_text_survives_a_spreadsheet(
    tmp_path_factory: pytest.TempPathFactory, text: str
) -> None:
    one = Instruction(id="a", participant="a", site="loop", route="R1", text="x")
    path = tmp_path_factory.mktemp("sheet") / "one.csv"
    write_spreadsheet(path, [replace(one, text=text)], "csv")
    [read] = read_spreadsheet(path, "csv")
    assert read == tidied(replace(one, text=text))


def test_a_wrong_row_of_a_spreadsheet_is_named(
    tmp_path: Path, told: list[Instruction]
) -> None:
    path = tmp_path / "told.csv"
    write_spreadsheet(path, told, "csv")
    path.write_text(path.read_text(encoding="utf-8").replace("c,loop", "c,"), "utf-8")
    with pytest.raises(InstructionFileError, match="row 4: field 'site'"):
        read_spreadsheet(path, "csv")


def test_a_table_needs_only_sites_routes_and_texts(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text("text,site,route,iteration\nTurn left.,loop,R1,\n\n", "utf-8")
    [read] = read_spreadsheet(path, "csv")
    assert read == Instruction(
        id="mine-2", participant="mine-2", site="loop", route="R1", text="Turn left."
    )


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param("site,route,text\n", "got the names of columns alone", id="empty"),
        pytest.param(
            "site,route,words\na,b,c\n",
            "none called text; its columns are 'site', 'route', 'words'",
            id="no texts",
        ),
        pytest.param("", "none called site, route, text; .* empty", id="no columns"),
        pytest.param(
            "site;route;text\na;b;Left, then right.\n",
            "its only column is 'site;route;text': separate columns by commas",
            id="semicolons",
        ),
        pytest.param("site,site,route,text\n", "column 'site' once", id="twice"),
        pytest.param("site,route,text\na,b,c,d\n", "row 2: .*3 cells", id="too many"),
        pytest.param("site,route,text\na,b,\n", "row 2: field 'text'", id="no text"),
        pytest.param(
            "site,route,text,failures\na,b,c,oops\n",
            "row 2: column 'failures': expected JSON",
            id="no JSON",
        ),
        pytest.param('site,route,text\na,b,"c', "expected CSV", id="open quote"),
    ],
)
def test_what_is_wrong_in_a_csv_file_is_named(
    tmp_path: Path, content: str, message: str
) -> None:
    path = tmp_path / "told.csv"
    path.write_text(content, "utf-8")
    with pytest.raises(InstructionFileError, match=message):
        read_spreadsheet(path, "csv")


def test_nested_columns_of_parquet_are_read_as_records(
    tmp_path: Path, told: list[Instruction]
) -> None:
    nested = pyarrow.Table.from_pylist([
        {name: value for name, value in asdict(each).items() if name != "origin"}
        for each in told
    ])
    path = tmp_path / "nested.parquet"
    parquet.write_table(nested, path)
    assert read_spreadsheet(path, "parquet") == told


@pytest.mark.parametrize(
    "value",
    [
        pytest.param(["Turn", "left"], id="list"),
        pytest.param(b"Turn left", id="bytes"),
        pytest.param(datetime(2026, 1, 1), id="time"),
        pytest.param({"en": "Turn left"}, id="record"),
        pytest.param(1.5, id="number"),
    ],
)
def test_a_column_of_another_kind_is_refused_by_name(
    tmp_path: Path, value: object
) -> None:
    path = tmp_path / "odd.parquet"
    row = {"site": "loop", "route": "R1", "text": value}
    parquet.write_table(pyarrow.Table.from_pylist([row]), path)
    with pytest.raises(InstructionFileError, match="row 2: field 'text': expected a"):
        read_spreadsheet(path, "parquet")


@pytest.mark.parametrize("kind", ["csv", "parquet"])
def test_an_address_is_no_file(kind: _Kind) -> None:
    with pytest.raises(InstructionFileError, match="cannot be read"):
        read_spreadsheet("http://127.0.0.1:9/told.csv", kind)


@pytest.mark.parametrize("out", [".", "", "/"])
def test_a_folder_is_no_file_to_write(
    out: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, told: list[Instruction]
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InstructionFileError, match="expected a file to write, got a"):
        write_spreadsheet(out, told, "csv")


def test_a_table_is_an_instruction_file_by_its_name(
    tmp_path: Path, told: list[Instruction]
) -> None:
    for kind in ("csv", "parquet"):
        path = tmp_path / f"told.{kind}"
        write_spreadsheet(path, told, kind)
        assert load_instructions([path]) == told
    tabs = tmp_path / "told.tsv"
    tabs.write_text("site\troute\ttext\nloop\tR1\tLeft.\n", "utf-8")
    with pytest.raises(
        InstructionFileError, match=r"end in \.csv or \.parquet\n.*:1: "
    ):
        load_instructions([tabs])
    path = tmp_path / "wrong.CSV"
    path.write_text("site,route,text\nloop,R1,\nloop,R1,Left.\n", "utf-8")
    with pytest.raises(InstructionFileError, match="row 2: field 'text'"):
        load_instructions([path])
