"""Code generation with inference in files: requests out, replies in, programs made.

The requests are those of the agent, so that the same replies give the same results as
with a model that is asked while the run goes on. A request's `custom_id` is
`STAGE+VARIANT/INSTRUCTION`, such as `program+parser/onl-university-r1-01-1`, and says
all that is needed to make sense of its reply.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from memorymaze.agents.code_generation import CodeGenerationRequests
from memorymaze.agents.code_generation.replies import read_program, read_steps
from memorymaze.errors import LanguageModelError, ProgramFileError, SettingsError
from memorymaze.evaluation.program_files import ProgramRecord, ProgramReply
from memorymaze.instructions.records import Instruction
from memorymaze.language.batch_files import BatchReply, request_line
from memorymaze.language.json_lines import some
from memorymaze.language.model import Completion

_ID = re.compile(r"(parse|program)((?:\+\w+)*)/(.+)", re.DOTALL)


@dataclass(frozen=True, slots=True)
class OfflineRequests:
    """The requests of one stage."""

    stage: Literal["parse", "program"]
    lines: tuple[str, ...]
    """Of a batch file, without line ends."""
    failed: tuple[str, ...]
    """Why an instruction has no request: its parsing failed; one line each."""


@dataclass(frozen=True, slots=True)
class ReadPrograms:
    """What replies are worth."""

    records: tuple[ProgramRecord, ...]
    failed: tuple[str, ...]
    """Why a record has no program; one line each."""
    missing: tuple[str, ...]
    """Instructions of which a reply is missing: they have no record."""


def offline_requests(
    instructions: Iterable[Instruction],
    requests: CodeGenerationRequests,
    model: str,
    parsed: Mapping[str, BatchReply] | None = None,
    *,
    length_field: str = "max_tokens",
) -> OfflineRequests:
    """Return the next requests: for steps, or for programs.

    Args:
        instructions: What to write programs for.
        requests: The variant of code generation.
        model: The server's name for the model.
        parsed: Replies to the requests for steps; with the parser, None asks for steps.
        length_field: What the server calls the longest reply.

    Raises:
        SettingsError: The variant cannot be done in files, or has no parser and there
            are parsed replies.
        ProgramFileError: Replies are missing, or to requests of another variant.
    """
    if requests.options.repair:
        raise SettingsError(
            "--set repair: a program is mended while the robot stands and waits, which "
            "no file can do; leave it out, or ask a model with evaluate --model"
        )
    if parsed is not None and not requests.parser:
        raise SettingsError(
            "--steps and --no-parser: there are steps or not; leave one out"
        )
    parsing = requests.parser and parsed is None
    steps = {} if parsed is None else _by_instruction(parsed, "parse", requests.variant)
    lines: list[str] = []
    failed: list[str] = []
    unanswered: list[str] = []
    for each in instructions:
        way = each.text
        if parsed is not None:
            if each.id not in steps:
                unanswered.append(each.id)
                continue
            try:
                found = read_steps(_completion(steps[each.id]).text)
            except LanguageModelError as error:
                failed.append(f"{each.id}: {error}")
                continue
            way = requests.numbered(found)
        stage = "parse" if parsing else "program"
        request = requests.parse(way) if parsing else requests.program(way)
        identifier = f"{stage}{requests.variant}/{each.id}"
        lines.append(
            request_line(identifier, model, request, length_field=length_field)
        )
    if unanswered:
        raise ProgramFileError(
            f"--steps: expected a reply for each instruction, got none for "
            f"{some(unanswered)}; run these requests again and give both files, or leave "
            "the instructions out"
        )
    return OfflineRequests(
        "parse" if parsing else "program", tuple(lines), tuple(failed)
    )


def programs_from_replies(
    replies: Mapping[str, BatchReply],
    parsed: Mapping[str, BatchReply] | None = None,
    *,
    model: str | None = None,
) -> ReadPrograms:
    """Make records of programs from replies, as the agent would have read them.

    An instruction whose parsing failed, or whose reply has no program, gets a record
    that says so: online the episode ends as `model_error` too.

    Args:
        replies: To the requests for programs.
        parsed: To the requests for steps, where instructions were parsed.
        model: Name shown in tables; None for what the replies say.

    Raises:
        ProgramFileError: The replies are to requests of another stage or of several
            variants, or do not say one model.
        SettingsError: The parsed replies are missing, or not wanted.
    """
    variant = _variant(replies)
    written = _by_instruction(replies, "program", variant)
    parser = "+parser" in variant
    if parser != (parsed is not None):
        raise SettingsError(
            "--steps: the requests had steps in them; give the replies to the requests for "
            "steps too, which count as inferences"
            if parser
            else "--steps: the requests were made without a parser; leave the option out"
        )
    steps = {} if parsed is None else _by_instruction(parsed, "parse", variant)
    named = model or _model([*written.values(), *steps.values()])
    method = f"code_generation[{named}]{variant}"
    records: list[ProgramRecord] = []
    missing: list[str] = []
    for identifier in dict.fromkeys([*steps, *written]):
        chain = [("program", written.get(identifier))]
        if parser:
            chain.insert(0, ("parse", steps.get(identifier)))
        record = _record(identifier, named, method, parser, chain)
        if record is None:
            missing.append(identifier)
        else:
            records.append(record)
    failed = tuple(f"{r.instruction_id}: {r.error}" for r in records if r.error)
    return ReadPrograms(tuple(records), failed, tuple(missing))


def _record(
    identifier: str,
    model: str,
    method: str,
    parser: bool,
    chain: Sequence[tuple[str, BatchReply | None]],
) -> ProgramRecord | None:
    """Read the replies to an instruction's requests; None where one is missing."""
    spent: list[ProgramReply] = []
    steps: tuple[str, ...] | None = None
    program = error = None
    for stage, reply in chain:
        if reply is None:
            return None
        try:
            said = _completion(reply)
            spent.append(_spent(stage, said))
            if stage == "parse":
                steps = tuple(read_steps(said.text))
            else:
                program = read_program(said.text)
        except LanguageModelError as failure:
            error = str(failure)
            break
    return ProgramRecord(
        identifier, model, program, error, method, parser, steps, tuple(spent)
    )


