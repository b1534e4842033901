"""More texts than were marked: legs put together anew, mirrored, renamed and misspelt."""

import random
from collections.abc import Sequence
from dataclasses import replace

from benchmarks.marking.marked_texts import MarkedText, MarkedWord, marks_of

Words = list[MarkedWord]

WHOLE, MIRRORED, SAME_PERSON = 0.4, 0.45, 0.5
"""Shares: texts that stay whole, parts that are mirrored, legs of one person."""
AROUND = 0.03
"""Share of texts that begin with turning round, of which hardly one is marked."""
RENAMED, CORRECTED, REPEATED, RECAPPED = 0.2, 0.05, 0.08, 0.08
"""Shares: of things, of turns that are taken back or said twice, of texts with a recap."""
AT_ONCE, WITH_THING = 0.4, 0.5
"""Shares of turns said twice: before anything else, and with what one turns at."""
RECAP_LAST = 0.6
"""Share of recaps that come after the way; the others are overviews before it."""
LOWER, BARE, FILLED, MISSPELT = 0.2, 0.12, 0.3, 0.35
"""Shares of texts written in lower case, without punctuation, with fillers, misspelt."""
A_WORD = 0.05
"""Share of the words of such a text."""
LEGS = (1, 2, 2, 3, 3, 4, 5)
OTHER = {"left": "right", "right": "left"}
NAMED = frozenset(
    {f"thing:{place}" for place in (
        "turn", "target", "passed", "along", "beside", "after", "before", "opposite",
    )}
    | {"dest", "too_far", "wrong_way", "ignore", "count_after", "start:from", "start:facing"}
)  # fmt: skip
FILLERS = (
    "um", "uh", "er", "like", "you know", "well", "so", "I mean", "okay", "right so",
    "let me think", "sort of", "basically", "just", "actually",
)  # fmt: skip
TAKEN_BACK = (
    "no", "no sorry", "no wait", "sorry", "I mean", "er no", "not that", "no , no", "wait , no",
    "rubbish ,", "scratch that ,", "hang on ,", "my mistake ,", "I tell a lie ,", "excuse me , I mean",
)  # fmt: skip
SAID_TWICE = ("yes", "yeah", "so", "that's right ,", "I said", "I mean")
TURNED_FIRST = (
    "turn around", "turn round", "first turn around", "do a u - turn", "about face",
    "turn yourself around", "you have to turn round",
)  # fmt: skip
RECAPS = (
    "so that's",
    "so again :",
    "in short :",
    "all in all",
    "basically",
    "to sum up ,",
)
LETTERS = "qwertyuiopasdfghjklzxcvbnm"


