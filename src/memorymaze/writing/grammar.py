"""The grammar engine: drafts in words, as records with labels. Needs no model."""

from collections.abc import Iterable, Iterator

from memorymaze.instructions.error_kinds import meaning_of
from memorymaze.instructions.records import Failure, Instruction, Span
from memorymaze.instructions.statistics import word_count
from memorymaze.writing.drafting import Draft
from memorymaze.writing.marked_text import Marked
from memorymaze.writing.steps import Mistake
from memorymaze.writing.telling import Teller, Told, error_label

NEAR_ENOUGH = 3
"""Words between the wanted and the written length."""
REVISIONS = 3


def instructions_of(drafts: Iterable[Draft], *, paired: bool) -> Iterator[Instruction]:
    """Write drafts.

    Args:
        drafts: What is to be written.
        paired: Whether every text with errors is followed by the same text without.
    """
    for draft in drafts:
        yield from write_draft(draft, paired=paired)


def write_draft(draft: Draft, *, paired: bool) -> list[Instruction]:
    """Write a draft: its text, and with `paired` its right counterpart.

    The wanted length is that of the text with errors, as in Table I.
    """
    teller, told = _of_wanted_length(draft)
    pair = draft.id if paired and draft.mistakes else None
    written = [told_instruction(draft, told, pair=pair)]
    if pair is not None:
        right = teller.tell(draft.plan, draft.mistakes)
        written.append(told_instruction(draft, right, pair=pair, right=True))
    return written


def told_instruction(
    draft: Draft, told: Told, *, pair: str | None = None, right: bool = False
) -> Instruction:
    """Return the record of a text.

    Args:
        draft: What it was made from.
        told: Its words.
        pair: Shared with its counterpart; None without.
        right: Whether it is the counterpart without errors.
    """
    failures = () if right else draft.mistakes
    return Instruction(
        id=f"{draft.id}-right" if right else draft.id,
        site=draft.cell.site,
        route=draft.cell.route,
        study=draft.cell.study,
        iteration=draft.cell.iteration,
        participant=draft.participant,
        text=told.text,
        reference_route=draft.facts.route.id,
        failures=tuple(Failure(m.kind, m.where, m.detail) for m in failures),
        source="synthetic",
        language="en",
        split="test",
        pair=pair,
        spans=spans_of(told, draft.mistakes, alternative=draft.alternative),
        method="told",
    )


def spans_of(
    told: Told, mistakes: tuple[Mistake, ...], *, alternative: bool
) -> tuple[Span, ...]:
    """Return the labels of a text as records."""
    spans = [_span(each, mistakes) for each in told.marks]
    if alternative:
        whole = Span("alternative_way", 0, len(told.text), "the whole way", "")
        spans.insert(0, whole)
    return tuple(spans)


def _span(marked: Marked, mistakes: tuple[Mistake, ...]) -> Span:
    kind, _, rest = marked.label.partition("|")
    for number, mistake in enumerate(mistakes):
        if marked.label == error_label(number):
            return Span(
                mistake.kind, marked.start, marked.end, mistake.where, mistake.detail
            )
    return Span(kind, marked.start, marked.end, "", rest or meaning_of(kind))


def _of_wanted_length(draft: Draft) -> tuple[Teller, Told]:
    """Return the telling whose text, with its errors, is nearest to the wanted length."""
    goal, best = draft.words, None
    wanted = goal
    for _ in range(REVISIONS):
        teller = Teller(draft.plan, draft.voice, draft.seed, wanted)
        told = teller.tell(draft.told_plan, draft.mistakes)
        off = goal - word_count(told.text)
        if best is None or abs(off) < abs(best[0]):
            best = (off, teller, told)
        if abs(off) <= NEAR_ENOUGH:
            break
        wanted = max(5.0, wanted + off)
    assert best is not None
    return best[1], best[2]
