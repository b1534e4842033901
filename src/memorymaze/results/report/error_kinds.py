"""How runs fare on instructions with errors, by kind of error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.records import Failure, Instruction
from memorymaze.results.report.sources import ReportRun
from memorymaze.results.tables.bootstrap import Estimate, estimate_means

NONE = "none"
ANY = "any"


@dataclass(frozen=True, slots=True)
class FaultyInstruction:
    """An error of an instruction, and what became of the episode."""

    instruction: Instruction
    failure: Failure
    results: tuple[EpisodeResult | None, ...]
    """One per run; None where a run has none."""


@dataclass(frozen=True, slots=True)
class ErrorKind:
    """Instructions with a kind of error; one with several kinds is in each."""

    kind: str
    """`none` and `any` for those without and with an error."""
    instructions: int
    measured: tuple[tuple[int, dict[str, Estimate]] | None, ...]
    """Per run the number of episodes and the means; None where it has none."""
    examples: tuple[FaultyInstruction, ...]


def error_kinds(
    runs: Sequence[ReportRun], instructions: Mapping[str, Instruction]
) -> list[ErrorKind]:
    """Return results by kind of error: without, with any, then the commonest first.

    Only episodes whose instruction file was found count.
    """
    results: list[dict[str, list[EpisodeResult]]] = []
    for run in runs:
        by_instruction: dict[str, list[EpisodeResult]] = {}
        for each in run.measured.results:
            by_instruction.setdefault(each.instruction_id, []).append(each)
        results.append(by_instruction)
    followed = sorted({
        each.instruction_id
        for run in runs
        for each in run.measured.results
        if each.instruction_id in instructions
    })
    groups: dict[str, list[Instruction]] = {NONE: [], ANY: []}
    for name in followed:
        told = instructions[name]
        kinds = dict.fromkeys(failure.kind for failure in told.failures)
        for kind in (ANY, *kinds) if kinds else (NONE,):
            groups.setdefault(kind, []).append(told)
    general = [(kind, groups.pop(kind)) for kind in (NONE, ANY)]
    by_size = sorted(groups.items(), key=lambda each: (-len(each[1]), each[0]))
    return [_kind(kind, told, results) for kind, told in (*general, *by_size) if told]


def kind_title(kind: str) -> str:
    """Return a kind of error as it is written: `no error`, `missing turn`."""
    general = {NONE: "no error", ANY: "any error"}
    return general.get(kind, kind.replace("_", " "))


def _kind(
    kind: str,
    told: Sequence[Instruction],
    results: Sequence[Mapping[str, Sequence[EpisodeResult]]],
) -> ErrorKind:
    measured: list[tuple[int, dict[str, Estimate]] | None] = []
    for of_run in results:
        cell = [result for each in told for result in of_run.get(each.id, ())]
        measured.append((len(cell), estimate_means([cell])) if cell else None)
    examples = [
        FaultyInstruction(
            each,
            failure,
            tuple(next(iter(of_run.get(each.id, ())), None) for of_run in results),
        )
        for each in told
        for failure in each.failures
        if failure.kind == kind
    ]
    return ErrorKind(kind, len(told), tuple(measured), tuple(examples))
