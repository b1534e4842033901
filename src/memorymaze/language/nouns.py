"""What nouns mean: synonyms and kinds, from WordNet and a table of building terms.

The data are read at the first look-up. How phrases are taken apart and compared is
in `noun_phrase.py` and `matching.py`.
"""

import gzip
import tomllib
from collections.abc import Iterator
from functools import cache, cached_property, lru_cache
from importlib.resources import files
from itertools import chain

_PLURAL_ENDINGS = (
    ("ies", "y"),
    ("ves", "f"),
    ("ves", "fe"),
    ("ches", "ch"),
    ("shes", "sh"),
    ("sses", "ss"),
    ("xes", "x"),
    ("zes", "z"),
    ("oes", "o"),
    ("men", "man"),
    ("s", ""),
    ("ses", "s"),
)
_IN_IE = frozenset({
    "brownies",
    "cookies",
    "movies",
    "pies",
    "selfies",
    "smoothies",
    "ties",
})
"""Plurals of words in ie, which look like those of words in y."""


FEW = 20
"""Other kinds of one kind that are near to each other; of more, any may be meant."""


class _Lexicon:
    """The data, read once.

    `nouns.txt.gz` is made by `scripts/build_wordnet_nouns.py`: four parts with form
    feeds between them. Line n of the first lists what meaning n is a kind of.
    """

    def __init__(self) -> None:
        data = files("memorymaze.language") / "data"
        packed = (data / "nouns.txt.gz").read_bytes()
        kinds, nouns, plurals, adjectives = (
            gzip.decompress(packed).decode("ascii").split("\f")
        )
        self._kinds = kinds.split("\n")
        self._nouns = dict(line.split("\t") for line in nouns.split("\n"))
        self.plurals = dict(line.split("\t") for line in plurals.split("\n"))
        self.adjectives = frozenset(adjectives.split("\n"))
        self._own_senses: dict[str, frozenset[int]] = {}
        self._own_kinds: dict[int, frozenset[int]] = {}
        self._cuts: dict[int, frozenset[int]] = {}
        self._artifact = self._listed("artifact")
        self._natural = self._listed("organism", "body part", "food")
        self._person = self._listed("someone")
        self._read_terms((data / "building_terms.txt").read_text(encoding="utf-8"))

    def senses(self, words: str) -> frozenset[int]:
        """Return the likely meanings of a word or fixed phrase; empty when unknown.

        Those marked as common and the first that is a made thing; no organism, part
        of one or food where the first of all is something else.
        """
        if own := self._own_senses.get(words):
            return own
        line = self._nouns.get(words)
        if line is None:
            return frozenset()
        marked = line.split(" ")
        every = [int(sense.rstrip("*")) for sense in marked]
        made = [sense for sense in every if self._is_kind_of(sense, self._artifact)]
        likely = {every[0], *made[:1]}
        likely.update(int(sense[:-1]) for sense in marked if sense.endswith("*"))
        if not self._is_kind_of(every[0], self._natural):
            likely = {s for s in likely if not self._is_kind_of(s, self._natural)}
        return frozenset(likely)

    def kin(self, word: str) -> tuple[str, ...]:
        """Return common words for the same thing, for its kinds, and for their few others."""
        senses = self.senses(word)
        above = {kind for sense in senses for kind in self._all_kinds(sense)}
        beside = [self._special_kinds.get(kind, []) for kind in sorted(above)]
        near = [*sorted(senses | above), *chain(*(s for s in beside if len(s) <= FEW))]
        found = chain(*(self._common_words.get(sense, []) for sense in near))
        return tuple(dict.fromkeys(other for other in found if other != word))

    def general(self, word: str) -> tuple[str, ...]:
        """Return a word for each of what a thing is a kind of, and what these are."""
        level, found = self.senses(word), list[str]()
        for _ in range(2):
            level = frozenset().union(*map(self._all_kinds, level))
            words = (self._common_words.get(kind, [])[:1] for kind in sorted(level))
            found += chain(*words)
        return tuple(dict.fromkeys(found))

    @cached_property
    def _special_kinds(self) -> dict[int, list[int]]:
        """The meanings that are directly a kind of one."""
        found: dict[int, list[int]] = {}
        for sense in sorted({*self._common_words, *self._own_kinds}):
            for general in self._all_kinds(sense):
                found.setdefault(general, []).append(sense)
        return found

    @cached_property
    def _common_words(self) -> dict[int, list[str]]:
        """The words that are often meant so."""
        found: dict[int, list[str]] = {}
        for word, senses in self._own_senses.items():
            for sense in senses:
                found.setdefault(sense, []).append(word)
        for word, line in self._nouns.items():
            for each in line.split(" "):
                if each.endswith("*") and word.isalpha():
                    found.setdefault(int(each[:-1]), []).append(word)
        return found

    def names_person(self, words: str) -> bool:
        """Tell whether a word means a person first of all, and not a machine."""
        if words in self._own_senses or words not in self._nouns:
            return False
        first, *_ = self._nouns[words].split(" ")
        if not self._is_kind_of(int(first.rstrip("*")), self._person):
            return False
        # "Printer" and "server" are people only in rare texts, "man" is a piece of chess.
        return first.endswith("*") or all(
            self._is_kind_of(sense, self._person) for sense in self.senses(words)
        )

    def _listed(self, *words: str) -> frozenset[int]:
        return frozenset(
            int(sense.rstrip("*"))
            for word in words
            for sense in self._nouns[word].split(" ")
        )

    def _is_kind_of(self, sense: int, kinds: frozenset[int]) -> bool:
        level, seen = {sense}, {sense}
        while level and level.isdisjoint(kinds):
            level = {kind for each in level for kind in self.kinds(each)} - seen
            seen |= level
        return bool(level)

    def kinds(self, sense: int) -> Iterator[int]:
        """Return what a meaning is directly a kind of."""
        cut = self._cuts.get(sense, ())
        return (kind for kind in self._all_kinds(sense) if kind not in cut)

    def _all_kinds(self, sense: int) -> frozenset[int]:
        own = self._own_kinds.get(sense, frozenset())
        if sense < len(self._kinds) and (line := self._kinds[sense]):
            own = own.union(map(int, line.split(" ")))
        return own

    def _read_terms(self, text: str) -> None:
        rules = [
            line.strip()
            for line in text.splitlines()
            if line.strip() and not line.startswith("#")
        ]
        broader: list[tuple[frozenset[int], list[str]]] = []
        for line in rules:
            if "!" in line:
                continue
            words, _, kinds = line.partition("<")
            synonyms = [word.strip().replace("'s ", " ") for word in words.split(",")]
            first = synonyms[0].removeprefix("+")
            senses = frozenset[int]() if first != synonyms[0] else self.senses(first)
            senses = senses or frozenset({len(self._kinds) + len(broader)})
            for word in (first, *synonyms[1:]):
                if word in self._own_senses:
                    raise ValueError(
                        f"building_terms.txt: expected each word once, got {word!r}"
                        " twice; take one out"
                    )
                self._own_senses[word] = senses
            broader.append((senses, [k.strip() for k in kinds.split(",") if k.strip()]))
        for senses, kinds in broader:
            above = frozenset[int]().union(*map(self._known, kinds))
            for sense in senses:
                self._own_kinds[sense] = above | self._own_kinds.get(sense, frozenset())
        for line in rules:
            word, cut, kind = (part.strip() for part in line.partition("!"))
            if cut:
                for sense in self._known(word):
                    known = self._cuts.get(sense, frozenset())
                    self._cuts[sense] = known | self._known(kind)

    def _known(self, words: str) -> frozenset[int]:
        senses = self.senses(words)
        if not senses:
            raise ValueError(
                f"building_terms.txt: expected a known noun, got {words!r};"
                " give it a line of its own above"
            )
        return senses


