import json
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import InstructionFileError
from memorymaze.texts.corpus import Failure, Instruction, load_instructions
from memorymaze.texts.corpus.record_format import FIELDS, instruction_record, parse_line

Line = Callable[..., dict[str, Any]]
Write = Callable[..., Path]


def test_the_shipped_corpus_has_564_texts_all_labelled_as_a_language_models() -> None:
    corpus = load_instructions()
    assert len(corpus) == 564
    assert {instruction.source for instruction in corpus} == {"llm"}
    assert Counter(instruction.split for instruction in corpus) == {
        "test": 554,
        "dev": 10,
    }


def test_every_field_of_a_line_arrives(line: Line, instruction_file: Write) -> None:
    wrong = {"kind": "missing_turn", "where": "tp_1", "detail": "no left"}
    path = instruction_file(line(failures=[wrong], original_text="左へ", split="dev"))
    [read] = load_instructions([path])
    assert read.failures == (Failure("missing_turn", "tp_1", "no left"),)
    assert (read.text, read.original_text) == ("Turn left, then stop.", "左へ")
    assert (read.iteration, read.split, read.origin) == (1, "dev", f"{path}:1")


def test_only_site_route_and_text_are_needed(instruction_file: Write) -> None:
    record = {"site": "loop", "route": "R1", "text": "Turn left."}
    path = instruction_file("", record, name="mine.jsonl")
    [read] = load_instructions([path])
    assert read == Instruction(
        id="mine-2", participant="mine-2", site="loop", route="R1", text="Turn left."
    )
    assert (read.study, read.source, read.split) == ("online", "human", "test")
    assert read.origin == f"{path}:2"


@pytest.mark.parametrize(
    ("typed", "read"),
    [
        pytest.param(
            "  Turn\tleft,\u00a0 then stop. \n", "Turn left, then stop.", id="runs"
        ),
        pytest.param("1. Left \r\n 2. Right", "1. Left\n2. Right", id="lines"),
        pytest.param("Left.\n\n\n\nRight.", "Left.\n\nRight.", id="paragraphs"),
    ],
)
def test_the_white_space_of_a_text_is_put_in_order(
    line: Line, instruction_file: Write, typed: str, read: str
) -> None:
    [one] = load_instructions([instruction_file(line(text=typed))])
    assert one.text == read


def test_a_text_with_labelled_words_keeps_its_white_space(
    line: Line, instruction_file: Write
) -> None:
    span = {"kind": "filler", "start": 2, "end": 4}
    [one] = load_instructions([instruction_file(line(text="  um  left", spans=[span]))])
    assert one.text == "  um  left"


def test_a_byte_order_mark_windows_line_ends_and_blank_lines_are_read(
    line: Line, tmp_path: Path
) -> None:
    path = tmp_path / "windows.jsonl"
    lines = [json.dumps(line(id=name)) for name in ("a", "b")]
    path.write_bytes(("\ufeff" + "\r\n\r\n".join(lines) + "\r\n").encode())
    assert [one.id for one in load_instructions([path])] == ["a", "b"]


def test_a_line_separator_inside_a_text_does_not_end_the_line(
    line: Line, tmp_path: Path
) -> None:
    path = tmp_path / "separator.jsonl"
    record = line(text="left\u2028right")
    path.write_text(json.dumps(record, ensure_ascii=False), encoding="utf-8")
    assert [each.text for each in load_instructions([path])] == ["left right"]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        pytest.param({"iteration": 3}, "'iteration': expected 1 or 2, got 3", id="3"),
        pytest.param({"iteration": "1"}, "'iteration': expected", id="text number"),
        pytest.param({"iteration": True}, "got true", id="flag for a number"),
        pytest.param(
            {"study": "lab"},
            "expected 'online', 'memory', 'onsite' or 'sail'",
            id="study",
        ),
        pytest.param(
            {"text": "  "}, "expected a text that is not empty", id="blank text"
        ),
        pytest.param({"text": 5}, "got 5", id="number for a text"),
        pytest.param({"failures": None}, "expected a list, got null", id="no list"),
        pytest.param({"failures": [3]}, "'failures[0]'", id="no record"),
        pytest.param(
            {"failures": [{"kind": "x", "where": "y"}]},
            "'failures[0].detail': expected this member",
            id="failure without detail",
        ),
        pytest.param({"source": "gpt"}, "'human', 'llm' or 'synthetic'", id="source"),
        pytest.param(
            {"text": "\ud800"}, r"halves of characters, got '\ud800'", id="surrogate"
        ),
        pytest.param({"split": "DEV"}, "a name in small letters", id="capital split"),
    ],
)
def test_a_wrong_field_is_named_with_what_was_expected(
    line: Line, instruction_file: Write, changes: dict[str, Any], said: str
) -> None:
    path = instruction_file(line(id="good"), line(**changes))
    with pytest.raises(InstructionFileError) as caught:
        load_instructions([path])
    assert f"{path}:2: " in str(caught.value)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        pytest.param("{bad", "expected JSON, got a mistake", id="no json"),
        pytest.param("[1, 2]", "expected one JSON record {…}, got [1, 2]", id="list"),
    ],
)
def test_a_line_that_is_no_record_is_named(
    line: Line, instruction_file: Write, text: str, said: str
) -> None:
    path = instruction_file(line(), text)
    with pytest.raises(InstructionFileError) as caught:
        load_instructions([path])
    assert f"{path}:2: " in str(caught.value)
    assert said in str(caught.value)


