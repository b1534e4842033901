"""Directions and openings: what `left` and `the second left` do in a clause.

`turn left` is a turn and `the bench on the left` a side; an opening is named to be taken
or to be left alone.
"""

import re
from dataclasses import dataclass, replace

from memorymaze.language.plans import Junction, Side, Way
from memorymaze.language.reading.chunks import Chunk
from memorymaze.language.reading.clause import (
    AT_THE_TURN,
    Clause,
    ClauseEvent,
    is_aside,
    side_of,
    towards_a_side,
)
from memorymaze.language.reading.lengths import read_vague
from memorymaze.language.reading.vocabulary import ORDINALS

_SIGN = re.compile(
    r"\b(?:sign|board|arrow|screen|signs|arrows|shows?|points?|pointing)\b"
)
_OFF = re.compile(r"goes|go\b|leads?|runs?|comes?")
_STARTS = re.compile(r"(?:start|begin|open|continue|lead)")
_EXISTS = re.compile(r"come|there|here")
_SEEN = re.compile(r".*\b(?:see|find|have|notice|spot)$")
_DOOR = re.compile(r"^(?:hand )?(?:door|wall|window|room)s?\b")
_THROUGH = re.compile(r"through$|into$|enter")
_DOORWAY = re.compile(r"\b(?:door|doorway|arch|archway|gate|portal)s?$")
_LOOSE = ("with", "among")
_AWAY = re.compile(r"(?:away|from|out|off)\b")
_OUT = re.compile(r"exit|(?:go|come|get|walk|step) (?:out|off)|follow")
_FACE = re.compile(r"(?:turn to )?face")
_BEND = re.compile(r"corner|bend|curve")
"""Nouns for what one cannot pass without turning."""
_OWN = re.compile(r"\b(?:way|route)$")
"""Nouns for what one follows, wherever it goes."""
_TAKEN = re.compile(r"opening|turn|gap|exit|fork|branch")
"""Nouns for openings that one takes, not merely walks along."""


def is_turn(clause: Clause, at: int, *, after_turn: bool) -> bool:
    """Tell whether the direction at an index is a turn to make.

    Args:
        clause: The clause.
        at: Index of an `L` or `S`.
        after_turn: Whether the last thing read in this clause is a turn, or nothing.
    """
    chunk = clause.chunks[at]
    before = clause.kinds[:at].rstrip("H")
    after = clause.kinds[at + 1 :]
    if chunk.way in {None, "forward"}:
        return False
    last = before[-1:]
    if chunk.kind == "S" and is_aside(chunk) and last == "G":
        if chunk.text.endswith(("side", "sides")) or before.endswith("NG"):
            return False
        verb = clause.chunks[len(before) - 1].text
        idle = re.match(r"keep|leav|stay", verb) or before.startswith("Z")
        return not (idle or after.startswith("B"))  # "it will be coming on your left"
    if is_aside(chunk) and not after and _leads_through_a_door(clause, before):
        return True
    if last == "K" and is_aside(chunk) and "side" in chunk.text:
        return False
    if last == "V" and clause.chunks[len(before) - 1].text == "face":
        return True
    if last in {"T", "K"} or (last == "G" and not after.startswith("N")):
        return not (after.startswith("B") and last == "G")
    if is_of_a_sign(clause, at) and towards_a_side(chunk):
        return True
    if "T" in before and not re.search("[NJBV]", before[before.rindex("T") :]):
        return True
    out = before == "GN" and _OUT.match(clause.chunks[0].text)
    if out and re.match("to|by|(?:left|right)(?! *U)", f"{chunk.text} {after}"):
        return True  # "exit the lifts to the right"
    if chunk.kind == "S":
        bare = chunk.text in {"in left", "in right"}
        if bare and before in {"", "GHE", "GE", "E"} and not re.match("[BVN]", after):
            return True  # "till the end and in left"
        if towards_a_side(chunk) and not after:
            if clause.has("r") and not before:
                return True  # "so you to the right"
            if re.fullmatch("[AQ]?M", before):
                return True  # "after five metres to the left"
        return _is_turn_to_side(clause, chunk, before, after)
    return _is_bare_turn(clause, at, before, after, after_turn=after_turn)


