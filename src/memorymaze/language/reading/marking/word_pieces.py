"""Words of a text, and the pieces of them that the network knows."""

import re
import unicodedata
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

_WORD = re.compile(r"\w+(?:['\u2019]\w+)*|[^\w\s]")
_PART = re.compile(r"\w+|[^\w\s]")
_SENTENCE_ENDS = frozenset(".!?:;")
_PLAIN_SIGNS = str.maketrans("\u2019\u2018\u201c\u201d\u2014\u2013\u2026", "''\"\"--.")
LONGEST_WORD = 100
"""Letters of a word; longer ones are unknown."""
UNKNOWN, BEGIN, END = "[UNK]", "[CLS]", "[SEP]"
PLAIN, NAME, FIRST_OF_SENTENCE, CAPITALS = range(4)


class Word(NamedTuple):
    """A word or a mark of punctuation, with where it stands in its text."""

    text: str
    start: int
    end: int


def words_in(text: str) -> list[Word]:
    """Return the words of a text in order."""
    return [Word(each[0], each.start(), each.end()) for each in _WORD.finditer(text)]


def cases_of(words: Sequence[Word]) -> list[int]:
    """Return how each word is written: a capital within a sentence tells a name."""
    cases: list[int] = []
    first = True
    for word in words:
        cases.append(_case_of(word.text, first=first))
        first = word.text in _SENTENCE_ENDS
    return cases


def _case_of(word: str, *, first: bool) -> int:
    if word.isupper() and len(word) > 1:
        return CAPITALS
    if word[0].isupper():
        return FIRST_OF_SENTENCE if first else NAME
    return PLAIN


class WordPieces:
    """Cuts words into the longest pieces of a vocabulary, from the left.

    Wu et al. 2016, "Google's Neural Machine Translation System" (WordPiece), in lower
    case and without accents, as BERT has it.
    """

    def __init__(self, vocabulary: Sequence[str]) -> None:
        """Take all pieces in order; those within a word begin with `##`."""
        self._numbers = {piece: number for number, piece in enumerate(vocabulary)}
        self._longest = max(map(len, vocabulary))
        self.of = lru_cache(maxsize=20_000)(self._of)
        self.begin, self.end = self._numbers[BEGIN], self._numbers[END]

    def _of(self, word: str) -> tuple[int, ...]:
        """Return the pieces of a word."""
        plain = unicodedata.normalize("NFD", word.lower().translate(_PLAIN_SIGNS))
        plain = "".join(c for c in plain if unicodedata.category(c) != "Mn")
        parts = [piece for part in _PART.findall(plain) for piece in self._cut(part)]
        return tuple(parts) or (self._numbers[UNKNOWN],)

    def _cut(self, part: str) -> list[int]:
        if len(part) > LONGEST_WORD:
            return [self._numbers[UNKNOWN]]
        pieces: list[int] = []
        start = 0
        while start < len(part):
            for end in range(min(len(part), start + self._longest), start, -1):
                piece = self._numbers.get("##" * (start > 0) + part[start:end])
                if piece is not None:
                    break
            else:
                return [self._numbers[UNKNOWN]]
            pieces.append(piece)
            start = end
        return pieces
