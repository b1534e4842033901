"""Open-vocabulary matching of what someone asks for with what a thing is.

The request may be any English noun phrase; nothing here knows of a building. How it
is read is in `request.py` and `noun_phrase.py`, what its words mean in `lexicon.py`,
`appearance.py`, `kinds.py` and `names.py`. `docs/perception.md` has the rules in prose.
"""

from dataclasses import replace
from functools import lru_cache

from memorymaze.perception.appearance import appearance_score, is_appearance_word
from memorymaze.perception.kinds import category_score, stands_for
from memorymaze.perception.lexicon import is_adjective, singular, word_set
from memorymaze.perception.names import (
    BY_NAME,
    SIZE_WORDS,
    bearer_score,
    leads_to,
    name_score,
    points_elsewhere,
    words_on,
)
from memorymaze.perception.noun_phrase import (
    NounPhrase,
    head_splits,
    parse_name,
    words_of,
)
from memorymaze.perception.request import parse_request, without_lead_in
from memorymaze.perception.visible_object import ObjectDescription

MATCH_THRESHOLD = 0.5
"""A thing is found when its score is at least this."""
_PLAIN_WORD = 0.9
"""Factor for a describing word nothing is known about ("modern")."""
_BY_LOOKS = 0.6
"""Any thing, asked for by nothing but its looks: "something red"."""
_PLACE_WORDS = word_set(
    "wall floor ceiling corner corridor hallway hall lobby indoor outdoor side front back",
    "building museum university campus",
)
"""Where a thing is, which the picture does not tell: no reason to reject it."""
_ANYTHING = word_set("thing object item something anything landmark feature")
_EXHIBITS = word_set("exhibit exhibition display installation attraction artwork")


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
    if len(whole) > 1:
        for known in (description.name, description.text):
            if known and words_of(known) == whole and not points_elsewhere(known):
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
