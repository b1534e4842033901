"""Word clouds, one per study and site."""

import io
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from zlib import crc32

from wordcloud import WordCloud

from memorymaze.instructions.statistics import FUNCTION_WORDS, tokens
from memorymaze.results.instruction_study.study import InstructionStudy

SIZE = (560, 340)
"""Pixels."""
MOST_WORDS = 120
COLORS = {
    "online": ("#0b3c7d", "#1d5fae", "#3a6fb0", "#14606e"),
    "onsite": ("#7c2305", "#a83a06", "#b8481c", "#7a4a12"),
}
OTHER_COLORS = ("#3f2a73", "#5d3aa8", "#6a4c8c", "#53306b")
"""Dark enough to be read on white."""
NAMED = 15
"""Words that are told to those who do not see the picture."""


@dataclass(frozen=True, slots=True)
class Cloud:
    """A word cloud."""

    study: str
    site: str
    texts: int
    png: bytes
    commonest: tuple[tuple[str, int], ...]
    """The words shown largest, with how often they occur."""


def word_clouds(study: InstructionStudy, *, seed: int) -> list[Cloud]:
    """Draw the words of every study and site, larger the more often they are said.

    Function words (the, you, then) are left out, as in the counting rule `content`;
    fillers such as "um" are not.

    Args:
        study: The statistics.
        seed: Of the placing; the same seed gives the same pictures.
    """
    texts: dict[tuple[str, str], list[str]] = {}
    for each in study.instructions:
        texts.setdefault((each.site, each.study), []).append(each.text)
    clouds: list[Cloud] = []
    for (site, name), told in sorted(texts.items()):
        counts = Counter(
            word
            for text in told
            for word in tokens(text)
            if len(word) > 1 and word not in FUNCTION_WORDS
        )
        if not counts:
            continue
        # Equal counts are put in order of the alphabet, so that nothing is left to the
        # order of the texts.
        ordered = sorted(counts.items(), key=lambda each: (-each[1], each[0]))
        cloud = WordCloud(
            width=SIZE[0],
            height=SIZE[1],
            scale=2,
            background_color="white",
            color_func=_painter(COLORS.get(name, OTHER_COLORS)),
            max_words=MOST_WORDS,
            prefer_horizontal=0.95,
            random_state=seed,
        ).generate_from_frequencies(dict(ordered[:MOST_WORDS]))
        clouds.append(Cloud(name, site, len(told), _png(cloud), tuple(ordered[:NAMED])))
    return clouds


def _painter(colors: Sequence[str]) -> Callable[..., str]:
    def paint(word: str, **_: object) -> str:
        return colors[crc32(word.encode()) % len(colors)]

    return paint


def _png(cloud: WordCloud) -> bytes:
    picture = io.BytesIO()
    cloud.to_image().quantize(48).save(picture, "PNG", optimize=True)
    return picture.getvalue()
