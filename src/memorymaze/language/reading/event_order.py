"""What stands before and after an event: whether a turn has its place, a thing its turn."""

from collections.abc import Sequence

from memorymaze.language.reading.clause import ClauseEvent


def is_placed(events: Sequence[ClauseEvent], at: int) -> bool:
    """Tell whether a turn is said with a place: `the second left`, `left at the clock`."""
    following = events[at + 1 : at + 2]
    return events[at].ordinal is not None or any(each.back for each in following)


def told_since_turn(events: Sequence[ClauseEvent], at: int) -> int | None:
    """Count what was told since the last turn of this sentence; None without one."""
    told = 0
    for earlier in reversed(events[:at]):
        if earlier.kind in {"turn", "sentence", "then"}:
            return told if earlier.kind == "turn" else None
        told += earlier.kind != "clause"
    return None


def follows_a_thing(events: Sequence[ClauseEvent], at: int) -> bool:
    """Tell whether the sentence named a thing last, not bound to a place."""
    arrives = False
    for earlier in reversed(events[:at]):
        if earlier.kind in {"sentence", "turn", "then"}:
            return arrives
        if earlier.kind == "arrive":
            return True
        if earlier.kind == "thing" and earlier.relation != "at":
            return earlier.relation in {"see", "seen", "into"}
    return arrives


def counted_from(events: Sequence[ClauseEvent], at: int) -> ClauseEvent | None:
    """Return the thing that a length counted in places begins at, if it is told.

    As in `two junctions after the lift`, but not in `go two segments past the lift`.
    """
    length, following = events[at].length, events[at + 1 : at + 2]
    if length is None or length.unit != "places":
        return None
    for thing in following:
        past = thing.relation == "past" and length.count == 1
        if thing.relation == "after" or past:
            return thing
    return None


def ends_the_sentence_of_a_turn(events: Sequence[ClauseEvent], at: int) -> bool:
    """`Turn right, opposite the hall.`: a place said last, after a turn."""
    for later in events[at + 1 :]:
        if later.kind == "sentence":
            break
        if later.kind not in {"side", "clause", "thing", "take"}:
            return False
    for earlier in reversed(events[:at]):
        if earlier.kind in {"sentence", "turn", "arrive"}:
            return earlier.kind == "turn"
    return False
