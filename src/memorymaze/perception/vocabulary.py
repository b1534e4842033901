"""Open-vocabulary matching of what someone asks for with what a thing is.

The request may be any English noun phrase; nothing here knows of a building. How a
phrase is taken apart is in `noun_phrase.py`, what its words mean in `lexicon.py` and
`appearance.py`. `docs/perception.md` has the rules in prose.
"""

from functools import lru_cache

from memorymaze.perception.appearance import appearance_score, is_appearance_word
from memorymaze.perception.lexicon import (
    is_adjective,
    is_noun,
    kind_distance,
    singular,
    word_set,
)
from memorymaze.perception.noun_phrase import (
    NounPhrase,
    head_splits,
    parse_name,
    parse_request,
    words_of,
)
from memorymaze.perception.visible_object import ObjectDescription

__all__ = ["MATCH_THRESHOLD", "match_score"]

MATCH_THRESHOLD = 0.5
"""A thing is found when its score is at least this."""

_BY_NAME = 0.9
"""A proper name asked for as if it were a kind ("library", for its door)."""
_BY_SUBJECT = 0.7
"""What a thing shows, holds or names ("rocket" for a rocket model)."""
_BY_WORDS = 0.65
"""Words written on a thing, asked for as if they were the thing."""
_PLAIN_WORD = 0.9
"""Factor for a describing word nothing is known about ("modern")."""

_SIZE_WORDS = word_set(
    "big large small little tall huge giant long short tiny wide narrow massive",
    "double single main old new nice public regular normal typical whole",
)
_PLACE_WORDS = word_set(
    "wall floor ceiling corner corridor hallway hall lobby indoor outdoor side",
    "building museum university campus",
)
"""Where a thing is, which the picture does not tell: no reason to reject it."""
_SHOWING = word_set(
    "model statue sculpture bust skeleton skull replica figure picture painting",
    "poster photo photograph mural exhibit display sign signboard banner panel",
    "board panel box cabinet case station unit dispenser machine plaque plate",
    "window",
)
"""Heads of compounds whose first part is what people see: "whale skeleton"."""
_SIGN_WORDS = word_set(
    "sign signboard label plate nameplate plaque lettering text writing word",
    "banner notice board panel",
)
_PLACES = ("room", "building", "facility", "establishment", "stairway")
_SHORT_TEXT = 4
"""Inscriptions of up to so many words name a thing; longer ones tell of others."""
_PEOPLE = (
    frozenset({"man", "gent", "gentleman", "male", "boy"}),
    frozenset({"woman", "lady", "female", "girl"}),
)


@lru_cache(maxsize=50_000)
def match_score(request: str, description: ObjectDescription) -> float:
    """Return how well a thing fits an English request, 0 to 1.

    Below `MATCH_THRESHOLD` it is another thing. Kinds match what they are asked for
    by a more general word, never by a more special one; colours and materials must
    not contradict; words and numbers asked for must be written on it or be its name.

    >>> sofa = ObjectDescription("sofa", color="dark red")
    >>> match_score("a red couch", sofa), match_score("blue couch", sofa)
    (1.0, 0.0)
    """
    whole = words_of(request)
    if len(whole) > 1:
        for known in (description.name, description.text):
            if known and words_of(known) == whole:
                return 1.0
    return max(_phrase_score(phrase, description) for phrase in parse_request(request))


def _phrase_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    written = frozenset(words_of(f"{thing.name or ''} {thing.text or ''}"))
    if not phrase.identifiers <= written:
        return 0.0
    said = written.union(words_of(thing.category))
    if not all(_stands_for(word, said) for word in phrase.inscription):
        return 0.0
    if not phrase.words:
        return _BY_NAME if phrase.inscription or phrase.identifiers else 0.0
    return max(
        _kind_score(phrase, thing),
        _name_score(phrase, thing),
        _bearer_score(phrase, thing),
    )


def _kind_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Compare the head noun with the thing's category, then all said of it."""
    category = parse_name(thing.category)
    splits = head_splits(phrase.words)
    best = 0.0
    for head, before in splits:
        base = _category_score(head, category)
        if base > best:
            fixed = len(before) > len(splits[0][1])
            factor = _qualities_score(before, phrase.complement, thing, fixed=fixed)
            best = max(best, base * factor)
    return best


def _category_score(head: str, category: NounPhrase) -> float:
    """Compare a noun with a category: kinds first, then what the category shows."""
    names = head_splits(category.words)
    distances = [
        distance
        for name, before in names
        if before == names[0][1] and (distance := kind_distance(head, name)) is not None
    ]
    if distances:
        steps = min(distances)
        return 1.0 if steps == 0 else max(0.7, 0.95 - 0.05 * steps)
    subject = category.complement or category.words[:-1]
    if not subject or category.singulars[-1] not in _SHOWING:
        return 0.0
    if len(category.words) - len(names[0][1]) > 1:  # a fixed phrase: "display case"
        return _BY_SUBJECT if head in category.singulars[:-1] else 0.0
    return _BY_SUBJECT if _category_score(head, NounPhrase(subject)) > 0 else 0.0