def _leads_through_a_door(clause: Clause, before: str) -> bool:
    """`Go through the doorway on the left`."""
    if re.search("[GtTP]N$", before) is None:
        return False
    verb, door = clause.chunks[len(before) - 2 : len(before)]
    return bool(_THROUGH.search(verb.text) and _DOORWAY.search(door.text))


def _is_bare_turn(
    clause: Clause, at: int, before: str, after: str, *, after_turn: bool
) -> bool:
    """Decide about `left` without `to the` or `on the`."""
    last = before[-1:]
    if not before and re.match("J?B", after):
        return False
    if before == "B" and clause.chunks[0].text in {"is", "are", "'s"}:
        return False  # "six, the door you want, is left"
    if before == "N" and not after and _turned_at_a_thing(clause):
        return True  # "at the windows left, and the glass doors right"
    if not before and after.startswith("N"):
        return _DOOR.search(clause.chunks[at + 1].text) is None
    if last == "N":
        bound = re.search("([AwQPUtV])N+$", before)
        return bound is not None and not clause.chunks[bound.start()].text.startswith(
            _LOOSE
        )
    if last == "R":
        return False  # "the destination is left"
    if last == "B":
        return "N" not in before or "J" in before
    if last in {"A", "w"}:
        return clause.chunks[len(before) - 1].text in {"around", "round"}
    if last in {"L", "S"}:
        return after_turn
    return True


def _is_turn_to_side(clause: Clause, chunk: Chunk, before: str, after: str) -> bool:
    """Decide about `to the left`, `on the left`, `nine o'clock`."""
    if ("G" in before and not is_aside(chunk)) or "K" in before:
        return re.search("[NJ]", before) is None and not after.startswith("BN")
    last = clause.last_event()
    if clause.kinds == "S" and last is not None and last.kind == "take":
        return True  # "a door, and you go in, also on the right"
    if not (is_aside(chunk) or re.search("[BVNZ]", before)) and re.match(
        "[AwQE]", after
    ):
        return True  # "20 metres and to your left at the desk"
    if after.startswith("V") and _SEEN.match(
        clause.chunks[len(clause.kinds) - len(after)].text
    ):
        return False  # "to your right you will see the desk"
    bound = re.search("([AU])N+$", before)
    if towards_a_side(chunk) and bound is not None:
        loose = clause.chunks[bound.start()].text.startswith(_LOOSE)
        return re.search("[BV]", before) is None and not loose
    if re.search("TN$", before) and not re.match("[BN]", after):
        return True
    if before or re.match("[BN]", after):
        return before.endswith("Z") and not is_aside(chunk)
    turned = any(event.kind == "turn" for event in clause.before)
    if clause.has("l") and re.match("[MH]|$", after) and not turned:
        return True  # "down there on the left for forty metres"
    clock = "clock" in chunk.text and re.match(r"(?:on|at|in) ", chunk.text) is None
    if is_aside(chunk) and not clock:
        return False
    last = clause.last_event()
    if last is None:
        return True
    if last.kind == "thing" and any(c.text in {"too", "also"} for c in clause.said):
        return False  # "the desk, that is to the left, too"
    if last.kind == "turn" and last.way == chunk.way:
        return False
    place = last.relation == "from" or place_is_named(clause)
    if not (towards_a_side(chunk) or clock):
        return place and after == ""  # "walk to the desk, right hand"
    return last.kind != "thing" or clock or place


def place_is_named(clause: Clause) -> bool:
    """Tell whether this sentence has named a place to turn at."""
    for event in reversed(clause.before):
        if event.kind in {"sentence", "turn"}:
            return False
        if event.kind == "end" or event.relation in {"at", "until", "after"}:
            return not event.back
    return False


def _turned_at_a_thing(clause: Clause) -> bool:
    """Tell whether the clause before this one, in its sentence, is `at the desk left`."""
    said = [event for event in clause.before[-4:] if event.kind != "clause"]
    bound = [event.relation in AT_THE_TURN for event in said if event.kind == "thing"]
    return len(said) > 1 and said[-1].kind == "turn" and bound[-1:] == [True]


