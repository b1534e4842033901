"""Take noun phrases apart: "red door of the library", "Professor's Office 2347".

This is grammar only; what words mean is in `lexicon.py` and `appearance.py`.
"""

import re
import unicodedata
from dataclasses import dataclass
from functools import lru_cache

from memorymaze.perception.lexicon import is_noun, singular, word_set

_DETERMINERS = word_set(
    "a an the this that these those any some all every each another other same",
    "one ones two three four five six seven eight nine ten several many few both",
    "first second third fourth fifth sixth seventh eighth ninth tenth next last",
    "nearest closest my your his her its our their more very really quite rather",
    "just only there here visible certain left right pointing leading going",
)
_STRAIGHT_QUOTES = str.maketrans("\u2018\u2019\u201c\u201d", "''\"\"")
_COMPLEMENT = word_set(
    "of for to into towards toward about showing depicting featuring advertising"
)
_SIDES = word_set("left right side end front back rear middle")
_PLACED = word_set(
    "on in at near next beside besides behind under underneath below above by",
    "with without against along across opposite between from facing outside",
    "inside around over past after before that which who where while beyond ahead",
    "straight up down left-hand right-hand through within standing hanging",
    "mounted sitting located attached",
)
_IDENTIFIER = re.compile(r"^(?:\d[\w-]*|[a-z]{1,2}-?\d+\w*|[b-z])$")
_NUMBER_SIGNS = frozenset({"number", "no", "nr"})
_COUNT = re.compile(r"^\d{1,2}$")
_ORDINAL = re.compile(r"^\d+(?:st|[nr]d|th)$")
_WORD = re.compile(r"[^\W_]+(?:['-][^\W_]+)*")
_EMPTY_WORDS = word_set(
    "a an the of for to and or in on at with by from is are your you we it please",
)


@dataclass(frozen=True, slots=True)
class NounPhrase:
    """One thing asked for, or one name given to a thing; words in lower case."""

    words: tuple[str, ...]
    """The words up to the head noun, which is the last; no articles."""
    complement: tuple[str, ...] = ()
    """Words after `of`, `for`, `to` and their like: what it belongs to or shows."""
    inscription: tuple[str, ...] = ()
    """Words that must be written on it."""
    identifiers: frozenset[str] = frozenset()
    """Numbers and letters that tell it from its like, such as `2347`."""

    @property
    def singulars(self) -> tuple[str, ...]:
        """The words, each in the singular."""
        return tuple(singular(word) for word in self.words)


@lru_cache(maxsize=20_000)
def words_of(text: str) -> tuple[str, ...]:
    """Return the words that carry meaning, lower case, singular, possessives bare.

    >>> words_of("The Women's RESTROOMS, 2nd floor")
    ('woman', 'restroom', '2nd', 'floor')
    """
    words = split_words(text)
    return tuple(
        singular(word)
        for position, word in enumerate(words)
        if word not in _EMPTY_WORDS or _is_letter_a(position, words)
    )


@lru_cache(maxsize=4096)
def parse_name(name: str) -> NounPhrase:
    """Take a category, proper name or inscription apart.

    >>> parse_name("Professor's Office 2347")
    NounPhrase(words=('professor', 'office'), complement=(), inscription=(), \
identifiers=frozenset({'2347'}))
    """
    return parse_words(split_words(name), count_first=False)


@lru_cache(maxsize=20_000)
def head_splits(words: tuple[str, ...]) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Return each way to see the end of a phrase as one noun, the longest first.

    Pairs of the noun, in the singular, and the words before it. The last word alone
    always counts; longer ends only where they are fixed phrases.

    >>> head_splits(("red", "vending", "machines"))
    (('vending machine', ('red',)), ('machine', ('red', 'vending')))
    """
    splits: list[tuple[str, tuple[str, ...]]] = []
    for start in range(len(words)):
        before, end = words[:start], words[start:]
        bare = (*end[:-1], singular(end[-1]))
        names = {" ".join(end), " ".join(bare), "".join(bare)}
        known = sorted(name for name in names if is_noun(name))
        splits.extend((name, before) for name in known)
        if len(end) == 1 and not known:
            splits.append((bare[0], before))
    return tuple(splits)


def plain_text(text: str) -> str:
    """Return a text in lower case, with straight quotes and without accents."""
    letters = unicodedata.normalize("NFKD", text.translate(_STRAIGHT_QUOTES))
    bare = "".join(each for each in letters if not unicodedata.combining(each))
    return bare.lower().strip(" .!?;:")


def split_words(text: str) -> list[str]:
    """Cut a text into words: possessives bare, "chest of drawers" in one piece.

    >>> split_words("The professor's chest of drawers")
    ['the', 'professor', 'chest of drawers']
    """
    words: list[str] = []
    for word in _WORD.findall(plain_text(text).replace("w.c", "wc").replace("_", " ")):
        if word.endswith("'s"):
            word = word[:-2]
        words.extend([word] if is_noun(word) else word.replace("'", "").split("-"))
    for i in range(len(words) - 2, 0, -1):
        if words[i] == "of" and is_noun(fixed := " ".join(words[i - 1 : i + 2])):
            words[i - 1 : i + 2] = [fixed]  # "chest of drawers"
    return words


def parse_words(words: list[str], *, count_first: bool) -> NounPhrase:
    """Find the head noun and what is said of it; where it stands is left out.

    Args:
        words: As `split_words` gives them.
        count_first: Whether a small number in front counts things ("2 doors").
    """
    identifiers: set[str] = set()
    before: list[str] = []
    complement: list[str] = []
    target, elsewhere = before, False
    for position, word in enumerate(words):
        if word in _COMPLEMENT and before and not elsewhere:
            target = complement
            elsewhere = not _SIDES.isdisjoint(words[position + 1 : position + 3])
        elif word in _PLACED and before:
            elsewhere = True
        elif _is_letter_a(position, words) and not elsewhere:
            identifiers.add(word)
        elif elsewhere or _is_empty(position, words, count_first=count_first):
            continue
        elif _IDENTIFIER.match(word) and (before or len(word) > 1):
            identifiers.add(word)
        else:
            target.append(word)
    return NounPhrase(tuple(before), tuple(complement), (), frozenset(identifiers))


def _is_letter_a(position: int, words: list[str]) -> bool:
    """Tell the letter of "Hall A" from the article."""
    return words[position] == "a" and 0 < position == len(words) - 1


def _is_empty(position: int, words: list[str], *, count_first: bool) -> bool:
    """Tell words that say nothing of the thing; "2 doors" from "room 2" too."""
    word = words[position]
    is_last = position == len(words) - 1
    if not is_last and is_noun(f"{word} {words[position + 1]}"):
        return False  # "first aid"
    if word in _DETERMINERS or word in _EMPTY_WORDS:
        return True
    if word in _NUMBER_SIGNS and not is_last:
        return bool(_IDENTIFIER.match(words[position + 1]))
    is_count = position == 0 and not is_last and _COUNT.match(word)
    return count_first and bool(is_count or _ORDINAL.match(word))
