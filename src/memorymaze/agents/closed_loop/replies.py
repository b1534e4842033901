"""What a language model may answer on a walk, read strictly."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field, StringConstraints, ValidationError

from memorymaze.agents.asking import object_in
from memorymaze.basics.input_files import mistakes, parse_record

MOST_PHRASES = 12
"""Things to look for at a time."""

Action = Literal["walk", "go_back", "look", "stop", "give_up"]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
_Phrase = Annotated[str, StringConstraints(min_length=1, max_length=80, pattern=r"\S")]
_Note = Annotated[str, StringConstraints(min_length=1, max_length=400, pattern=r"\S")]

_BELONGS: dict[str, tuple[Action, ...]] = {
    "place": ("walk", "go_back"),
    "way": ("walk",),
    "until": ("walk",),
    "metres": ("walk",),
    "at": ("stop",),
}
"""The actions that a field goes with."""
_NEEDED: dict[Action, str] = {"walk": "way", "go_back": "place"}


class WalkDecision(BaseModel, frozen=True, extra="forbid", strict=True):
    """What to do next, and what the model thinks of the walk so far."""

    action: Action
    note: _Note
    """Which part of the text is done and what comes next; kept in the log."""
    turns_done: Annotated[int, Field(ge=0, le=200)]
    """Turns of the text that are made."""
    doubt: Share
    """That something told so far is wrong."""
    confidence: Share
    """That this answer is right; of a stop, that the destination is within 3 m."""
    thought: str = ""
    """What led to the answer; not kept."""
    look_for: Annotated[tuple[_Phrase, ...], Field(max_length=MOST_PHRASES)] | None = (
        None
    )
    """Things to look for from now on; None for those before."""
    place: int | None = None
    """Place to go to, or to go back to before taking a way; None for this one."""
    way: Annotated[str, StringConstraints(pattern="^[A-Z]$")] | None = None
    """The way out to take."""
    until: _Phrase | None = None
    """Thing beside which to halt on the way."""
    metres: Annotated[float, Field(gt=0, le=1000)] | None = None
    """Metres after which to halt on the way."""
    at: _Phrase | None = None
    """Thing to walk up to before stopping."""

    @property
    def exit(self) -> int | None:
        """The way out as the map counts them."""
        return None if self.way is None else ord(self.way) - ord("A")


def read_answer(reply: str) -> WalkDecision:
    """Return the answer in a reply: one JSON object, whatever stands around it.

    `ValueError` says what is wrong with it.
    """
    text = object_in(reply)
    parse_record(text)
    try:
        answer = WalkDecision.model_validate_json(text)
    except ValidationError as error:
        told = (f"{where}: {what}" for where, what in mistakes(error))
        raise ValueError("; ".join(told)) from None
    needed = _NEEDED.get(answer.action)
    if needed is not None and getattr(answer, needed) is None:
        raise ValueError(f"{needed}: expected it with the action {answer.action!r}")
    for name, actions in _BELONGS.items():
        if getattr(answer, name) is not None and answer.action not in actions:
            raise ValueError(
                f"{name}: expected it only with {' or '.join(actions)}, got it with "
                f"the action {answer.action!r}"
            )
    return answer