def only_faces(clause: Clause, at: int) -> bool:
    """Tell whether a verb only turns one to what is named next.

    `Face the clock` and `turn towards the clock`, but neither `when you face the clock`
    nor `turn left towards the clock`.
    """
    chunk = clause.chunks[at]
    after = clause.kinds[at + 1 :]
    if re.search("[LSO2M]", after.split("G")[0]) or not re.match("[AUtSH]?N", after):
        return False
    if _AWAY.match(clause.chunks[at + 1].text):
        return False
    if chunk.kind == "V":
        asked = _FACE.fullmatch(chunk.text) is not None
        return asked and re.search("[GTBVPUJ]", clause.kinds[:at]) is None
    if chunk.kind == "T" and chunk.text in {"turn", "rotate", "swing"}:
        return re.match("[AUt]N", after) is not None
    return False


def is_of_a_sign(clause: Clause, at: int) -> bool:
    """`The board says Offices, right`: where a sign points, not yet a turn."""
    verbs = [chunk.text for chunk in clause.chunks[:at] if chunk.kind in "TG"]
    if any(not verb.startswith("follow") for verb in verbs):
        return False
    words = " ".join(chunk.text for chunk in clause.chunks[:at])
    return _SIGN.search(words) is not None


def is_on_both_sides(clause: Clause, at: int) -> bool:
    """`Rooms left and right` is no turn; `at the windows left-right` is two."""
    if "-" in clause.chunks[at].text:
        return False
    before = clause.kinds[:at]
    return before.endswith("N") and re.search("[AwQPUt]N+$", before) is None


def names_a_way(clause: Clause, at: int, *, turn: bool) -> bool:
    """`There is a left`, `carpet starts to the left`: a way, not yet taken.

    `turn` says whether it would else be read as a turn.
    """
    chunk = clause.chunks[at]
    before = clause.chunks[at - 1] if at else None
    if chunk.kind == "L":
        if before is not None and before.kind == "B" and _EXISTS.match(before.text):
            return True
    elif towards_a_side(chunk):
        if before is not None and _STARTS.match(before.text):
            return True
        if clause.kinds == "S" and not turn:
            return True
    return turn and is_of_a_sign(clause, at)


def speaks_of_ways(clause: Clause) -> bool:
    """`Right takes you to the labs`: the direction is what the clause is about."""
    if re.match("[LS][GKT]", clause.kinds) is None:
        return False
    return re.match(r"goes|lead|bring|takes", clause.chunks[1].text) is not None


def comes_before_its_thing(clause: Clause, at: int) -> bool:
    """`On the left is the bench`: the side is said before its thing."""
    follows = re.match("[BVZ]?n?O?N|OJ", clause.kinds[at + 1 :]) is not None
    return follows and "N" not in clause.kinds[:at]


# -- openings and junctions


@dataclass(slots=True)
class _Opening:
    """The words for one opening."""

    ordinal: int | None = None
    or_ordinal: int | None = None
    nearest: bool = False
    count: int | None = None
    noun: str = ""
    side: Side | None = None
    way: Way | None = None
    """Where it leads, as its side was said: `the next slight left`."""
    towards: bool = False
    """Whether its side was said as `to the left`."""
    stated: bool = False
    """Whether its side was said as a bare direction: `third turning is left`."""

    @property
    def name(self) -> str:
        """What it is called; "" where only its number or side is told."""
        words = [word for word in self.noun.split() if word not in {"one", "ones"}]
        return "" if not words or words[0] in ORDINALS else " ".join(words)