class Recombiner:
    """Draws texts from marked ones, with the marks that follow."""

    def __init__(self, texts: Sequence[MarkedText], seed: int) -> None:
        """Take the texts to draw from."""
        self._random = random.Random(seed)
        self._texts = texts
        self._people: dict[str, list[list[Words]]] = {}
        for text in texts:
            legs = legs_of(text)
            if legs is not None and len(legs) > 1:
                self._people.setdefault(text.person, []).append(legs)
        self._cut = [legs for all_of in self._people.values() for legs in all_of]
        self._between = [leg for legs in self._cut for leg in legs[1:-1]]
        self._names = [
            [word.text for word in text.words[start:end]]
            for text in texts
            for start, end in marks_of(text.words)
            if text.words[start].label in NAMED
        ]

    def draw(self) -> Words:
        """Return the words of one more text."""
        whole = self._random.random() < WHOLE
        words = self._whole() if whole else self._joined()
        words = self._summed_up(self._corrected(self._renamed(words)))
        if self._random.random() < AROUND:
            words = _after_turning_round(self._random.choice(TURNED_FIRST), words)
        return self._written(words)

    def _whole(self) -> Words:
        words = list(self._random.choice(self._texts).words)
        return mirrored(words) if self._random.random() < MIRRORED else words

    def _joined(self) -> Words:
        draw = self._random
        texts, between = self._cut, self._between
        if draw.random() < SAME_PERSON:
            texts = draw.choice(list(self._people.values()))
            between = [leg for legs in texts for leg in legs[1:-1]] or between
        legs = [
            draw.choice(texts)[0],
            *(draw.choice(between) for _ in range(draw.choice(LEGS) - 1)),
            draw.choice(texts)[-1],
        ]
        words: Words = []
        for number, leg in enumerate(legs):
            turned = mirrored(leg) if draw.random() < MIRRORED else leg
            words += [
                replace(each, leg=number) if each.leg >= 0 else each for each in turned
            ]
        return words

    def _renamed(self, words: Words) -> Words:
        """Give things other names, the same thing the same wherever it is said."""
        named = {
            _name(words[start:end])
            for start, end in marks_of(words)
            if words[start].label in NAMED
        }
        names = {
            name: self._random.choice(self._names)
            for name in sorted(named)
            if self._random.random() < RENAMED
        }
        out, done = list[MarkedWord](), 0
        for start, end in marks_of(words):
            out += words[done:start]
            done = end
            first = words[start]
            new = names.get(_name(words[start:end]))
            out += (
                words[start:end]
                if new is None
                else [
                    replace(first, text=text, begins=n == 0)
                    for n, text in enumerate(new)
                ]
            )
        return out + words[done:]

    def _corrected(self, words: Words) -> Words:
        """Take turns back before they are said, and say them twice."""
        draw = self._random
        out, echo = list[MarkedWord](), list[MarkedWord]()
        for each in words:
            if echo and not each.label and each.text in ".,;!?":
                out += [each, *echo]
                echo = []
            side = each.text.lower()
            turns = each.begins and each.label[:5] == "turn:" and side in OTHER
            if turns and draw.random() < CORRECTED:
                out.append(replace(each, text=OTHER[side], label="undone"))
                out += _plain(draw.choice([",", ""]), draw.choice(TAKEN_BACK), ",")
            out.append(each)
            if turns and draw.random() < REPEATED:
                said = _plain(draw.choice(SAID_TWICE))
                if draw.random() < AT_ONCE:
                    out += [*_plain(","), *said, replace(each, label="again")]
                else:
                    echo = said + self._again(each, words)
        return out

    def _again(self, turn: MarkedWord, words: Words) -> Words:
        """Return a turn said once more, some with what it is at."""
        told = [turn.text]
        things = [
            words[start:end]
            for start, end in marks_of(words)
            if words[start].label == "thing:turn" and words[start].leg == turn.leg
        ]
        if things and self._random.random() < WITH_THING:
            told += ["at", "the", *(each.text for each in things[0])]
        return _repeated(told, turn.leg)

    def _summed_up(self, words: Words) -> Words:
        """Tell all turns once more, before the way or after it."""
        draw = self._random
        if draw.random() >= RECAPPED:
            return words
        sides = [each for each in words if each.begins and each.label[:5] == "turn:"]
        said = [each.text.lower() for each in sides]
        if not said or not OTHER.keys() >= set(said):
            return words
        listed = [text for side in said for text in (",", side)][1:]
        recap = _plain(draw.choice(RECAPS)) + _repeated(listed, sides[0].leg)
        recap += _plain(".")
        return words + recap if draw.random() < RECAP_LAST else recap + words

    def _written(self, words: Words) -> Words:
        draw = self._random
        lower, bare, filled, misspelt = (
            draw.random() < share for share in (LOWER, BARE, FILLED, MISSPELT)
        )
        out: Words = []
        for each in words:
            if bare and not each.label and each.text in ",.;:!?":
                continue
            text = each.text.lower() if lower else each.text
            if filled and (each.begins or not each.label) and draw.random() < A_WORD:
                out += _plain(draw.choice(FILLERS))
                text = text if each.label else text.lower()
            if misspelt and draw.random() < A_WORD:
                text = self._misspelt(text)
            out.append(replace(each, text=text))
        return out

    def _misspelt(self, word: str) -> str:
        if len(word) < 4 or not word.isalpha():
            return word
        at = self._random.randrange(1, len(word) - 1)
        kind = self._random.choice(["without", "swapped", "doubled", "other"])
        if kind == "without":
            return word[:at] + word[at + 1 :]
        if kind == "swapped":
            return word[:at] + word[at + 1] + word[at] + word[at + 2 :]
        if kind == "doubled":
            return word[:at] + word[at] + word[at:]
        return word[:at] + self._random.choice(LETTERS) + word[at + 1 :]


