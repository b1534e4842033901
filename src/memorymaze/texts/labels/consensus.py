"""What most annotators say, merged into instructions."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from memorymaze.texts.corpus.records import Failure, Instruction
from memorymaze.texts.labels.labels import NO_WAY, Label


@dataclass(frozen=True, slots=True)
class Consensus:
    """What most annotators say of an instruction."""

    instruction: str
    labels: int
    """How many annotators labelled it."""
    way: str | None
    """Id of the route described; None where no one way has most answers, or most say
    that it is none of the plan's."""
    failures: tuple[Failure, ...] | None
    """None where as many say that the text is right as that it is wrong, or where no
    kind of failure has most answers."""
    open: tuple[str, ...]
    """What is undecided, in words, with the answers given."""


def consensus(labels: Mapping[tuple[str, str], Label]) -> list[Consensus]:
    """Return the consensus on every labelled instruction, in the order of the labels.

    A way, or whether the text is right, is what more than half of its annotators say.
    Where most say that it is wrong, it has the kinds of failures that more than half of
    those name, else the kind that most of them name; place and detail are those of the
    first annotator who named it.
    """
    by_instruction: dict[str, list[Label]] = {}
    for label in labels.values():
        by_instruction.setdefault(label.instruction, []).append(label)
    return [_consensus_on(name, given) for name, given in by_instruction.items()]


def _consensus_on(instruction: str, given: Sequence[Label]) -> Consensus:
    undecided: list[str] = []
    way = _majority([each.way for each in given])
    if way is None:
        undecided.append(f"way: {_answers(each.way for each in given)}")
    elif way == NO_WAY:
        undecided.append("way: none of the plan's")
        way = None
    wrong = [each for each in given if each.failures]
    failures: tuple[Failure, ...] | None = None
    if 2 * len(wrong) < len(given):
        failures = ()
    elif 2 * len(wrong) == len(given):
        undecided.append(
            "has a failure: " + _answers("yes" if x.failures else "no" for x in given)
        )
    else:
        failures = _failures(wrong)
        if failures is None:
            kinds = (f.kind for each in wrong for f in each.failures)
            undecided.append(f"kind of failure: {_answers(kinds)}")
    return Consensus(instruction, len(given), way, failures, tuple(undecided))


def _majority(answers: Sequence[str]) -> str | None:
    [(answer, count)] = Counter(answers).most_common(1)
    return answer if 2 * count > len(answers) else None


def _failures(wrong: Sequence[Label]) -> tuple[Failure, ...] | None:
    first: dict[str, Failure] = {}
    counts: Counter[str] = Counter()
    for each in wrong:
        counts.update({failure.kind for failure in each.failures})
        for failure in each.failures:
            first.setdefault(failure.kind, failure)
    kinds = [kind for kind in first if 2 * counts[kind] > len(wrong)]
    if not kinds:
        most = max(counts.values())
        kinds = [kind for kind in first if counts[kind] == most]
        if len(kinds) > 1:
            return None
    return tuple(first[kind] for kind in kinds)


def _answers(answers: Iterable[str]) -> str:
    return ", ".join(f"{answer} ({n})" for answer, n in Counter(answers).most_common())


def merged(
    instructions: Iterable[Instruction], agreed: Iterable[Consensus]
) -> list[Instruction]:
    """Return instructions with the labels agreed on; what is open stays as it was."""
    by_id = {each.instruction: each for each in agreed}
    result: list[Instruction] = []
    for told in instructions:
        each = by_id.get(told.id)
        if each is not None and each.way is not None:
            told = replace(told, reference_route=each.way)
        if each is not None and each.failures is not None:
            told = replace(told, failures=each.failures)
        result.append(told)
    return result