def read_opening(
    clause: Clause, start: int, *, turned: bool
) -> tuple[list[ClauseEvent], int]:
    """Read the words for an opening from an ordinal, number or junction noun on.

    `turned` says whether the clause has told a turn already.
    """
    opening, at = _words_of(clause, start)
    before, after = clause.kinds[:start], clause.kinds[at:]
    if opening.side is None and (before.endswith("SB") or before == "S"):
        opening.side = side_of(clause.chunks[before.index("S")])
    if not opening.noun and after.startswith("N"):
        if opening.side is None:
            return [], at  # the ordinal of a thing: "the second door"
        if _DOOR.search(clause.chunks[at].text) and not re.search("[TG]", before):
            return [ClauseEvent("side", side=opening.side, likely=True)], at
    if not (before or opening.noun or opening.side) and re.match("[VGKR]", after):
        return [], at  # "first go to the desk"
    if before.endswith("NB") and clause.kinds[start:at] == "OS":
        return [
            ClauseEvent("side", side=opening.side)
        ], at  # "the library is second on the left"
    after_it = before.endswith("Q") and clause.chunks[start - 1].text.endswith("after")
    if after_it and _BEND.search(opening.noun) and not opening.side:
        return [], at  # "after the second bend"
    way = ClauseEvent(
        "way",
        side=opening.side,
        ordinal=opening.ordinal,
        or_ordinal=opening.or_ordinal,
        nearest=opening.nearest,
        phrase=opening.name,
        count=opening.count,
    )
    verb = clause.chunks[start - 1].text if before.endswith("G") else ""
    left_aside = verb == "leaving" or (
        verb == "leave"
        and (opening.ordinal or opening.count or opening.side) is not None
    )
    if left_aside or ("P" in before and not re.search("P.*T", before)):
        plural = opening.noun.endswith("s")
        count = opening.count or (None if plural else 1)
        return [
            ClauseEvent(
                "pass_ways", count=count, side=opening.side, phrase=opening.name
            )
        ], at
    if opening.side is None and opening.ordinal is None:
        return _bare(clause, start, opening, after, turned=turned), at
    if turned and opening.ordinal is not None and re.search("[LS]A$", before):
        return [_likely(way, back=True)], at  # "left at the second one on the left"
    if opening.side == "left" or opening.side == "right":
        told = clause.chunks[start - 2].way if turned and start > 1 else None
        if re.search("[LS][tA]$", before) and told == (opening.way or opening.side):
            return [_likely(way, back=True)], at  # "turn left into the second left"
        if opening.stated or _is_taken(clause, opening, start, after):
            turn = ClauseEvent(
                "turn",
                way=opening.way or opening.side,
                ordinal=opening.ordinal,
                or_ordinal=opening.or_ordinal,
                nearest=opening.nearest,
                forced="K" in before,
            )
            return [turn], at
    elif turned and re.search("[LSA]$|[AU]V$", before):
        return [_likely(way, back=True)], at
    elif re.search("[Tt]", before) and "V" not in before:
        return [_likely(way, taken=True)], at
    elif re.search("[AU]$", before):
        return [_likely(way)], at
    exists = after.startswith("B") and "L" not in clause.kinds[start:at]
    if opening.ordinal is not None and not exists and before.strip("Q") == "":
        last = clause.last_event()
        told = last is not None and last.kind == "turn" and not last.forced
        back = told and not (before or after)  # "go right, the third one"
        return [_likely(way, back=back)], at
    return [way], at


def _words_of(clause: Clause, start: int) -> tuple[_Opening, int]:
    """Gather ordinal, noun and side as long as they belong together."""
    opening = _Opening()
    at = start
    kinds = clause.kinds
    while at < len(kinds):
        chunk = clause.chunks[at]
        sided = chunk.way not in {None, "forward"} and opening.side is None
        if chunk.kind == "O" and opening.ordinal is None and not opening.noun:
            opening.ordinal = int(chunk.number or 1)
            opening.or_ordinal = chunk.or_number
            opening.nearest = chunk.text.endswith(("next", "nearest"))
            if chunk.text.split()[-1] not in ORDINALS:
                opening.noun = chunk.text
        elif chunk.kind == "n" and not opening.noun and opening.count is None:
            opening.count = int(chunk.number or 1)
        elif chunk.kind == "J":
            opening.noun = f"{opening.noun} {chunk.text}".strip()
        elif chunk.kind == "T" and not opening.noun and chunk.text.startswith("turn"):
            opening.noun = chunk.text
        elif chunk.kind == "L" and sided:
            if opening.noun:
                verb = re.search("[TG]", kinds[:start])
                one = opening.noun.startswith("one")  # "one way left, leave it"
                if opening.ordinal is None and not verb and not one:
                    break  # "at the crossing right": the turn comes after the place
                opening.stated = not one or opening.ordinal is not None
            opening.side, opening.way = side_of(chunk), chunk.turn
        elif chunk.kind == "S" and sided:
            opening.side, opening.way = side_of(chunk), chunk.turn
            opening.towards = towards_a_side(chunk)
        elif (
            chunk.kind == "B" and opening.side is None and kinds[at + 1 : at + 2] == "L"
        ):
            opening.stated = True
        elif (
            chunk.kind == "B"
            and opening.ordinal is None
            and opening.noun
            and kinds[at + 1 :] == "S"
        ):
            opening.stated = _OWN.search(opening.noun) is not None
        elif chunk.kind == "G" and opening.noun and re.match("G[LS]", kinds[at:]):
            if re.search("[TtGA]", kinds[:start]) or not _OFF.match(chunk.text):
                break
            at += 1  # "one corridor goes off to the left"
            opening.side = side_of(clause.chunks[at])
        else:
            break
        at += 1
    return opening, at


