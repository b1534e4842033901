"""Does a thing fit what someone asks for? Open-vocabulary, by kind, looks, name and words.

The request may be any English noun phrase; nothing here knows of a building. How it is
read is in `noun_phrase.py`, what its words mean in `lexicon.py` and `appearance.py`.
`docs/seeing.md` has the rules in prose.
"""

import re
from dataclasses import replace
from functools import lru_cache

from memorymaze.language.nouns import (
    is_adjective,
    is_noun,
    kind_distance,
    names_person,
    singular,
    word_set,
)
from memorymaze.robot.perception.appearance import appearance_score, is_appearance_word
from memorymaze.robot.perception.camera_view import ObjectDescription
from memorymaze.robot.perception.noun_phrase import (
    NounPhrase,
    head_splits,
    parse_name,
    parse_request,
    without_lead_in,
    words_of,
)

MATCH_THRESHOLD = 0.5
"""A thing is found when its score is at least this."""
_PLAIN_WORD = 0.9
"""Factor for a describing word nothing is known about ("modern")."""
_BY_LOOKS = 0.6
"""Any thing, asked for by nothing but its looks: "something red"."""
_PLACE_WORDS = word_set("places")
"""Where a thing is, which the picture does not tell: no reason to reject it."""
_ANYTHING = word_set("anything")
_EXHIBITS = word_set("exhibits")
BY_NAME = 0.9
"""A proper name asked for as if it were a kind ("library", for its door)."""
BY_WORDS = 0.65
"""Words written on a thing, asked for as if they were the thing."""
_SHORT_TEXT = 4
"""Inscriptions of up to so many words name a thing; longer ones tell of others."""
SIZE_WORDS = word_set("sizes")
"""Words of size and praise: no reason to reject a thing."""
_SIGN_WORDS = word_set("signs")
_POINTING = re.compile(
    r"[\u2190-\u21ff\u27a1\u2b05-\u2b07]|->|<-|\b(?:to the|on (?:the|your)|turn) "
    r"(?:left|right)\b|\bstraight\b|\b\d{1,3} ?m\b",
    re.IGNORECASE,
)
_ROOM_WORDS = word_set("rooms")
"""Words that people add to names: "first aid room" for "First Aid"."""
BY_SUBJECT = 0.7
"""What a thing shows, holds or names ("rocket" for a rocket model)."""
_SOMEBODY = 0.75
"""A person, asked for by what one cannot see of them: "visitor", "woman"."""
_SHOWING = word_set("showing")
"""Heads of compounds whose first part is what people see: "whale skeleton"."""
_PLACES = ("room", "building", "facility", "establishment", "stairway")
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
    whole = words_of(without_lead_in(request))
    for known in filter(None, (description.name, description.text)):
        written = words_of(known)
        # "boardroom" is the Board Room; "library" alone may be any.
        in_full = "".join(written) == "".join(whole) and len(whole + written) > 2
        if in_full and not points_elsewhere(known):
            return 1.0
    return max(_phrase_score(phrase, description) for phrase in parse_request(request))


def _phrase_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    said = words_on(thing).union(words_of(thing.category))
    if not phrase.identifiers <= said:
        return 0.0
    if not all(stands_for(word, said) for word in phrase.inscription):
        return 0.0
    if not phrase.words:
        return BY_NAME if phrase.inscription or phrase.identifiers else 0.0
    return max(
        _kind_score(phrase, thing),
        name_score(phrase, thing),
        bearer_score(phrase, thing),
    )