def _completion(reply: BatchReply) -> Completion:
    if reply.completion is None:
        raise LanguageModelError(reply.error or "the language model did not answer")
    return reply.completion


def _spent(stage: str, said: Completion) -> ProgramReply:
    return ProgramReply(
        stage,
        said.text,
        said.usage.prompt_tokens,
        said.usage.completion_tokens,
        said.usage.cost_usd,
        said.latency,
    )


def _by_instruction(
    replies: Mapping[str, BatchReply], stage: str, variant: str
) -> dict[str, BatchReply]:
    """Return replies by instruction, all of one stage and variant."""
    found: dict[str, BatchReply] = {}
    for reply in replies.values():
        known = _ID.fullmatch(reply.id)
        if known is None or (known[1], known[2]) != (stage, variant):
            raise ProgramFileError(
                f"{reply.place}: expected the reply to a request {stage}{variant}/…, got "
                f"one to {reply.id!r}"
            )
        found[known[3]] = reply
    return found


def _variant(replies: Mapping[str, BatchReply]) -> str:
    first = next(iter(replies.values()))
    known = _ID.fullmatch(first.id)
    if known is None or known[1] != "program":
        raise ProgramFileError(
            f"{first.place}: expected the reply to a request for a program, as "
            f"`memorymaze prompts` writes them, got one to {first.id!r}"
        )
    return known[2]


def _model(replies: Iterable[BatchReply]) -> str:
    names = {r.completion.model for r in replies if r.completion and r.completion.model}
    if len(names) != 1:
        found = ", ".join(sorted(names)) or "none"
        raise ProgramFileError(
            f"expected replies that name one model, got {found}; say with --model how it "
            "is called in tables"
        )
    return names.pop()