def test_all_bad_lines_are_listed_and_good_ones_do_not_hide_them(
    line: Line, instruction_file: Write
) -> None:
    path = instruction_file(line(study="x"), line(id="b"), "nonsense", line(site=1))
    with pytest.raises(InstructionFileError) as caught:
        load_instructions([path])
    message = str(caught.value)
    assert message.startswith("3 problems")
    assert [f"{path}:{number}:" in message for number in (1, 2, 3, 4)] == [
        True,
        False,
        True,
        True,
    ]


def test_a_misspelt_optional_field_is_an_error(
    line: Line, instruction_file: Write
) -> None:
    path = instruction_file(line(orignal_text="左"))
    with pytest.raises(InstructionFileError, match="did you mean 'original_text'"):
        load_instructions([path])


def test_a_field_the_format_does_not_know_is_left_out_with_a_warning(
    line: Line, instruction_file: Write
) -> None:
    path = instruction_file(line(mood="glad"), line(id="b", mood="sad"))
    with pytest.warns(UserWarning, match=":1: field 'mood' is not part") as caught:
        assert len(load_instructions([path])) == 2
    assert len(caught) == 1


def test_an_id_that_repeats_in_another_file_is_named_with_both_places(
    line: Line, instruction_file: Write
) -> None:
    first = instruction_file(line(), name="first.jsonl")
    second = instruction_file(line(id="b"), line(), name="second.jsonl")
    with pytest.raises(InstructionFileError) as caught:
        load_instructions([first, second])
    assert f"{second}:2: field 'id'" in str(caught.value)
    assert f"{first}:1 has" in str(caught.value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        pytest.param(b"", "the file is empty", id="empty"),
        pytest.param(b"\n \r\n", "the file is empty", id="blank"),
        pytest.param(b"\xff\xfe{\x00", "expected UTF-8, got byte 0xff", id="utf-16"),
    ],
)
def test_a_file_that_holds_nothing_readable_is_named(
    tmp_path: Path, content: bytes, said: str
) -> None:
    path = tmp_path / "bad.jsonl"
    path.write_bytes(content)
    with pytest.raises(InstructionFileError) as caught:
        load_instructions([path])
    assert str(path) in str(caught.value)
    assert said in str(caught.value)


def test_a_missing_file_and_a_folder_are_named(tmp_path: Path) -> None:
    with pytest.raises(InstructionFileError, match=r"none\.jsonl: cannot be read"):
        load_instructions([tmp_path / "none.jsonl"])
    with pytest.raises(InstructionFileError, match="Is a directory"):
        load_instructions([tmp_path])


VALUES = st.recursive(
    st.sampled_from([
        None,
        True,
        0,
        1,
        2,
        -1,
        1.5,
        "",
        " ",
        "R1",
        "a\nb",
        "\ud800",
        "dev",
    ]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["kind", "start", "end", "x"]), inner, max_size=3
        )
    ),
    max_leaves=6,
)


@given(st.dictionaries(st.sampled_from([*FIELDS, "mood"]), VALUES, max_size=9))
def test_any_record_is_read_or_refused_in_a_line_for_each_field(
    changes: dict[str, Any],
) -> None:
    sound = {"site": "loop", "route": "R1", "text": "Turn left."}
    read, unknown, problems = parse_line(json.dumps(sound | changes), "mine.jsonl:7")
    assert (read is None) == bool(problems)
    assert all("\n" not in problem for problem in problems)
    assert set(unknown) <= {"mood"}
    if read is not None:
        line = json.dumps(instruction_record(read))
        assert parse_line(line, "mine.jsonl:7") == (read, [], [])