@cache
def _words() -> dict[str, dict[str, str]]:
    data = files("memorymaze.language") / "data" / "words.toml"
    return tomllib.loads(data.read_text(encoding="utf-8"))


def word_set(name: str) -> frozenset[str]:
    """Return a list of `words.toml`."""
    return frozenset(_words()["lists"][name].split())


def word_table(name: str) -> dict[str, list[str]]:
    """Return a table of `words.toml`: words by what they stand for."""
    return {key: words.split() for key, words in _words()[name].items()}


def family_of(name: str) -> dict[str, str]:
    """Return the key of each word of a table, the keys themselves included."""
    table = word_table(name)
    return {key: key for key in table} | {
        word: key for key, words in table.items() for word in words
    }


@cache
def _lexicon() -> _Lexicon:
    return _Lexicon()


@lru_cache(maxsize=50_000)
def is_noun(words: str) -> bool:
    """Tell whether a word or fixed phrase, in lower case, names a visible thing.

    >>> is_noun("vending machine"), is_noun("windowless")
    (True, False)
    """
    return bool(_levels(words))


def is_adjective(word: str) -> bool:
    """Tell whether a word in lower case is more common as an adjective than a noun.

    >>> is_adjective("modern"), is_adjective("coffee")
    (True, False)
    """
    return word in _lexicon().adjectives