def _after_turning_round(said: str, words: Words) -> Words:
    """Put a turn on the spot before the way."""
    *before, first, last = said.split()
    turn = [
        MarkedWord(first, "turn:around", True, 0),
        MarkedWord(last, "turn:around", leg=0),
    ]
    later = [
        replace(each, leg=each.leg + 1) if each.leg >= 0 else each for each in words
    ]
    return [*map(MarkedWord, before), *turn, MarkedWord(","), *later]


def _name(words: Words) -> str:
    return " ".join(each.text for each in words).lower()


def _plain(*said: str) -> Words:
    return [MarkedWord(word) for each in said for word in each.split()]


def _repeated(told: Sequence[str], leg: int) -> Words:
    """Return words that repeat what was said."""
    return [MarkedWord(text, "again", n == 0, leg) for n, text in enumerate(told)]


def mirrored(words: Words) -> Words:
    """Return them with left and right exchanged, or as they are if that cannot be told."""
    if any(_is_odd(each.text.lower()) for each in words):
        return words
    for start, end in marks_of(words):
        way = words[start].label.partition(":")[2].split("_")[-1]
        if way in OTHER and not any(w.text.lower() in OTHER for w in words[start:end]):
            return words
    return [_other(each) for each in words]


def _is_odd(word: str) -> bool:
    """Whether a word tells a side in a way that has no counterpart here."""
    return ("left" in word or "right" in word) and word not in OTHER


def _other(word: MarkedWord) -> MarkedWord:
    # Unmarked it may be no side: "right away", "all right".
    text, kind = word.text, word.label.partition(":")[0]
    if (
        word.label
        and kind not in {"immediate", "thing", "dest"}
        and text.lower() in OTHER
    ):
        other = OTHER[text.lower()]
        text = other.capitalize() if text[0].isupper() else other
    label = word.label
    if kind in {"turn", "bend", "side"}:
        for side in OTHER:
            if label.endswith(side):
                label = label.removesuffix(side) + OTHER[side]
                break
    return replace(word, text=text, label=label)


def legs_of(text: MarkedText) -> list[Words] | None:
    """Cut a text between its legs; `None` where they are not told in order."""
    words = text.words
    marks = [each for each in marks_of(words) if words[each[0]].steps]
    cuts = [0]
    leg = 0
    for before, (start, _) in zip([(0, 0), *marks], marks, strict=False):
        if words[start].leg not in {leg, leg + 1}:
            return None
        if words[start].leg > leg:
            leg += 1
            cuts.append(_cut(words, before[1], start))
    if leg != text.turns:
        return None
    return [
        list(words[a:b]) for a, b in zip(cuts, [*cuts[1:], len(words)], strict=True)
    ]


def _cut(words: Sequence[MarkedWord], after: int, before: int) -> int:
    """Return where a leg ends between two marks: at a full stop, else at a comma."""
    for stops in (".!?;\n", ","):
        ends = [n for n in range(after, before) if words[n].text in stops]
        if ends:
            return ends[-1] + 1
    joins = [
        n for n in range(after, before) if words[n].text.lower() in {"then", "and"}
    ]
    return joins[0] if joins else before
