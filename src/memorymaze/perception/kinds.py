"""Is one thing of the kind a noun names, by its category or by what it shows?"""

from functools import lru_cache

from memorymaze.perception.lexicon import kind_distance, names_person, word_set
from memorymaze.perception.noun_phrase import NounPhrase, head_splits

BY_SUBJECT = 0.7
"""What a thing shows, holds or names ("rocket" for a rocket model)."""
_SOMEBODY = 0.75
"""A person, asked for by what one cannot see of them: "visitor", "woman"."""
_SHOWING = word_set(
    "model statue sculpture bust skeleton skull replica figure picture painting",
    "poster photo photograph mural exhibit display sign signboard banner panel",
    "board panel box cabinet case station unit dispenser machine plaque plate",
    "window module mockup prototype specimen",
)
"""Heads of compounds whose first part is what people see: "whale skeleton"."""

_PLACES = ("room", "building", "facility", "establishment", "stairway")

_PEOPLE = (
    frozenset({"man", "gent", "gentleman", "male", "boy"}),
    frozenset({"woman", "lady", "female", "girl"}),
)


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
    return BY_SUBJECT if category_score(head, NounPhrase(subject)) > 0 else 0.0


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