def _kind_score(phrase: NounPhrase, thing: ObjectDescription) -> float:
    """Compare the head noun with the thing's category, then all said of it."""
    category = parse_name(thing.category)
    if all(is_appearance_word(word) for word in phrase.words):
        phrase = replace(phrase, words=(*phrase.words, "thing"))
    splits = head_splits(phrase.words)
    best = 0.0
    for head, before in splits:
        base = category_score(head, category)
        if head in _ANYTHING and (before or phrase.complement):
            base = max(base, _BY_LOOKS)
        if base > best:
            fixed = len(before) > len(splits[0][1])
            factor = _qualities_score(before, phrase.complement, thing, fixed=fixed)
            best = max(best, base * factor)
    if len(phrase.words) > 1 and phrase.singulars[-1] in _EXHIBITS:
        subject = replace(phrase, words=phrase.words[:-1])
        best = max(best, _PLAIN_WORD * _kind_score(subject, thing))
    return best


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
    written = words_on(thing)
    looks = [w for w in before if is_appearance_word(w) and w not in written | {*kind}]
    if fixed and looks:
        return 0.0
    score = appearance_score(" ".join(looks), thing.color, thing.material)
    category = parse_name(thing.category)
    said = written.union(category.singulars[:-1], map(singular, category.complement))
    nouns: list[str] = []
    for word in before:
        if word in looks:
            continue
        if singular(word) in kind or stands_for(singular(word), said):
            nouns.append(word)
        elif word in _PLACE_WORDS and len(kind) == 1:
            continue
        elif fixed:
            return 0.0
        elif word in {"open", "closed"}:
            score *= _state_score(word, thing)
        elif word not in SIZE_WORDS:
            if not is_adjective(word):
                return 0.0
            score *= _PLAIN_WORD
    for word in complement:
        if not is_appearance_word(word) and word not in SIZE_WORDS | _PLACE_WORDS:
            if not stands_for(singular(word), said):
                return 0.0
            nouns.append(word)
    if nouns and not fixed and thing.name and not leads_to(tuple(nouns), thing):
        return 0.0
    return score


def _state_score(asked: str, thing: ObjectDescription) -> float:
    if thing.state is None:
        return _PLAIN_WORD
    return 1.0 if thing.state == asked else 0.0


@lru_cache(maxsize=50_000)
def points_elsewhere(inscription: str) -> bool:
    """Tell a sign that says where a place is from one that says it is here.

    >>> points_elsewhere("Terrace \u2192"), points_elsewhere("Terrace")
    (True, False)
    >>> points_elsewhere("Exit 40 m"), points_elsewhere("Rock from 3000 m")
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


def category_score(head: str, category: NounPhrase) -> float:
    """Compare a noun with a category: kinds first, then what the category shows."""
    names = head_splits(category.words)
    distances = [
        distance
        for name, before in names
        if before == names[0][1] and (distance := kind_distance(head, name)) is not None
    ]
    compound = head.replace(" ", "")
    if any(
        "".join(category.singulars[start:]) == compound
        for start in range(len(category.words) - 1)
    ):
        return 1.0  # "mailroom" and "mail room"
    if distances:
        steps = min(distances)
        return 1.0 if steps == 0 else max(0.7, 0.95 - 0.05 * steps)
    if names_person(head) and any(
        kind_distance(name, "person") == 0 for name, _ in names
    ):
        return _SOMEBODY
    subject = category.complement or category.words[:-1]
    if not subject or category.singulars[-1] not in _SHOWING:
        return 0.0
    if len(category.words) - len(names[0][1]) > 1:  # a fixed phrase: "display case"
        return BY_SUBJECT if head in category.singulars[:-1] else 0.0
    shown = head == singular(subject[-1])  # "station" for a space station module
    return BY_SUBJECT if shown or category_score(head, NounPhrase(subject)) else 0.0


def is_place(noun: str) -> bool:
    """Tell whether a noun names a room, a building or stairs."""
    return any(kind_distance(place, noun) is not None for place in _PLACES)


@lru_cache(maxsize=50_000)
def stands_for(word: str, words: frozenset[str]) -> bool:
    """Tell whether a word, or one for a kind of it or the same, is among others."""
    if word in words:
        return True
    group = next((group for group in _PEOPLE if word in group), None)
    if group is not None:
        return bool(group & words)
    return any(kind_distance(word, other) is not None for other in words)