def _likely(
    way: ClauseEvent, *, taken: bool = False, back: bool = False
) -> ClauseEvent:
    return replace(way, likely=True, taken=taken, back=back)


def _is_taken(clause: Clause, opening: _Opening, start: int, after: str) -> bool:
    before = clause.kinds[:start]
    if re.search("[TtGK]", before) and not re.search("[VB]", before):
        return True
    if not opening.noun or clause.kinds[start] == "L":
        return not after.startswith("B") or opening.ordinal is None
    if _BEND.search(opening.noun) and "A" not in before:
        return True
    if before.endswith("Z") and clause.chunks[start - 1].text.endswith(" the"):
        return True  # "it is the only turning on the left"
    if opening.noun and not (before or after) and place_is_named(clause):
        return True  # "up to the desk, and the branch to the left"
    if opening.towards and opening.ordinal is not None:
        return "B" not in before and not after.startswith("B")
    return re.search("[AU]$", before) is not None and opening.ordinal is not None


def _bare(
    clause: Clause, start: int, opening: _Opening, after: str, *, turned: bool
) -> list[ClauseEvent]:
    """Read a junction noun without ordinal and side."""
    before = clause.kinds[:start]
    placed = turned and re.search("[AQJ]$|AV$", before) is not None
    junction = _junction_of(opening.noun)
    is_crossed = before.endswith("HA") and not re.search("[LS2]", clause.kinds)
    if is_crossed and re.search(r"junction|intersection|cross", opening.noun):
        return [
            ClauseEvent("pass_ways", count=1, phrase=opening.name)
        ]  # "straight over at"
    if junction is not None:
        return [ClauseEvent("junction", junction=junction, back=placed)]
    at_one = re.search("A$|AV$", before) is not None
    if (placed or at_one) and re.search(r"junction|intersection|corner", opening.noun):
        return [ClauseEvent("junction", back=placed)]
    if opening.count is not None:
        if opening.count >= 3 and re.search("[AV]", before + after):
            return [ClauseEvent("junction", junction="crossing")]
        return [ClauseEvent("pass_ways", count=opening.count, phrase=opening.name)]
    if before.endswith("T") and not turned and _TAKEN.search(opening.noun):
        return [] if after.startswith("L") else [ClauseEvent("turn")]
    vague = re.search(r"\b(?:long|short)\b", opening.noun)
    length = [ClauseEvent("length", length=read_vague(vague[0]))] if vague else []
    if re.search("[tGT]$", before):
        into = re.search(r"into|down|through|enter", clause.chunks[start - 1].text)
        noun = opening.noun.split()[-1] if into else ""
        return [ClauseEvent("straight", phrase=noun), *length]
    return length


def _junction_of(noun: str) -> Junction | None:
    if re.search(r"\bt\b|t-?junction|\bfork|y-?junction", noun):
        return "t"
    if re.search(r"cross|four-way", noun):
        return "crossing"
    if re.search(r"corner|bend", noun):
        return "corner"
    return None


def read_left_alone(clause: Clause, at: int) -> tuple[ClauseEvent, int]:
    """Read the words for openings not to be taken, up to the last of them."""
    count: int | None = None
    side: Side | None = None
    name = ""
    last = at
    while at < len(clause.kinds) and clause.kinds[at] in "OJLSn":
        chunk = clause.chunks[at]
        if chunk.kind == "O":
            count = 1
        elif chunk.kind == "n" and chunk.number is not None:
            count = int(chunk.number)
        elif chunk.kind == "J" and count is None:
            count = None if chunk.text.endswith("s") else 1
        elif chunk.way is not None:
            side = side_of(chunk)
        if chunk.kind == "J":
            name = chunk.text
        last = at
        at += 1
    return ClauseEvent("pass_ways", count=count, side=side, phrase=name), last
