"""Take noun phrases apart: names of things, and requests for them.

"please look for the red door of the library", "Professor's Office 2347". This is grammar
only; what words mean is in `lexicon.py` and `appearance.py`.
"""

import re
import unicodedata
from dataclasses import dataclass, replace
from functools import lru_cache

from memorymaze.language.nouns import is_adjective, is_noun, singular, word_set

_DETERMINERS = word_set("determiners")
_STRAIGHT_QUOTES = str.maketrans("\u2018\u2019\u201c\u201d", "''\"\"")
_COMPLEMENT = word_set("complements")
_SIDES = word_set("sides")
_PLACED = word_set("placed")
_IDENTIFIER = re.compile(r"^(?:\d[\w-]*|[a-z]{1,2}-?\d+\w*|[b-z])$")
_NUMBER_SIGNS = frozenset({"number", "no", "nr"})
_COUNT = re.compile(r"^\d{1,2}$")
_ORDINAL = re.compile(r"^\d+(?:st|[nr]d|th)$")
_WORD = re.compile(r"[^\W_]+(?:['-][^\W_]+)*")
_EMPTY_WORDS = word_set("empty")
_LEAD_IN = re.compile(
    r"^(?:(?:please|hey|ok(?:ay)?|robot,|can|could|do|does|did|would|you|i|we|to|now|is|"
    r"are|was|there|find|detect|locate|see|want|need|try|what|where|which|looks?|like|"
    r"such|as|for|whether|if|something|anything|visible|"
    r"(?:look|search|check|show|spot|notice|watch|scan|looking|searching)(?=\s+(?:me|for|"
    r"if|whether|at|out|a|an|the|any|some)\b)|me|at|out)\b[,:]?\s+)+"
)
_PARTITIVE = re.compile(
    r"\b(?:pairs?|rows?|sets?|groups?|bunch|banks?|lines?|couple|flights?|series|"
    r"stacks?|piles?|number|collection|kind|sort|type|piece|lots?|cluster) of\b"
)
_SAYS = re.compile(
    r"(?:^|\s)(?:(?:that|which|and)\s+)?(?:"
    r"says?|saying|reads|that read|inscribed|labell?ed|marked|(?:en)?titled|named|called|"
    r"numbered|reading(?!\s+(?:room|area|corner|lamp|table|nook))|"
    r"(?:with|bearing|has|having|showing|displaying)\s+(?:the |a |an )?(?:words?|text|"
    r"label|sign|name|number|letters?|title|inscription|writing|lettering)"
    r"(?:\s+(?:that says|that reads|saying|reading|of|for))?"
    r")(?:\s+(?:as|with|the (?:words?|text|name|number)|something like))*"
    r"\s*:?(?=\s|$)"
)
_WRITTEN_ON = re.compile(
    r"\s(?:with|has|having) (?P<words>.+?) (?:written|printed|painted|posted|engraved)"
    r"\s+on (?:it|them)$|\s(?:with|having) (?P<number>\w*\d\w*) on (?:it|them)$"
)
_AFTER_WORDS = re.compile(
    r"\s+(?:(?:written |printed |painted )?on (?:it|them|top|the (?:left|right|wall|door|"
    r"other side|side))|on (?:your|my|our) (?:left|right)|in (?:red|blue|green|white|black"
    r"|yellow|big|large|capital|bold) letters?|next to .*|above .*|near .*|beside .*)$"
)
_QUOTED = re.compile(r"\"([^\"]+)\"|(?<!\w)'([^']+(?:'s [^']+)*)'(?!\w)")
_MADE_OF = re.compile(
    r"\s(?:that|which)\s+(?:is|are|looks?)\s+|\s(?:made|built)\s+(?:out\s+)?(?:of|from)\s+|"
    r"\s(?:painted|coloured|colored)\s+(?:in\s+)?"
)
_ALTERNATIVES = re.compile(r"\s*(?:,|/|\bor\b|\band/or\b)\s*")


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

    `count_first` says whether a small number in front counts things ("2 doors").
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


def without_lead_in(request: str) -> str:
    """Return what is asked for, in lower case, without "please look for" and the like.

    >>> without_lead_in("Can you see a couch?")
    'a couch'
    """
    return _LEAD_IN.sub("", plain_text(request))


@lru_cache(maxsize=4096)
def parse_request(request: str) -> tuple[NounPhrase, ...]:
    """Take a request apart into the things it would accept.

    >>> [phrase.words for phrase in parse_request("a couch or any red arm chairs")]
    [('couch',), ('red', 'arm', 'chairs')]
    >>> parse_request('door labelled "Mail Room"')[0].inscription
    ('mail', 'room')
    """
    text = _PARTITIVE.sub(" ", without_lead_in(request)).strip()
    said: list[str] = []

    def keep(found: re.Match[str]) -> str:
        said.append(found[1] or found[2])
        return " "

    rest = _QUOTED.sub(keep, text)
    if not said and (found := _WRITTEN_ON.search(rest)):
        said.append(found["words"] or found["number"])
        rest = rest[: found.start()]
    if said:
        rest = _SAYS.sub(" ", rest)
    elif (found := _SAYS.search(rest)) and split_words(rest[: found.start()]):
        said.append(_AFTER_WORDS.sub("", rest[found.end() :]))
        rest = rest[: found.start()]
    inscription = words_of(" ".join(said))
    parts = [part for part in _alternatives(rest) if split_words(part)] or [""]
    phrases = [parse_words(_described_before(part), count_first=True) for part in parts]
    return tuple(replace(phrase, inscription=inscription) for phrase in phrases)


def _alternatives(text: str) -> list[str]:
    """Cut at "or", commas and slashes; at "and" where it joins things, not colours."""
    parts: list[str] = []
    for part in _ALTERNATIVES.split(text):
        joined = part.split(" and ")
        ends = [words[-1] for words in map(split_words, joined) if words]
        if all(is_noun(singular(end)) and not is_adjective(end) for end in ends):
            parts.extend(joined)
        else:
            parts.append(part)
    return parts


def _described_before(text: str) -> list[str]:
    """Put "that is red", "made of wood" and "painted green" before the noun."""
    parts = [split_words(part) for part in _MADE_OF.split(" " + text)]
    return [word for part in parts[1:] for word in part] + parts[0]
