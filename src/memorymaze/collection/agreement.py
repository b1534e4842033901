"""How far annotators agree, label by label, with intervals."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from memorymaze.collection.kappa import Kappa, cohens_kappa, fleiss_kappa
from memorymaze.collection.labels import NO_WAY, Label, text_stamp
from memorymaze.errors import LabelFileError
from memorymaze.instructions.records import Instruction
from memorymaze.sites.records import Site
from memorymaze.tables import Column, Row, Table

DRAWS = 2000
LEVEL = 0.95
UNDEFINED_DRAWS = 0.05
"""Share of draws without a kappa above which no interval is given."""

Labels = Mapping[tuple[str, str], Label]
"""By annotator and instruction."""
Read = Callable[[Label, Instruction, Mapping[str, Site]], str]


def _failing(label: Label, _told: Instruction, _sites: Mapping[str, Site]) -> str:
    return "failure" if label.failures else "right"


def _kinds(label: Label, _told: Instruction, _sites: Mapping[str, Site]) -> str:
    return "+".join(sorted({each.kind for each in label.failures})) or "right"


def _alternative(label: Label, told: Instruction, sites: Mapping[str, Site]) -> str:
    if label.way == NO_WAY:
        return "alternative"
    return sites[told.site].route(label.way).role


def _way(label: Label, _told: Instruction, _sites: Mapping[str, Site]) -> str:
    return label.way


QUESTIONS: dict[str, Read] = {
    "has a failure": _failing,
    "kinds of failures": _kinds,
    "alternative way": _alternative,
    "which way": _way,
}
"""What is compared: the answer that a label gives to each question."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """Agreement of annotators on one question."""

    question: str
    statistic: str
    """`Cohen` for two annotators, `Fleiss` for more."""
    items: int
    """Instructions that all of them labelled."""
    answers: int
    """Different answers that were given."""
    kappa: Kappa
    low: float | None
    """Lower end of the 95 % interval of kappa; None where it cannot be told."""
    high: float | None


def file_labels(
    instructions: Sequence[Instruction], annotator: str
) -> dict[tuple[str, str], Label]:
    """Return the labels that instructions carry, as those of an annotator."""
    return {
        (annotator, each.id): Label(
            each.id,
            text_stamp(each.text),
            annotator,
            each.reference_route,
            each.failures,
        )
        for each in instructions
    }


def agreement(
    labels: Labels,
    instructions: Sequence[Instruction],
    sites: Mapping[str, Site],
    rng: np.random.Generator,
) -> list[Agreement]:
    """Return how far annotators agree on every question.

    Only instructions that all of them labelled count. Intervals hold 95 % of 2,000
    draws of participants, with all their instructions, since the texts of one person
    resemble each other; there is none where more than 5 % of the draws have no kappa.

    Raises:
        LabelFileError: There are fewer than two annotators, or they share nothing.
    """
    annotators = list(dict.fromkeys(name for name, _ in labels))
    if len(annotators) < 2:
        raise LabelFileError(
            "expected labels by two annotators or more, got those of "
            f"{', '.join(annotators) or 'nobody'}"
        )
    shared = [
        each
        for each in instructions
        if all((name, each.id) in labels for name in annotators)
    ]
    if not shared:
        raise LabelFileError(
            f"expected instructions that {', '.join(annotators)} all labelled, got none"
        )
    people = list(dict.fromkeys(each.participant for each in shared))
    person = np.array([people.index(each.participant) for each in shared])
    weights = rng.multinomial(len(people), np.full(len(people), 1 / len(people)), DRAWS)
    return [
        _agreement(
            question,
            [
                [read(labels[name, each.id], each, sites) for name in annotators]
                for each in shared
            ],
            weights[:, person],
        )
        for question, read in QUESTIONS.items()
    ]


def _agreement(
    question: str, given: Sequence[Sequence[str]], weights: NDArray[np.int64]
) -> Agreement:
    """Compare answers, (items, annotators); `weights` are draws, (draws, items)."""
    answers = sorted({answer for item in given for answer in item})
    codes = np.array([[answers.index(answer) for answer in item] for item in given])
    measure = _cohen if codes.shape[1] == 2 else _fleiss
    drawn = [
        measure(np.repeat(codes, weight, axis=0), len(answers)).value
        for weight in weights
    ]
    values = [value for value in drawn if value is not None]
    low = high = None
    if len(values) >= (1 - UNDEFINED_DRAWS) * len(drawn):
        tail = (1 - LEVEL) / 2
        low, high = map(float, np.quantile(values, [tail, 1 - tail]))
    return Agreement(
        question=question,
        statistic="Cohen" if codes.shape[1] == 2 else "Fleiss",
        items=len(codes),
        answers=len(answers),
        kappa=measure(codes, len(answers)),
        low=low,
        high=high,
    )


def _cohen(codes: NDArray[np.int64], answers: int) -> Kappa:
    pairs = codes[:, 0] * answers + codes[:, 1]
    table = np.bincount(pairs, minlength=answers * answers)
    return cohens_kappa(table.reshape(answers, answers))


def _fleiss(codes: NDArray[np.int64], answers: int) -> Kappa:
    return fleiss_kappa(
        (codes[:, :, None] == np.arange(answers)).sum(axis=1, dtype=np.float64)
    )


def agreement_table(found: Sequence[Agreement], annotators: Sequence[str]) -> Table:
    """Return agreement as a table, one row per question."""
    undefined = any(each.kappa.value is None for each in found)
    said = "kappa -: everyone always gave the same answer, so it is not defined"
    return Table(
        f"{len(annotators)} annotators: {', '.join(annotators)}",
        (
            Column("label", "label", "label"),
            Column("n", "n"),
            Column("answers", "answers"),
            Column("agreement", "agreement", show=_percent),
            Column("statistic", "statistic"),
            Column("kappa", "kappa [95 %]", digits=3, interval=("low", "high")),
        ),
        tuple(
            {
                "label": each.question,
                "n": each.items,
                "answers": each.answers,
                "agreement": each.kappa.agreement,
                "statistic": each.statistic,
                "kappa": each.kappa.value,
                "low": each.low,
                "high": each.high,
            }
            for each in found
        ),
        (said,) if undefined else (),
        "agreement",
    )


def _percent(row: Row) -> str:
    return f"{100 * row['agreement']:.1f} %"
