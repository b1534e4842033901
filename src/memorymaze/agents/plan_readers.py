"""Readers of descriptions: a text in, a plan of what it says out.

By the grammar, offline; by a language model that is asked once, and once more where its
reply is no plan; or not at all, where the text is a plan already.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count
from typing import Literal

from memorymaze.agents.agent import (
    Asking,
    FairLimits,
    Journal,
    Need,
    prompt_versions,
    tellings_of,
)
from memorymaze.agents.asking import ask_until_read, object_in
from memorymaze.agents.reader_doubts import likely_names, with_doubted_turns
from memorymaze.basics.errors import PlanFileError, SettingsError
from memorymaze.basics.input_files import parse_record
from memorymaze.language.models.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    ModelQuestion,
)
from memorymaze.language.models.prompt_texts import load_prompt, prompt_version
from memorymaze.language.plans import Mention, RoutePlan, parse_plan
from memorymaze.language.plans.grammar import plan_grammar
from memorymaze.language.reading import is_floor, parse_route_description
from memorymaze.language.reading.marking import read_by_marks

ReaderName = Literal["both", "grammar", "learned", "model", "plan"]
"""The grammar and the network that was trained, one of them, a language model, or nobody:
the instruction is the JSON of a plan."""


class PlanReader(ABC):
    """Turns a text into a plan; asks nobody unless it says so."""

    @property
    def variant(self) -> str:
        """What tells an agent with this reader from one with the default: `[model]`."""
        return ""

    def requests_expected(self, instruction: str) -> list[CompletionRequest]:
        """Return what it will ask."""
        return []

    def read(self, instruction: str, journal: Journal) -> RoutePlan:
        """Return what an instruction says, whole."""
        return self._read(instruction, journal, count(1))

    def read_tellings(
        self, instruction: str, journal: Journal
    ) -> list[list[RoutePlan]]:
        """Return the readings of each telling of an instruction, in their order."""
        numbers = count(1)
        told = tellings_of(instruction)
        return [[self._read(telling, journal, numbers)] for telling in told]

    @abstractmethod
    def _read(
        self, instruction: str, journal: Journal, numbers: Iterator[int]
    ) -> RoutePlan:
        """Return what an instruction says; a model's requests get these numbers."""


class GrammarReader(PlanReader):
    """Reads with the grammar of `reading`."""

    @property
    def variant(self) -> str:
        """`[grammar]`."""
        return "[grammar]"

    def _read(
        self, instruction: str, journal: Journal, numbers: Iterator[int]
    ) -> RoutePlan:
        return parse_route_description(instruction)


class LearnedReader(PlanReader):
    """Reads with the network that marks what words say."""

    @property
    def variant(self) -> str:
        """`[learned]`."""
        return "[learned]"

    def _read(
        self, instruction: str, journal: Journal, numbers: Iterator[int]
    ) -> RoutePlan:
        return read_by_marks(instruction)


class BothReader(GrammarReader):
    """Reads with the grammar and with the network, of which one may be right.

    They err on different texts. One plan alone is the grammar's.
    """

    @property
    def variant(self) -> str:
        """Nothing: these are what an agent has unless it is told otherwise."""
        return ""

    def read_tellings(
        self, instruction: str, journal: Journal
    ) -> list[list[RoutePlan]]:
        """Return what both make of each telling.

        It is one plan where they agree, and where one of them finds no turn at all: that
        one has missed them. Both go to what either takes for the destination, each name
        with the doubt whether it is, and doubt each turn whether it is one.
        """
        tellings: list[list[RoutePlan]] = []
        for telling in tellings_of(instruction):
            parsed, marked = parse_route_description(telling), read_by_marks(telling)
            names = likely_names(telling, parsed, marked)
            read = [_to(names, each) for each in with_doubted_turns(parsed, marked)]
            with_turns = [plan for plan in read if plan.legs]
            tellings.append(list(dict.fromkeys(with_turns or read[:1])))
        return tellings


def _to(names: Sequence[tuple[str, float]], plan: RoutePlan) -> RoutePlan:
    arrival = replace(
        plan.arrival,
        destinations=tuple(name for name, _ in names),
        unclear_names=tuple(round(1 - chance, 2) for _, chance in names),
    )
    return replace(plan, arrival=arrival)


