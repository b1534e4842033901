"""Words as numbers, as VLN-CE keeps them beside its texts."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

PADDING, UNKNOWN = 0, 1
TOKEN = re.compile(r"\w+|[^\w\s]")
SHORTEST = 200
"""Numbers per text at least, as in VLN-CE's preprocessed files."""


class WordNumbers:
    """A vocabulary: the words of some texts, the most frequent first."""

    def __init__(self, texts: Iterable[str]) -> None:
        """Number the words of texts; case does not count."""
        lists = [_tokens(text) for text in texts]
        counts = Counter(token for tokens in lists for token in tokens)
        ordered = sorted(counts, key=lambda word: (-counts[word], word))
        self.words = ["<pad>", "<unk>", *ordered]
        """Every word at the place of its number."""
        self.length = max([SHORTEST, *map(len, lists)])
        """Numbers that stand for one text, padding included."""
        self._numbers = {word: number for number, word in enumerate(self.words)}

    def numbers(self, text: str) -> list[int]:
        """Return a text as numbers, padded to the length of the longest."""
        found = [self._numbers.get(token, UNKNOWN) for token in _tokens(text)]
        return found + [PADDING] * (self.length - len(found))

    def record(self) -> dict[str, Any]:
        """Return VLN-CE's `instruction_vocab`."""
        return {
            "word_list": self.words,
            "word2idx_dict": self._numbers,
            "itos": self.words,
            "stoi": self._numbers,
            "num_vocab": len(self.words),
            "UNK_INDEX": UNKNOWN,
            "PAD_INDEX": PADDING,
        }


def _tokens(text: str) -> Sequence[str]:
    return TOKEN.findall(text.lower())