def _qualities_score(
    before: tuple[str, ...],
    complement: tuple[str, ...],
    thing: ObjectDescription,
    *,
    fixed: bool,
) -> float:
    """Return the factor for the words before the head noun and after `of` or `for`.

    `fixed` says that they belong to a fixed phrase with the head ("white board"), so
    that each must be found on the thing.
    """
    kind = words_of(thing.category)
    written = frozenset(words_of(f"{thing.name or ''} {thing.text or ''}"))
    looks = [w for w in before if is_appearance_word(w) and w not in written | {*kind}]
    if fixed and looks:
        return 0.0
    score = appearance_score(" ".join(looks), thing.color, thing.material)
    said = written.union(kind[:-1])
    nouns: list[str] = []
    for word in before:
        if word in looks:
            continue
        if singular(word) in kind or _stands_for(singular(word), said):
            nouns.append(word)
        elif word in _PLACE_WORDS and len(kind) == 1:
            continue
        elif fixed:
            return 0.0
        elif word in {"open", "closed"}:
            score *= _state_score(word, thing)
        elif word not in _SIZE_WORDS:
            if not is_adjective(word):
                return 0.0
            score *= _PLAIN_WORD
    for word in complement:
        if not is_appearance_word(word) and word not in _SIZE_WORDS | _PLACE_WORDS:
            if not _stands_for(singular(word), said):
                return 0.0
            nouns.append(word)
    if nouns and not fixed and thing.name and not _leads_to(tuple(nouns), thing):
        return 0.0
    return score


def _leads_to(nouns: tuple[str, ...], thing: ObjectDescription) -> bool:
    """Tell "kitchen door" from the door of the kitchen store."""
    if (
        not _is_place(singular(nouns[-1]))
        or kind_distance("door", thing.category) is None
    ):
        return True
    asked = NounPhrase(nouns)
    return any(
        _name_fits(asked, parse_name(name)) for name in (thing.name, thing.text) if name
    )


def _is_place(noun: str) -> bool:
    return any(kind_distance(place, noun) is not None for place in _PLACES)


def _name_fits(asked: NounPhrase, name: NounPhrase, *, exact: bool = False) -> bool:
    """Tell whether a name means the kind of place or thing asked for.

    `exact` asks for the same noun or a synonym: "The Stargazer" is no person.

    Its head noun must be that kind, and hold the words before it: "mail room" fits
    "Central Mail Room", neither "Mail Archive" nor "Machine Room".
    """
    own = frozenset((*name.singulars, *map(singular, name.complement)))
    splits = head_splits(asked.words)
    for head, before in splits:
        fixed = len(before) > len(splits[0][1])
        if _category_score(head, name) > 0.99 * exact and all(
            _stands_for(singular(word), own)
            or (not fixed and (is_adjective(word) or word in _SIZE_WORDS))
            for word in (*before, *asked.complement)
        ):
            return True
    return False


def _name_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Take the request for a proper name or inscription, such as `library`."""
    is_door = kind_distance("door", thing.category) is not None
    is_sign = kind_distance("sign", thing.category) is not None
    best = 0.0
    if thing.name:
        name = parse_name(thing.name)
        if _name_fits(phrase, name, exact=not is_door):
            best = _BY_NAME
        elif not is_noun(phrase.singulars[-1]) and set(phrase.singulars) <= set(
            words_of(thing.name)
        ):
            best = _BY_WORDS
    if thing.text and not phrase.inscription:
        words = words_of(thing.text)
        if (is_door or is_sign) and len(words) <= _SHORT_TEXT:
            fits = _name_fits(phrase, parse_name(thing.text), exact=not is_door)
        else:
            fits = set(words) <= {*phrase.singulars, *phrase.identifiers}
        if fits:
            best = max(best, _BY_NAME if is_door else _BY_WORDS)
    numbers = {word for word in phrase.identifiers if len(word) > 1}
    if numbers and (is_door or is_sign) and _is_place(phrase.singulars[-1]):
        best = max(best, _BY_WORDS)
    return best


def _bearer_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Find "sign that says Library" where a door or desk bears the word."""
    if thing.text is None or phrase.singulars[-1] not in _SIGN_WORDS:
        return 0.0
    asked = (*phrase.inscription, *map(singular, phrase.complement))
    written = frozenset(words_of(thing.text))
    if asked and all(_stands_for(word, written) for word in asked):
        return _BY_WORDS if len(phrase.words) == 1 else 0.0
    return 0.0


def _state_score(asked: str, thing: ObjectDescription) -> float:
    if thing.state is None:
        return _PLAIN_WORD
    return 1.0 if thing.state == asked else 0.0


@lru_cache(maxsize=50_000)
def _stands_for(word: str, words: frozenset[str]) -> bool:
    """Tell whether a word, or one for a kind of it or the same, is among others."""
    if word in words:
        return True
    group = next((group for group in _PEOPLE if word in group), None)
    if group is not None:
        return bool(group & words)
    return any(kind_distance(word, other) is not None for other in words)
