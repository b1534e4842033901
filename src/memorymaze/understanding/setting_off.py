"""How one leaves from where one stands: `to your left, then right at the clock`."""

from collections.abc import Sequence, Set

from memorymaze.routes import Turn
from memorymaze.understanding.clause import Event
from memorymaze.understanding.event_order import (
    follows_the_sentence_of_a_thing,
    is_placed,
)
from memorymaze.understanding.partial_legs import PartialLeg

_JOINTS = {"clause", "then", "sentence"}


class SettingOff:
    """Knows which of the first words of a description say how one leaves."""

    def __init__(self, events: Sequence[Event]) -> None:
        """Take all events of a description."""
        self._events = events
        self._side: int | None = None
        """Where a side was said that may be how one leaves."""

    def is_told(self, event: Event, at: int, draft: PartialLeg) -> bool:
        """Tell whether the first turn, as it was joined, is where one stands.

        It is when it says so, or where one goes off to, and has no place of its own.
        Names alone are no place: `The library. Go to your left.`
        """
        if draft.walks or draft.placed or event.ordinal is not None:
            return False
        if is_placed(self._events, at):
            return False
        if event.here:
            return True
        apart = event.apposed or follows_the_sentence_of_a_thing(self._events, at)
        named = draft.called == set(range(len(draft.mentions)))
        return event.leaving and named and (apart or not draft.mentions)

    def note_side(self, event: Event, at: int) -> None:
        """Keep a side, until another is told of the same."""
        if event.leaving and self._side is None:
            self._side = at

    def side_before_a_turn(self, at: int) -> Turn | None:
        """`It is off to the left, and then right at the clock`: how one leaves."""
        if self._side is None or not self._events[self._side].of_goal:
            return None
        return self.take_side(at, {"then"})

    def take_side(self, at: int, joints: Set[str] = _JOINTS) -> Turn | None:
        """`It is off to the left, and you find it ahead`: the first is how one leaves."""
        said = self._side
        if said is None or not joints & {e.kind for e in self._events[said:at]}:
            return None
        self._side = None
        side = self._events[said].side
        return Turn(side) if side == "left" or side == "right" else None
