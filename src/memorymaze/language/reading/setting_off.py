"""How one leaves from where one stands: `to your left, then right at the clock`."""

from collections.abc import Sequence, Set

from memorymaze.language.plans import Turn
from memorymaze.language.reading.clause import ClauseEvent
from memorymaze.language.reading.event_order import is_placed
from memorymaze.language.reading.partial_legs import PartialLeg

_JOINTS = {"clause", "then", "sentence"}


class SettingOff:
    """Knows which of the first words of a description say how one leaves."""

    def __init__(self, events: Sequence[ClauseEvent]) -> None:
        """Take all events of a description."""
        self._events = events
        self._side: int | None = None
        """Where a side was said that may be how one leaves."""

    def is_told(self, event: ClauseEvent, at: int, draft: PartialLeg) -> bool:
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
        return event.leaving and draft.called == set(range(len(draft.mentions)))

    def note_side(self, event: ClauseEvent, at: int) -> None:
        """Keep a side, until another is told of the same."""
        if event.leaving and self._side is None:
            self._side = at

    def side_before_a_turn(self, at: int) -> Turn | None:
        """`It is off to the left, and then right at the clock`: how one leaves."""
        if self._side is None or not self._events[self._side].of_goal:
            return None
        return self.take_side(at, {"then"})

    def side_before_an_end(self, at: int) -> Turn | None:
        """`It is down there on the left, at the far end`: how one leaves."""
        here = self._side is not None and self._events[self._side].here
        return self.take_side(at) if here or self._events[at].of_goal else None

    def take_side(self, at: int, joints: Set[str] = _JOINTS) -> Turn | None:
        """`It is off to the left, and you find it ahead`: the first is how one leaves."""
        said = self._side
        if said is None or not joints & {e.kind for e in self._events[said:at]}:
            return None
        self._side = None
        side = self._events[said].side
        return Turn(side) if side == "left" or side == "right" else None
