"""How far annotators agree, label by label, beyond chance and with intervals.

Cohen's and Fleiss' kappa both are (agreement - expected) / (1 - expected); they differ in
what they expect of annotators who answer by chance.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.basics.errors import LabelFileError
from memorymaze.basics.tables import Column, Row, Table
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.labels.labels import NO_WAY, Label, text_stamp
from memorymaze.world.sites.records import Site

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
    return sites[told.site].find_route(label.way).role


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
class Kappa:
    """Agreement of annotators on one label."""

    agreement: float
    """Share of pairs of answers that are equal, 0 to 1."""
    expected: float
    """The same if everyone answered by chance, as often each answer as they do."""

    @property
    def value(self) -> float | None:
        """Kappa, up to 1; None where everyone always gives the same answer."""
        if self.expected >= 1.0:
            return None
        return (self.agreement - self.expected) / (1.0 - self.expected)


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
        _agreement_on(
            question,
            [
                [read(labels[name, each.id], each, sites) for name in annotators]
                for each in shared
            ],
            weights[:, person],
        )
        for question, read in QUESTIONS.items()
    ]


def _agreement_on(
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
    kappas = [(each.kappa.value, each.low, each.high) for each in found]
    notes = {
        "-: everyone always gave the same answer, so kappa is not defined": any(
            kappa is None for kappa, _, _ in kappas
        ),
        "too few: drawn again, the texts often have one answer alone, so no interval can "
        "be told": any(kappa is not None and low is None for kappa, low, _ in kappas),
        "no spread: every draw of texts gives the same kappa; that does not make it "
        "certain": any(low is not None and low == high for _, low, high in kappas),
    }
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
        tuple(note for note, is_said in notes.items() if is_said),
        "agreement",
    )


def _percent(row: Row) -> str:
    return f"{100 * row['agreement']:.1f} %"


def cohens_kappa(table: ArrayLike) -> Kappa:
    """Return Cohen's kappa of two annotators.

    Source: Cohen 1960, "A Coefficient of Agreement for Nominal Scales", Educational and
    Psychological Measurement 20. Each annotator keeps their own shares of answers.

    >>> round(cohens_kappa([[20, 5], [10, 15]]).value, 6)
    0.4

    The table says how often the first gave answer i and the second answer j, (k, k), all
    >= 0; they need not be whole.
    """
    counts = _counts(table)
    if counts.shape[0] != counts.shape[1]:
        raise ValueError(f"expected a square table, got shape {counts.shape}")
    shares = counts / counts.sum()
    chance = float(shares.sum(axis=0) @ shares.sum(axis=1))
    return _kappa(float(np.trace(shares)), chance)


def fleiss_kappa(answers: ArrayLike) -> Kappa:
    """Return Fleiss' kappa of any number of annotators, the same number for each item.

    Source: Fleiss 1971, "Measuring Nominal Scale Agreement among Many Raters",
    Psychological Bulletin 76. All annotators share their shares of answers.

    >>> fleiss_kappa([[2, 0], [0, 2], [2, 0], [1, 1]]).agreement
    0.75

    The answers say how many annotators gave item i the answer j, (n, k).
    """
    counts = _counts(answers)
    raters = counts.sum(axis=1)
    if raters.min() < 2 or np.ptp(raters) > 0:
        raise ValueError(
            "expected the same number of answers, two or more, for every item, got "
            f"{raters.min():g} to {raters.max():g}"
        )
    number = raters[0]
    pairs = (counts * (counts - 1)).sum(axis=1) / (number * (number - 1))
    shares = counts.sum(axis=0) / counts.sum()
    return _kappa(float(pairs.mean()), float(shares @ shares))


def _counts(table: ArrayLike) -> NDArray[np.float64]:
    counts = np.asarray(table, dtype=np.float64)
    if counts.ndim != 2 or counts.size == 0:
        raise ValueError(f"expected a table of two dimensions, got {counts.shape}")
    if not np.isfinite(counts).all() or counts.min() < 0 or counts.sum() == 0:
        raise ValueError("expected numbers >= 0 that are not all 0")
    return counts


def _kappa(agreement: float, chance: float) -> Kappa:
    # Rounding must not make 0.9999999999999999 of an expectation that is 1.
    certain = np.isclose(chance, 1.0, rtol=0, atol=1e-12)
    return Kappa(agreement, 1.0 if certain else chance)
