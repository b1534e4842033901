"""The grammar engine: outlines in words, as records with labels. Needs no model."""

from memorymaze.texts.corpus.error_kinds import meaning_of
from memorymaze.texts.corpus.records import Failure, Instruction, Span
from memorymaze.texts.corpus.statistics import word_count
from memorymaze.texts.writing.marked_text import Marked
from memorymaze.texts.writing.sampling import Outline
from memorymaze.texts.writing.steps import Mistake
from memorymaze.texts.writing.telling import Teller, Told, error_label

NEAR_ENOUGH = 3
"""Words between the wanted and the written length."""
REVISIONS = 3


def write_texts(outline: Outline, *, paired: bool) -> list[Instruction]:
    """Write what an outline says: its text, and with `paired` its right counterpart.

    The wanted length is that of the text with errors, as in Table I.

    Args:
        outline: What is to be written.
        paired: Whether a text with errors is followed by the same text without.
    """
    teller, told = _of_wanted_length(outline)
    pair = outline.id if paired and outline.mistakes else None
    written = [told_instruction(outline, told, pair=pair)]
    if pair is not None:
        right = teller.tell(outline.plan, outline.mistakes)
        written.append(told_instruction(outline, right, pair=pair, right=True))
    return written


def told_instruction(
    outline: Outline, told: Told, *, pair: str | None = None, right: bool = False
) -> Instruction:
    """Return the record of a text, or with `right` of its counterpart without errors."""
    failures = () if right else outline.mistakes
    spans = [_span(each, outline.mistakes) for each in told.marks]
    if outline.alternative:
        whole = Span("alternative_way", 0, len(told.text), "the whole way", "")
        spans.insert(0, whole)
    return Instruction(
        id=f"{outline.id}-right" if right else outline.id,
        site=outline.cell.site,
        route=outline.cell.route,
        study=outline.cell.study,
        iteration=outline.cell.iteration,
        participant=outline.participant,
        text=told.text,
        reference_route=outline.facts.route.id,
        failures=tuple(Failure(m.kind, m.where, m.detail) for m in failures),
        source="synthetic",
        pair=pair,
        spans=tuple(spans),
        method="told",
    )


def _span(marked: Marked, mistakes: tuple[Mistake, ...]) -> Span:
    kind, _, rest = marked.label.partition("|")
    for number, mistake in enumerate(mistakes):
        if marked.label == error_label(number):
            return Span(
                mistake.kind, marked.start, marked.end, mistake.where, mistake.detail
            )
    return Span(kind, marked.start, marked.end, "", rest or meaning_of(kind))


def _of_wanted_length(outline: Outline) -> tuple[Teller, Told]:
    """Return the telling whose text, with its errors, is nearest to the wanted length."""
    goal, best = outline.words, None
    wanted = goal
    for _ in range(REVISIONS):
        teller = Teller(outline.plan, outline.voice, outline.seed, wanted)
        told = teller.tell(outline.told_plan, outline.mistakes)
        off = goal - word_count(told.text)
        if best is None or abs(off) < abs(best[0]):
            best = (off, teller, told)
        if abs(off) <= NEAR_ENOUGH:
            break
        wanted = max(5.0, wanted + off)
    assert best is not None
    return best[1], best[2]
