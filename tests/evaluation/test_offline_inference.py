"""Requests for files, and programs from replies: what is refused, and how it is said."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.agents.code_generation import (
    CodeGenerationOptions,
    CodeGenerationRequests,
)
from memorymaze.errors import ProgramFileError, SettingsError
from memorymaze.evaluation.offline_inference import (
    offline_requests,
    programs_from_replies,
)
from memorymaze.instructions.files import load_instructions
from memorymaze.instructions.records import Instruction
from memorymaze.language.batch_files import BatchReply
from memorymaze.language.model import Completion, Usage

TINY_INSTRUCTIONS = Path(__file__).parents[1] / "tiny_instructions.jsonl"

Replies = Callable[..., dict[str, BatchReply]]


@pytest.fixture
def two() -> list[Instruction]:
    """The instructions p1-1 and p2-1."""
    return load_instructions([TINY_INSTRUCTIONS])[:2]


@pytest.fixture
def replies() -> Replies:
    """Make replies; None stands for a request that failed."""

    def make(model: str = "m", **texts: str | None) -> dict[str, BatchReply]:
        found: dict[str, BatchReply] = {}
        for number, (name, text) in enumerate(texts.items(), start=1):
            said = None if text is None else Completion(text, model, Usage(3, 2), 0.5)
            error = None if said else "the language model answered 500: Oh."
            found[name] = BatchReply(name, said, error, f"replies.jsonl:{number}")
        return found

    return make


def ids(lines: tuple[str, ...]) -> list[str]:
    return [json.loads(line)["custom_id"] for line in lines]


def test_requests_for_programs_follow_from_the_replies(
    two: list[Instruction], replies: Replies
) -> None:
    requests = CodeGenerationRequests()
    parsed = replies(**{"parse+parser/p1-1": "1. Go.", "parse+parser/p2-1": None})
    assert ids(offline_requests(two, requests, "m").lines) == list(parsed)
    asked = offline_requests(two, requests, "m", parsed)
    assert asked.stage == "program"
    assert ids(asked.lines) == ["program+parser/p1-1"]
    assert (
        '"""\n1. Go.\n"""'
        in json.loads(asked.lines[0])["body"]["messages"][1]["content"]
    )
    assert asked.failed == ("p2-1: the language model answered 500: Oh.",)


def test_variants_are_told_apart_by_their_requests(two: list[Instruction]) -> None:
    single = CodeGenerationRequests(CodeGenerationOptions(stages="single"))
    plain = CodeGenerationRequests(parser=False)
    assert ids(offline_requests(two, single, "m").lines)[0] == (
        "parse+parser+single_stage/p1-1"
    )
    assert ids(offline_requests(two, plain, "m").lines)[0] == "program/p1-1"


@pytest.mark.parametrize(
    ("options", "parsed", "error", "said"),
    [
        pytest.param(
            {"options": CodeGenerationOptions(repair=True)},
            None,
            SettingsError,
            "--set repair",
            id="repair",
        ),
        pytest.param(
            {"parser": False},
            {"parse/p1-1": "1. Go."},
            SettingsError,
            "--steps and",
            id="no parser",
        ),
        pytest.param(
            {},
            {"parse+parser/p1-1": "1. Go."},
            ProgramFileError,
            "got none for p2-1",
            id="missing",
        ),
        pytest.param(
            {},
            {"program+parser/p1-1": "1. Go."},
            ProgramFileError,
            r"replies\.jsonl:1: expected the reply to a request parse\+parser/…",
            id="stage",
        ),
        pytest.param(
            {}, {"somebody's": "1. Go."}, ProgramFileError, "got one to", id="stranger"
        ),
    ],
)
def test_what_cannot_be_asked_is_explained(
    two: list[Instruction],
    replies: Replies,
    options: dict[str, Any],
    parsed: dict[str, str] | None,
    error: type[Exception],
    said: str,
) -> None:
    requests = CodeGenerationRequests(**options)
    with pytest.raises(error, match=said):
        offline_requests(
            two, requests, "m", None if parsed is None else replies(**parsed)
        )


def test_replies_become_records_of_what_the_agent_would_have_read(
    replies: Replies,
) -> None:
    parsed = replies(**{
        "parse+parser/a": "1. Go.",
        "parse+parser/b": "I would rather not.",
        "parse+parser/c": "1. Go.",
        "parse+parser/d": "1. Go.",
    })
    written = replies(**{
        "program+parser/c": None,
        "program+parser/a": "```\nstop()\n```",
    })
    found = programs_from_replies(written, parsed)
    records = {record.instruction_id: record for record in found.records}
    assert list(records) == ["a", "b", "c"]
    assert {record.agent for record in found.records} == {"code_generation[m]+parser"}
    assert records["a"].program == "stop()\n"
    assert records["a"].steps == ("Go.",)
    assert [reply.stage for reply in records["a"].replies] == ["parse", "program"]
    assert "no numbered list" in str(records["b"].error)
    assert len(records["b"].replies) == 1
    assert "answered 500" in str(records["c"].error)
    assert found.missing == ("d",)
    assert len(found.failed) == 2


@pytest.mark.parametrize(
    ("written", "parsed", "error", "said"),
    [
        pytest.param(
            {"program+parser/a": "…"},
            None,
            SettingsError,
            "had steps in them",
            id="steps",
        ),
        pytest.param(
            {"program/a": "…"},
            {"parse/a": "…"},
            SettingsError,
            "without a parser",
            id="no steps",
        ),
        pytest.param(
            {"parse+parser/a": "…"}, None, ProgramFileError, "for a program", id="stage"
        ),
        pytest.param(
            {"program/a": "…", "program+single_stage/b": "…"},
            None,
            ProgramFileError,
            "jsonl:2: expected the reply to a request program/",
            id="two variants",
        ),
        pytest.param(
            {"program/a": None},
            None,
            ProgramFileError,
            "got none; say with",
            id="model",
        ),
    ],
)
def test_replies_that_make_no_file_are_explained(
    replies: Replies,
    written: dict[str, str | None],
    parsed: dict[str, str] | None,
    error: type[Exception],
    said: str,
) -> None:
    with pytest.raises(error, match=said):
        programs_from_replies(
            replies(**written), None if parsed is None else replies(**parsed)
        )


def test_a_model_can_be_given_another_name(replies: Replies) -> None:
    found = programs_from_replies(replies(**{"program/a": "stop()"}), model="mine")
    assert found.records[0].agent == "code_generation[mine]"


def test_replies_of_two_models_make_no_file(replies: Replies) -> None:
    both = replies(**{"program/a": "…"}) | replies("n", **{"program/b": "…"})
    with pytest.raises(ProgramFileError, match="got m, n; say with --model"):
        programs_from_replies(both)


@given(st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=30))
def test_any_id_of_an_instruction_comes_back_with_its_reply(name: str) -> None:
    told = replace(load_instructions([TINY_INSTRUCTIONS])[0], id=name)
    for parser in (True, False):
        requests = CodeGenerationRequests(parser=parser)
        said = Completion("1. ```\nstop()\n```", "m", Usage(), 0.0)
        stages = [offline_requests([told], requests, "m")]
        got: list[dict[str, BatchReply]] = []
        while True:
            [identifier] = ids(stages[-1].lines)
            got.append({identifier: BatchReply(identifier, said, None, "f:1")})
            if stages[-1].stage == "program":
                break
            stages.append(offline_requests([told], requests, "m", got[-1]))
        found = programs_from_replies(got[-1], got[0] if parser else None)
        assert [record.instruction_id for record in found.records] == [name]