class WrittenPlanReader(PlanReader):
    """Takes instructions that are plans already, as JSON in the plan language.

    So one measures how an agent walks what was said, whoever understands it.
    """

    @property
    def variant(self) -> str:
        """`[plan]`."""
        return "[plan]"

    def _read(
        self, instruction: str, journal: Journal, numbers: Iterator[int]
    ) -> RoutePlan:
        """Return the plan that an instruction is; `PlanFileError` where it is none."""
        return read_plan_reply(instruction)


class ModelReader(PlanReader):
    """Has a language model write the plan, in the plan language (`routes.records`)."""

    def __init__(self, model: LanguageModel) -> None:
        """Prepare the prompt."""
        self._model = model
        self._prompt = load_prompt("read_plan")
        self._question = ModelQuestion("plan", prompt_version(self._prompt))

    @property
    def variant(self) -> str:
        """`[model]`."""
        return f"[{self._model.name}]"

    def requests_expected(self, instruction: str) -> list[CompletionRequest]:
        """Return the request for a plan."""
        turns = Message("system", self._prompt), Message("user", instruction.strip())
        return [
            CompletionRequest(
                turns,
                max_tokens=4096,
                grammar=plan_grammar(),
                question=self._question,
            )
        ]

    def _read(
        self, instruction: str, journal: Journal, numbers: Iterator[int]
    ) -> RoutePlan:
        """Return what an instruction says, as the model answers."""
        [request] = self.requests_expected(instruction)
        return ask_until_read(
            self._model,
            journal,
            request,
            self._question,
            numbers,
            _read_plan,
            "repair_plan",
        )


@dataclass(frozen=True, slots=True)
class ReaderOptions:
    """What can be set of an agent that begins by reading."""

    reader: ReaderName = "both"
    """What turns the text into a plan: the grammar and the trained network, offline
    (`both`), one of them, a language model, or nobody, where the text is the JSON of a
    plan (`plan`)."""

    @property
    def needs(self) -> frozenset[Need]:
        """What the agent needs with these options."""
        return frozenset({"language_model"} if self.reader == "model" else ())


class ReadsFirst:
    """An agent that reads its instruction before it moves, as its options say."""

    def __init__(self, options: ReaderOptions, model: LanguageModel | None) -> None:
        """Make the reader of the options, with the model where they need one."""
        if ("language_model" in options.needs) != (model is not None):
            wanted = "one" if model is None else "none"
            got = "none" if model is None else model.name
            raise SettingsError(
                "expected a language model if the agent's options need one, and only then; "
                f"these need {wanted}, got {got}"
            )
        self.reader = _reader(options, model)

    def asking(self, instruction: str, limits: FairLimits | None) -> Asking:
        """Tell what its reader will ask; nothing else is asked on the way."""
        told = tellings_of(instruction)
        asked = [each for one in told for each in self.reader.requests_expected(one)]
        return Asking(prompt_versions(asked), beforehand=True, requests=asked)


def _reader(options: ReaderOptions, model: LanguageModel | None) -> PlanReader:
    if model is not None:
        return ModelReader(model)
    readers = {
        "both": BothReader,
        "grammar": GrammarReader,
        "learned": LearnedReader,
        "plan": WrittenPlanReader,
    }
    return readers[options.reader]()


def read_plan_reply(reply: str) -> RoutePlan:
    """Return the plan in a reply: one JSON object, whatever stands around it.

    `PlanFileError` says why there is none.
    """
    try:
        record = parse_record(object_in(reply))
    except ValueError as error:
        raise PlanFileError(f"plan: {error}") from None
    plan = parse_plan(record, "plan")
    legs = (replace(leg, mentions=_floors_named(leg.mentions)) for leg in plan.legs)
    arrival = replace(plan.arrival, mentions=_floors_named(plan.arrival.mentions))
    return replace(plan, legs=tuple(legs), arrival=arrival)


def _floors_named(mentions: Iterable[Mention]) -> tuple[Mention, ...]:
    """Name floors so that they are looked for as floors: `carpet` is the `carpet floor`."""
    return tuple(
        replace(each, phrase=f"{each.phrase} floor")
        if each.kind == "floor" and not is_floor(each.phrase)
        else each
        for each in mentions
    )


def _read_plan(reply: str) -> RoutePlan:
    try:
        return read_plan_reply(reply)
    except PlanFileError as error:
        raise ValueError(str(error)) from None
