"""Misspelt words, read for the words that descriptions of ways are made of.

Only a word that is nothing else is changed, and only into one of the words that speakers
use all the time; so names of things stay as they are written.
"""

import re
from functools import cache, lru_cache

from memorymaze.language.nouns import is_adjective, is_noun, singular
from memorymaze.language.reading.vocabulary import (
    FILLERS,
    LOOKS,
    OFTEN,
    ONES,
    ORDINALS,
    PATTERNS,
    PLAIN,
    PLURALS,
    SIGNS,
    SPELLINGS,
    SURFACES,
    TENS,
)

_LONG = 10
"""Letters from which on twice as many slips of the pen are forgiven."""
_TOO_MANY = 1.5
"""Slips that make another word."""
_VERBS = "TGK"
"""Kinds of pattern whose words are verbs, which are no names and not misspelt."""
_VOWEL = 0.6
"""Of a slip: what a wrong vowel, or one letter twice, is."""
_WRITTEN = re.compile(
    r"(?:(?<=[.!?\n] )|(?<=^))[A-Z][a-z]{3,}\b(?!['-])|(?<![\w'-])[a-z]{4,}(?![\w'-])"
)
"""Words that may be misspelt; a capital within a sentence makes a name."""
_ENDINGS = re.compile(r"(?:ing|ed|er|est|s|es|d)$")


def spelt(text: str) -> str:
    """Return a text with its misspelt words as they were meant.

    >>> spelt("At the intersecton turn laft to the aesal near Larft Hall.")
    'At the intersection turn left to the easel near Larft Hall.'
    """
    return _WRITTEN.sub(lambda match: _meant(match[0].lower(), match[0]), text)


@lru_cache(maxsize=20_000)
def _meant(word: str, written: str) -> str:
    if _is_known(word):
        return written
    near = sorted((_slips(word, each), each) for each in OFTEN)
    likeliest = [each for each in near if each[0] == near[0][0]]
    return written if near[0][0] >= _TOO_MANY or len(likeliest) > 1 else near[0][1]


def _is_known(word: str) -> bool:
    stem = _ENDINGS.sub("", word)
    return (
        word in _words()
        or any(each.work in _VERBS and each.regex.fullmatch(word) for each in PATTERNS)
        or is_noun(word)
        or is_adjective(word)
        or is_noun(singular(word))
        or any(form in _words() or is_noun(form) for form in (stem, stem + "e"))
    )


@cache
def _words() -> frozenset[str]:
    lists = (FILLERS, LOOKS, PLAIN, PLURALS, SIGNS, SURFACES, OFTEN)
    tables = (ONES, ORDINALS, SPELLINGS, TENS)
    return frozenset().union(*lists, *tables)


def _slips(word: str, meant: str) -> float:
    """Return how many letters have to be changed, wrong vowels counting less.

    People rarely mistake the first letter, unless for the second.
    """
    first = word[0] == meant[0] or sorted(word[:2]) == sorted(meant[:2])
    if not first or abs(len(word) - len(meant)) > 1:
        return _TOO_MANY
    slips = float(_distance(word, meant))
    if _consonants(word) == _consonants(meant):
        slips *= _VOWEL
    return slips if min(len(word), len(meant)) < _LONG else slips / 2


def _consonants(word: str) -> str:
    return re.sub(r"[aeiouy]|(.)(?=\1)", "", word)


def _distance(a: str, b: str) -> int:
    """Return the least number of letters added, left out, changed or swapped."""
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        two_before, before = before, row
        row = [i]
        for j, y in enumerate(b, 1):
            cost = min(before[j] + 1, row[-1] + 1, before[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and y == a[i - 2]:
                cost = min(cost, two_before[j - 2] + 1)
            row.append(cost)
    return row[-1]
