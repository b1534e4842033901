"""Episodes that hand over both tellings of a way by one person, as one text."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from memorymaze.agents.agent import TOLD_AGAIN
from memorymaze.basics.errors import SettingsError
from memorymaze.texts.corpus.records import Corpus, Episode, Instruction, Span


def with_second_tellings(corpus: Corpus) -> Corpus:
    """Return the corpus of a person's two tellings, an episode for each second one.

    Scored against the way that the second telling describes; texts without a second or a
    first telling are left out.
    """
    tellings = _tellings(corpus.instructions)
    paired = tuple(
        replace(episode, instruction=_joined(*both), tellings=both)
        for episode in corpus.episodes
        for both in tellings
        if both[1].id == episode.instruction.id
    )
    if not paired:
        raise SettingsError(
            f"second telling: expected texts of people who told a way twice (iteration 1 "
            f"and 2), got none in {corpus.name}"
        )
    return replace(corpus, episodes=paired)


def texts_told_once(all_of: Sequence[Episode], paired: Sequence[Episode]) -> int:
    """Return how many texts are in no pair."""
    texts = {each.instruction.id for each in all_of}
    return len(texts.difference(told.id for each in paired for told in each.tellings))


def _tellings(
    instructions: Iterable[Instruction],
) -> list[tuple[Instruction, Instruction]]:
    found: dict[tuple[object, ...], tuple[list[Instruction], list[Instruction]]] = {}
    for each in instructions:
        # The same text without its errors, which a generator made, is another person's.
        is_mended = each.pair is not None and not each.failures
        key = (each.study, each.participant, each.site, each.route, is_mended)
        found.setdefault(key, ([], []))[each.iteration - 1].append(each)
    pairs: list[tuple[Instruction, Instruction]] = []
    for first, second in found.values():
        if first and second and len(first) + len(second) > 2:
            names = ", ".join(each.id for each in (*first, *second))
            raise SettingsError(
                "second telling: expected a single text of each iteration by participant "
                f"{first[0].participant!r} for {first[0].site} {first[0].route}, got {names}"
            )
        pairs += zip(first, second, strict=False)
    return pairs


def _joined(first: Instruction, second: Instruction) -> Instruction:
    """Return both tellings as one instruction, which has an id of its own.

    So no answer that was given to one telling alone is taken for both.
    """
    begin = len(first.text) + len(TOLD_AGAIN)
    return replace(
        second,
        id=f"{first.id}+{second.id}",
        text=first.text + TOLD_AGAIN + second.text,
        failures=(*first.failures, *second.failures),
        spans=(*first.spans, *(_moved(each, begin) for each in second.spans)),
        split="dev" if "dev" in (first.split, second.split) else second.split,
        original_text=None,
        followers=None,
        pair=None,
    )


def _moved(span: Span, characters: int) -> Span:
    return replace(span, start=span.start + characters, end=span.end + characters)
