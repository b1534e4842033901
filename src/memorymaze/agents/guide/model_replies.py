"""What a language model may answer on a walk, read strictly."""

from typing import Annotated, Literal, TypeVar

from pydantic import BaseModel, Field, StringConstraints, ValidationError

from memorymaze.agents.asking import object_in
from memorymaze.input_files import mistakes, parse_record

MOST_PHRASES = 12
"""Things to look for at a time."""

Action = Literal["walk", "go_back", "look", "stop", "give_up"]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
Phrase = Annotated[str, StringConstraints(min_length=1, max_length=80, pattern=r"\S")]
Note = Annotated[str, StringConstraints(min_length=1, max_length=400, pattern=r"\S")]

_BELONGS: dict[str, tuple[Action, ...]] = {
    "place": ("walk", "go_back"),
    "way": ("walk",),
    "until": ("walk",),
    "metres": ("walk",),
    "at": ("stop",),
}
"""The actions that a field goes with."""
_NEEDED: dict[Action, str] = {"walk": "way", "go_back": "place"}


class Answer(BaseModel, frozen=True, extra="forbid", strict=True):
    """What to do next, and what the model thinks of the walk so far."""

    action: Action
    note: Note
    """Which part of the text is done and what comes next; kept in the log."""
    turns_done: Annotated[int, Field(ge=0, le=200)]
    """Turns of the text that are made."""
    doubt: Share
    """That something told so far is wrong."""
    confidence: Share
    """That this answer is right; of a stop, that the destination is within 3 m."""
    thought: str = ""
    """What led to the answer; not kept."""
    look_for: Annotated[tuple[Phrase, ...], Field(max_length=MOST_PHRASES)] | None = (
        None
    )
    """Things to look for from now on; None for those before."""
    place: int | None = None
    """Place to go to, or to go back to before taking a way; None for this one."""
    way: Annotated[str, StringConstraints(pattern="^[A-Z]$")] | None = None
    """The way out to take."""
    until: Phrase | None = None
    """Thing beside which to halt on the way."""
    metres: Annotated[float, Field(gt=0, le=1000)] | None = None
    """Metres after which to halt on the way."""
    at: Phrase | None = None
    """Thing to walk up to before stopping."""

    @property
    def exit(self) -> int | None:
        """The way out as the map counts them."""
        return None if self.way is None else ord(self.way) - ord("A")


class Choice(BaseModel, frozen=True, extra="forbid", strict=True):
    """Which of several steps is right."""

    step: Annotated[int, Field(ge=1)]
    """From 1."""
    note: Note
    """Why."""
    doubt: Share
    """That something told is wrong."""
    thought: str = ""


Record = TypeVar("Record", Answer, Choice)


def _read(kind: type[Record], reply: str) -> Record:
    """Return the record in a reply: one JSON object, whatever stands around it."""
    text = object_in(reply)
    parse_record(text)
    try:
        return kind.model_validate_json(text)
    except ValidationError as error:
        told = (f"{where}: {what}" for where, what in mistakes(error))
        raise ValueError("; ".join(told)) from None


def read_choice(reply: str, steps: int) -> Choice:
    """Return which of so many steps a reply chooses; `ValueError` says what is wrong."""
    choice = _read(Choice, reply)
    if choice.step > steps:
        raise ValueError(f"step: expected 1 to {steps}, got {choice.step}")
    return choice


def read_answer(reply: str) -> Answer:
    """Return the answer in a reply; `ValueError` says what is wrong with it."""
    answer = _read(Answer, reply)
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