@lru_cache(maxsize=20_000)
def singular(word: str) -> str:
    """Return the singular of a noun in lower case; other words as they are.

    >>> [singular(word) for word in ("shelves", "women", "movies", "glass", "2347")]
    ['shelf', 'woman', 'movie', 'glass', '2347']
    """
    lexicon = _lexicon()
    if word in lexicon.plurals:
        return lexicon.plurals[word]
    if word.endswith("ss") or len(word) < 3:
        return word
    if word in _IN_IE:
        return word[:-1]
    for ending, replacement in _PLURAL_ENDINGS:
        if word.endswith(ending):
            stem = word[: len(word) - len(ending)] + replacement
            if stem and lexicon.senses(stem):
                return stem
    if word.endswith("s") and not lexicon.senses(word) and len(word) > 3:
        return f"{word[:-3]}y" if word.endswith("ies") else word[:-1]
    return word


@lru_cache(maxsize=20_000)
def kin_of(noun: str) -> tuple[str, ...]:
    """Return words that people may say in place of a noun: for the same, its kind, its like.

    >>> "table" in kin_of("desk"), "counter" in kin_of("desk")
    (True, True)
    """
    return _lexicon().kin(noun)


@lru_cache(maxsize=20_000)
def general_words(noun: str) -> tuple[str, ...]:
    """Return more general words for what a noun names, the nearest first.

    >>> "furniture" in general_words("counter")
    True
    """
    return _lexicon().general(noun)


@lru_cache(maxsize=50_000)
def names_person(word: str) -> bool:
    """Tell whether a noun in lower case is a word for somebody, by what they are.

    >>> names_person("woman"), names_person("visitor"), names_person("printer")
    (True, True, False)
    """
    return _lexicon().names_person(word)


@lru_cache(maxsize=50_000)
def kind_distance(general: str, special: str) -> int | None:
    """Tell how many steps a noun is above another, None when it is not.

    0 for the same word or a synonym, 1 where `special` is a kind of `general`, and
    so on. Rare meanings do not count.

    >>> kind_distance("couch", "sofa"), kind_distance("furniture", "bench")
    (0, 2)
    >>> kind_distance("armchair", "chair") is None
    True
    """
    if general == special:
        return 0
    levels = _levels(general)
    meant = levels[0] if levels else frozenset[int]()
    return next(
        (steps for steps, level in enumerate(_levels(special)) if level & meant), None
    )


@lru_cache(maxsize=50_000)
def _levels(word: str) -> tuple[frozenset[int], ...]:
    """Return what a word means, what that is a kind of, what this is, up to the top."""
    lexicon = _lexicon()
    level = seen = lexicon.senses(word)
    levels: list[frozenset[int]] = []
    while level:
        levels.append(level)
        above = {kind for sense in level for kind in lexicon.kinds(sense)}
        level = frozenset(above - seen)
        seen |= level
    return tuple(levels)
