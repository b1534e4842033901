"""What agents note: a record for each kind of note that agents of this package make.

An agent's own notes may be of any kind and hold anything. One that holds what a record
here asks for is read as that record, whoever made it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Annotated, Any, ClassVar

from pydantic import Field, StrictFloat, StrictInt, TypeAdapter, ValidationError

Probability = Annotated[StrictFloat, Field(ge=0, le=1)]


@dataclass(frozen=True, slots=True)
class OwnNote:
    """A note of any kind."""

    about: str
    details: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class ShippedNote:
    """A note with a form; what is None unless it is told is left out then."""

    about: ClassVar[str]

    @property
    def details(self) -> dict[str, Any]:
        """What is told, by name."""
        told = ((each, getattr(self, each.name)) for each in fields(self))
        return {
            each.name: value
            for each, value in told
            if value is not None or each.default is not None
        }


Note = ShippedNote | OwnNote


# What was understood.


@dataclass(frozen=True, slots=True)
class PlanNote(ShippedNote):
    """What an agent read in the text."""

    about = "plan"
    steps: Sequence[str]
    """In their order, in words."""


@dataclass(frozen=True, slots=True)
class StepsNote(ShippedNote):
    """The steps that a language model parsed the text into."""

    about = "steps"
    steps: Sequence[str]


@dataclass(frozen=True, slots=True)
class DestinationNote(ShippedNote):
    """What an agent looks for that only searches."""

    about = "destination"
    names: Sequence[str]
    """The best first."""


# What was believed and decided on the way.


@dataclass(frozen=True, slots=True)
class BeliefNote(ShippedNote):
    """How far along its plan an agent believes to be."""

    about = "belief"
    at: StrictInt
    """The crossing, as the agent counts them."""
    legs: Annotated[Sequence[Probability], Field(min_length=1)]
    """The probability of each number of legs done, from none to all."""
    doubt: Probability
    """That something told is wrong."""

    @property
    def likeliest(self) -> int:
        """The number of legs most likely done."""
        return max(range(len(self.legs)), key=self.legs.__getitem__)


@dataclass(frozen=True, slots=True)
class DoubtNote(ShippedNote):
    """That something told is probably wrong."""

    about = "doubt"
    score: Probability = 1.0
    """How probable it is."""
    leg: StrictInt | None = None
    """From 1; one more than there are for the arrival."""
    at: StrictInt | None = None
    """The crossing."""
    kind_of: str | None = None
    """What is wrong, such as `no such turn`."""


@dataclass(frozen=True, slots=True)
class RepairNote(ShippedNote):
    """That an agent goes back for another explanation of what it was told."""

    about = "repair"
    leg: StrictInt | None = None
    """From 1; one more than there are for the arrival."""
    at: StrictInt | None = None
    """The crossing."""
    reason: Annotated[str, Field(max_length=200)] = ""


@dataclass(frozen=True, slots=True)
class DecisionNote(ShippedNote):
    """Which way is tried next."""

    about = "decision"
    at: StrictInt
    """The crossing."""
    exit: StrictInt
    """The way out of it, as the agent counts them."""
    probability: Probability | None = None
    """That it is the right one."""
    legs_done: StrictInt | None = None
    """Of the plan."""
    because: Sequence[str] | None = None
    """What speaks for it."""


@dataclass(frozen=True, slots=True)
class AskedNote(ShippedNote):
    """What a passer-by was asked and said."""

    about = "asked"
    question: str
    answer: str


@dataclass(frozen=True, slots=True)
class ArrivalNote(ShippedNote):
    """That an agent believes to be there."""

    about = "arrival"
    reason: str | None = None
    score: StrictFloat | None = None
    """How well what was seen fits."""
    confidence: Probability | None = None
    """That it is there."""
    because: Sequence[str] | None = None
    """What speaks for it."""


@dataclass(frozen=True, slots=True)
class GaveUpNote(ShippedNote):
    """That an agent could not find the way."""

    about = "gave_up"
    reason: str | None = None
    confidence: Probability | None = None
    """That it is there all the same."""


# What was asked of language models, and of programs.


@dataclass(frozen=True, slots=True)
class ModelReplyNote(ShippedNote):
    """A reply of a language model, and what it cost."""

    about = "model_reply"
    stage: str
    """What was asked for, such as `program`."""
    model: str
    text: str
    prompt_tokens: StrictInt
    completion_tokens: StrictInt
    cost_usd: StrictFloat | None
    """None where no price is known."""
    latency: StrictFloat
    """Real seconds."""
    standing_s: StrictFloat
    """Simulated seconds that the user stood waiting."""


@dataclass(frozen=True, slots=True)
class UnusableReplyNote(ShippedNote):
    """Why a reply could not be used, and was asked for again."""

    about = "unusable_reply"
    stage: str
    problem: str


@dataclass(frozen=True, slots=True)
class ProgramNote(ShippedNote):
    """A program that a language model wrote; it is run next."""

    about = "program"
    program: str


@dataclass(frozen=True, slots=True)
class ProgramRepairNote(ShippedNote):
    """What a program failed of; another is asked for."""

    about = "repair"
    error: str
    calls: StrictInt
    """That it had made."""


@dataclass(frozen=True, slots=True)
class ProgramDoubtsNote(ShippedNote):
    """What a type checker finds in a program."""

    about = "doubts"
    doubts: Sequence[str]


@dataclass(frozen=True, slots=True)
class RefusedCallNote(ShippedNote):
    """A call of a program that was none of the control API's."""

    about = "refused_call"
    line: StrictInt | None
    call: str
    message: str


