"""Proper names and inscriptions: is a thing what it is called, or what it says?"""

import re
from dataclasses import replace

from memorymaze.perception.appearance import appearance_score, is_appearance_word
from memorymaze.perception.kinds import category_score, is_place, stands_for
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
    words_of,
)
from memorymaze.perception.visible_object import ObjectDescription

BY_NAME = 0.9
"""A proper name asked for as if it were a kind ("library", for its door)."""
BY_WORDS = 0.65
"""Words written on a thing, asked for as if they were the thing."""
_SHORT_TEXT = 4
"""Inscriptions of up to so many words name a thing; longer ones tell of others."""
SIZE_WORDS = word_set(
    "big large small little tall huge giant long short tiny wide narrow massive",
    "double single main old new nice public regular normal typical whole",
)
"""Words of size and praise: no reason to reject a thing."""
_SIGN_WORDS = word_set(
    "sign signboard label plate nameplate plaque lettering text writing word",
    "banner notice board panel",
)

_POINTING = re.compile(
    r"[\u2190-\u21ff\u27a1\u2b05-\u2b07]|->|<-|\b(?:to the|on (?:the|your)|turn) "
    r"(?:left|right)\b|\bstraight\b|\d ?m\b",
    re.IGNORECASE,
)
_ROOM_WORDS = word_set("room hall area space zone section place door sign entrance")
"""Words that people add to names: "first aid room" for "First Aid"."""


def points_elsewhere(inscription: str) -> bool:
    """Tell a sign that says where a place is from one that says it is here.

    >>> points_elsewhere("Terrace \u2192"), points_elsewhere("Terrace")
    (True, False)
    """
    return _POINTING.search(inscription) is not None


def words_on(thing: ObjectDescription) -> frozenset[str]:
    """Return the words of a thing's name and inscription."""
    return frozenset(words_of(f"{thing.name or ''} {thing.text or ''}"))


def name_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Take the request for a proper name or inscription, such as `library`."""
    is_door = kind_distance("door", thing.category) is not None
    is_sign = kind_distance("sign", thing.category) is not None
    looks = [word for word in phrase.words[:-1] if is_appearance_word(word)]
    if looks and not words_on(thing).issuperset(looks):
        if appearance_score(" ".join(looks), thing.color, thing.material) == 0.0:
            return 0.0
        before = tuple(word for word in phrase.words[:-1] if word not in looks)
        phrase = replace(phrase, words=(*before, phrase.words[-1]))
    asked = {*phrase.singulars, *phrase.complement, *phrase.identifiers}
    may_name_a_room = is_door or (is_sign and is_place(phrase.singulars[-1]))
    best = 0.0
    for said, score in ((thing.name, BY_NAME), (thing.text, BY_WORDS)):
        words = words_of(said) if said else ()
        if not words or (said == thing.text and phrase.inscription):
            continue
        if points_elsewhere(said or ""):
            continue
        if (set(words) <= asked and asked - {*words} <= _ROOM_WORDS) or (
            may_name_a_room
            and len(words) <= _SHORT_TEXT
            and _name_fits(phrase, parse_name(said or ""))
        ):
            best = max(best, BY_NAME if is_door else score)
        elif is_door and not is_noun(phrase.singulars[-1]) and asked <= set(words):
            best = max(best, BY_WORDS)  # "Aurora" for "Aurora Hall"
    numbers = {word for word in phrase.identifiers if len(word) > 1}
    if numbers and (is_door or is_sign) and is_place(phrase.singulars[-1]):
        best = max(best, BY_WORDS)
    return best


def bearer_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Find "sign that says Library" where a door or desk bears the word."""
    if thing.text is None or phrase.singulars[-1] not in _SIGN_WORDS:
        return 0.0
    asked = (*phrase.inscription, *map(singular, phrase.complement))
    written = frozenset(words_of(thing.text))
    if asked and all(stands_for(word, written) for word in asked):
        return BY_WORDS if len(phrase.words) == 1 else 0.0
    return 0.0


def leads_to(nouns: tuple[str, ...], thing: ObjectDescription) -> bool:
    """Tell "kitchen door" from the door of the kitchen store."""
    if (
        not is_place(singular(nouns[-1]))
        or kind_distance("door", thing.category) is None
    ):
        return True
    asked = NounPhrase(nouns)
    return any(
        _name_fits(asked, parse_name(name)) for name in (thing.name, thing.text) if name
    )


def _name_fits(asked: NounPhrase, name: NounPhrase) -> bool:
    """Tell whether a name means the kind of place or thing asked for.

    Its head noun must be that kind, and hold the words before it: "mail room" fits
    "Central Mail Room B", neither "Mail Archive" nor "Machine Room".
    """
    own = frozenset((*name.singulars, *map(singular, name.complement)))
    while len(name.words) > 1 and not is_noun(name.singulars[-1]):
        name = replace(name, words=name.words[:-1])  # "Stairwell East"
    splits = head_splits(asked.words)
    for head, before in splits:
        fixed = len(before) > len(splits[0][1])
        if category_score(head, name) > 0 and all(
            stands_for(singular(word), own)
            or (not fixed and (is_adjective(word) or word in SIZE_WORDS))
            for word in (*before, *asked.complement)
        ):
            return True
    return False
