import json
from pathlib import Path
from typing import Any

import pytest

from memorymaze.front.cli.main import run_command_line

GRAPHS: dict[str, Any] = {
    "line": {
        "nodes": {"a": [0, 0, 0], "b": [1, 0, 0], "c": [2, 0, 0]},
        "edges": [["a", "b", 1.0], ["b", "c", 1.0]],
    },
    "astray": {"nodes": {"a": [0, 0, 0]}, "edges": [["a", "z", 1.0]]},
    "negative": {"nodes": {"a": [0, 0, 0]}, "edges": [["a", "a", -1.0]]},
    "wordy": {"nodes": {"a": [0, 0, 0]}, "edges": [["a", "a", "1"]]},
}

GOOD: dict[str, Any] = {
    "id": "good",
    "graph": "line",
    "reference_path": ["a", "b", "c"],
    "agent_path": ["a", "c"],
    "threshold": 3.0,
}

NAMES = ["success", "oracle_success", "ne", "spl", "cls", "ndtw", "sdtw", "path_length"]


def score(
    capsys: pytest.CaptureFixture[str], folder: Path, content: object
) -> tuple[int, list[dict[str, Any]], str]:
    """Score a file with this content; return exit code, lines and messages."""
    file = folder / "cases.json"
    text = content if isinstance(content, str) else json.dumps(content)
    file.write_text(text, encoding="utf-8")
    code = run_command_line(["score", "--cases", str(file)])
    said = capsys.readouterr()
    return code, [json.loads(line) for line in said.out.splitlines()], said.err


def test_a_line_has_the_id_and_the_eight_values(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    code, [line], said = score(capsys, tmp_path, {"graphs": GRAPHS, "cases": [GOOD]})
    assert (code, said) == (0, "")
    assert list(line) == ["id", *NAMES]
    assert (line["id"], line["path_length"], line["spl"]) == ("good", 2.0, 1.0)


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"graph": "lime"}, "unknown graph 'lime'; did you mean 'line'?"),
        ({"graph": "astray"}, "graphs['astray']: edge 0 ('a' to 'z'): unknown node"),
        ({"graph": "negative"}, "graphs['negative']: edge 0 ('a' to 'a'): expected"),
        ({"graph": "wordy"}, "graphs['wordy'].edges[0][2]: expected a valid"),
        ({"agent_path": ["a", "q"]}, "unknown node 'q' at place 1"),
        ({"agent_path": []}, "at least one node in the agent's path"),
        ({"agent_path": "abc"}, "cases[1].agent_path: expected a list, got"),
        ({"agent_path": [7]}, "cases[1].agent_path[0]: expected a valid string"),
        ({"threshold": 0}, "threshold > 0 m, got 0.0"),
        ({"threshold": True}, "cases[1].threshold: expected a valid number"),
        ({"threshold": float("nan")}, "cases[1].threshold: expected a finite"),
        ({"threshold": "9" * 99}, f"got '{'9' * 57}…'"),
    ],
)
def test_what_is_wrong_with_a_case_is_said_in_its_line_only(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    change: dict[str, Any],
    error: str,
) -> None:
    cases = [GOOD, GOOD | {"id": "bad"} | change, GOOD | {"id": "last"}]
    code, lines, _ = score(capsys, tmp_path, {"graphs": GRAPHS, "cases": cases})
    assert code == 0
    assert [line["id"] for line in lines] == ["good", "bad", "last"]
    assert ["error" in line for line in lines] == [False, True, False]
    assert error in lines[1]["error"]


@pytest.mark.parametrize(
    ("case", "error"),
    [
        (5, "cases[0]: expected a record {…}, got 5"),
        ({"graph": "line"}, "cases[0].id: expected this member, got none; add it"),
    ],
)
def test_a_case_without_an_id_is_named_by_its_place(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, case: object, error: str
) -> None:
    _, [line], _ = score(capsys, tmp_path, {"graphs": GRAPHS, "cases": [case]})
    assert line == {"id": None, "error": error}


def test_undefined_cases_get_their_error_too(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    content = {
        "graphs": GRAPHS,
        "cases": [],
        "undefined_cases": [GOOD | {"id": "none", "reference_path": []}],
    }
    code, [line], _ = score(capsys, tmp_path, content)
    assert code == 0
    assert line == {
        "id": "none",
        "error": "expected at least one node in the reference path, got none",
    }


@pytest.mark.parametrize(
    ("content", "message"),
    [
        pytest.param('{"graphs": {},\n "cases": [}', "line 2, column 12", id="json"),
        pytest.param("", "expected JSON, got a mistake in column 1", id="empty"),
        pytest.param("[" * 100_000, "nested too deep", id="deep"),
        pytest.param(
            '{"graphs": {}, "graphs": {}}', "'graphs': expected it once", id="twice"
        ),
        pytest.param("[" + "1" * 5000 + "]", "digits", id="digits"),
        pytest.param([], "expected a JSON object with `graphs`", id="list"),
        pytest.param({"cases": []}, "a member `graphs`", id="no graphs"),
        pytest.param({"graphs": {}}, "a member `cases`", id="no cases"),
        pytest.param(
            {"graphs": [], "cases": []},
            "`graphs` to be an object, got a list",
            id="kind",
        ),
        pytest.param(
            {"graphs": {}, "cases": None}, "`cases` to be a list, got null", id="null"
        ),
        pytest.param({"graphs": {}, "cases": []}, "at least one case", id="nothing"),
    ],
)
def test_a_file_that_is_no_case_file_gets_one_message(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    content: object,
    message: str,
) -> None:
    code, lines, said = score(capsys, tmp_path, content)
    assert (code, lines) == (1, [])
    assert said.count("\n") == 1
    assert "cases.json" in said
    assert message in said


def test_bytes_that_are_no_text_get_one_message(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "cases.json"
    file.write_bytes(b"\xff\xfe{}")
    assert run_command_line(["score", "--cases", str(file)]) == 1
    assert "expected UTF-8, got byte 0xff" in capsys.readouterr().err


def test_a_file_that_is_not_there_gets_one_message(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run_command_line(["score", "--cases", str(tmp_path / "none.json")]) == 2
    assert "none.json: cannot be read (No such file" in capsys.readouterr().err


def test_no_file_is_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        run_command_line(["score"])
    assert stop.value.code == 2
    assert "--cases" in capsys.readouterr().err


def test_the_example_in_the_documentation_prints_what_it_says(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    page = Path(__file__).parents[3] / "docs" / "metrics.md"
    text = page.read_text(encoding="utf-8")
    example = text.split("`FILE` is JSON:")[1].split("Graphs are undirected")[0]
    [shown] = [line for line in text.splitlines() if '{"id": "c1", "success"' in line]
    code, [line], _ = score(capsys, tmp_path, example)
    assert code == 0
    assert line == pytest.approx(json.loads(shown))