@dataclass(frozen=True, slots=True)
class PrintNote(ShippedNote):
    """What a program printed."""

    about = "print"
    text: str


@dataclass(frozen=True, slots=True)
class TracebackNote(ShippedNote):
    """Where an agent failed unforeseen."""

    about = "traceback"
    lines: Sequence[str]


@dataclass(frozen=True, slots=True)
class LeftOutNote(ShippedNote):
    """Notes that were too long for the trace, told of in their place."""

    about = "left_out"
    what: str
    """Such as `note seen`, or `further notes`."""
    entries: StrictInt
    bytes: StrictInt


# Of agents that go step by step by pictures.


@dataclass(frozen=True, slots=True)
class MotionsNote(ShippedNote):
    """What was read from an answer to a picture: motions, or the problem with it."""

    about = "decision"
    step: StrictInt
    picture: str
    """Beginning of the SHA-256 of its pixels."""
    problem: str | None = None
    motions: Sequence[tuple[str, StrictInt]] | None = None
    """Each with how often."""


@dataclass(frozen=True, slots=True)
class RandomMotionNote(ShippedNote):
    """A motion drawn in place of an answer that could not be read."""

    about = "random_motion"
    step: StrictInt
    motion: str


@dataclass(frozen=True, slots=True)
class OutOfStepsNote(ShippedNote):
    """That no step is left."""

    about = "out_of_steps"
    step: StrictInt
    limit: StrictInt


@dataclass(frozen=True, slots=True)
class StuckNote(ShippedNote):
    """That the last steps brought no motion."""

    about = "stuck"
    step: StrictInt
    still_steps: StrictInt


@dataclass(frozen=True, slots=True)
class SaidAndDoneNote(ShippedNote):
    """What a model said that it wants to do, and what came of it."""

    about = "move"
    said: str
    done: str


# Of NavGPT on a graph.


@dataclass(frozen=True, slots=True)
class ObservationNote(ShippedNote):
    """What was told of a viewpoint."""

    about = "observation"
    viewpoint: str
    described_by: str
    text: str


@dataclass(frozen=True, slots=True)
class ThoughtNote(ShippedNote):
    """What a model thought."""

    about = "thought"
    text: str


@dataclass(frozen=True, slots=True)
class ViewpointMoveNote(ShippedNote):
    """A way to another viewpoint that was gone."""

    about = "move"
    start: str
    end: str
    heading_deg: StrictFloat
    """Of a compass."""
    distance: StrictFloat
    """Metres."""


@dataclass(frozen=True, slots=True)
class BlockedMoveNote(ShippedNote):
    """A way on which something stood."""

    about = "blocked_move"
    viewpoint: str
    reason: str
    distance: StrictFloat
    """Metres until then."""


@dataclass(frozen=True, slots=True)
class RefusedMoveNote(ShippedNote):
    """A viewpoint that cannot be gone to from here."""

    about = "refused_move"
    viewpoint: str
    why: str


@dataclass(frozen=True, slots=True)
class ParseFailureNote(ShippedNote):
    """A reply that could not be read."""

    about = "parse_failure"
    fault: str
    told: str
    """What the model was told of it."""


@dataclass(frozen=True, slots=True)
class FinalAnswerNote(ShippedNote):
    """With what words a model ended the walk."""

    about = "final_answer"
    text: str


@dataclass(frozen=True, slots=True)
class NavGPTCountsNote(ShippedNote):
    """What happened in an episode of NavGPT, and its limits."""

    about = "navgpt"
    requests: StrictInt
    moves: StrictInt
    blocked_moves: StrictInt
    refused_unknown: StrictInt
    refused_not_adjacent: StrictInt
    parse_failures: Mapping[str, StrictInt]
    """By fault."""
    iterations: StrictInt
    scratchpad: StrictInt
    failures: StrictInt | None


SHIPPED_NOTES: tuple[type[ShippedNote], ...] = (
    PlanNote,
    StepsNote,
    DestinationNote,
    BeliefNote,
    DoubtNote,
    DecisionNote,
    MotionsNote,
    ProgramRepairNote,
    RepairNote,
    AskedNote,
    ArrivalNote,
    GaveUpNote,
    ModelReplyNote,
    UnusableReplyNote,
    ProgramNote,
    ProgramDoubtsNote,
    RefusedCallNote,
    PrintNote,
    TracebackNote,
    LeftOutNote,
    RandomMotionNote,
    OutOfStepsNote,
    StuckNote,
    SaidAndDoneNote,
    ObservationNote,
    ThoughtNote,
    ViewpointMoveNote,
    BlockedMoveNote,
    RefusedMoveNote,
    ParseFailureNote,
    FinalAnswerNote,
    NavGPTCountsNote,
)
"""Of two kinds that go by one name, the one that asks for more comes first."""

_READERS = {each: TypeAdapter(each) for each in SHIPPED_NOTES}


def note_of(about: str, details: Mapping[str, Any]) -> Note:
    """Return a note as the record that it fits; what else it tells stays in its details."""
    for each, reader in _READERS.items():
        if each.about == about:
            try:
                return reader.validate_python(details)
            except ValidationError:
                continue
    return OwnNote(about, details)
