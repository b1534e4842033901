"""Readers of descriptions: a text in, a plan of what it says out.

By the grammar, offline; by a language model that is asked once, and once more where its
reply is no plan; or not at all, where the text is a plan already.
"""

from typing import Literal, Protocol

from memorymaze.agents.agent import Journal, Need
from memorymaze.errors import LanguageModelError, PlanFileError
from memorymaze.input_files import parse_record, shown
from memorymaze.language.model import (
    CompletionRequest,
    LanguageModel,
    Message,
    Question,
)
from memorymaze.language.prompt_texts import load_prompt, prompt_version
from memorymaze.routes import RoutePlan, parse_plan
from memorymaze.understanding import parse_route_description

ReaderName = Literal["grammar", "model", "plan"]
"""The grammar, a language model, or nobody: the instruction is the JSON of a plan."""


class PlanReader(Protocol):
    """Turns a text into a plan."""

    @property
    def variant(self) -> str:
        """What tells an agent with this reader from one with the grammar: `[model]`."""
        ...

    @property
    def prompts(self) -> dict[str, str]:
        """The versions of its prompts, by stage; none where nobody is asked."""
        ...

    def requests_expected(self, instruction: str) -> list[CompletionRequest]:
        """Return what it will ask."""
        ...

    def read(self, instruction: str, journal: Journal) -> RoutePlan:
        """Return what an instruction says.

        Raises:
            LanguageModelError: A model did not answer, or not with a plan.
        """
        ...


class ReadsFirst:
    """An agent that reads its instruction before it moves; what runs ask it about that."""

    reader: PlanReader

    asks_beforehand = True
    """It asks nothing on the way."""

    @property
    def prompts(self) -> dict[str, str]:
        """The versions of its reader's prompts, by stage."""
        return self.reader.prompts

    def requests_expected(self, instruction: str) -> list[CompletionRequest] | None:
        """Return what its reader will ask; None where that is not all it asks."""
        return self.reader.requests_expected(instruction)


def needs_of_reader(reader: ReaderName) -> frozenset[Need]:
    """Return what an agent needs for its reader."""
    return frozenset({"language_model"} if reader == "model" else ())


class _AsksNobody:
    """A reader without a model."""

    @property
    def prompts(self) -> dict[str, str]:
        """None."""
        return {}

    def requests_expected(self, instruction: str) -> list[CompletionRequest]:
        """Return no request."""
        return []


class GrammarReader(_AsksNobody):
    """Reads with the grammar of `understanding`."""

    variant = ""

    def read(self, instruction: str, journal: Journal) -> RoutePlan:
        """Return what an instruction says."""
        return parse_route_description(instruction)


class WrittenPlanReader(_AsksNobody):
    """Takes instructions that are plans already, as JSON in the plan language.

    So one measures how an agent walks what was said, whoever understands it.
    """

    variant = "[plan]"

    def read(self, instruction: str, journal: Journal) -> RoutePlan:
        """Return the plan that an instruction is.

        Raises:
            PlanFileError: It is none.
        """
        return read_plan_reply(instruction)


def reader_without_model(reader: ReaderName) -> PlanReader:
    """Return the reader of a name where there is no model to ask: the grammar, or none."""
    return WrittenPlanReader() if reader == "plan" else GrammarReader()


class ModelReader:
    """Has a language model write the plan, in the plan language (`routes.records`)."""

    def __init__(self, model: LanguageModel, *, max_tokens: int = 4096) -> None:
        """Prepare the prompt.

        Args:
            model: Is asked once, and once more where the reply is no plan.
            max_tokens: Of a reply.
        """
        self._model = model
        self._max_tokens = max_tokens
        self._prompt = load_prompt("read_plan")

    @property
    def prompts(self) -> dict[str, str]:
        """The version of its prompt, by stage."""
        return {"plan": prompt_version(self._prompt)}

    @property
    def variant(self) -> str:
        """`[model]`."""
        return f"[{self._model.name}]"

    def requests_expected(self, instruction: str) -> list[CompletionRequest]:
        """Return the request for a plan."""
        return [self.request(instruction)]

    def request(self, instruction: str, *refused: tuple[str, str]) -> CompletionRequest:
        """Return what is asked, after replies that were refused and why."""
        turns = [Message("user", instruction.strip())]
        for reply, problem in refused:
            said = load_prompt("repair_plan", problem=problem)
            turns += [Message("assistant", reply), Message("user", said)]
        return CompletionRequest(
            messages=(Message("system", self._prompt), *turns),
            max_tokens=self._max_tokens,
            question=Question("plan", self.prompts["plan"], number=len(refused) + 1),
        )

    def read(self, instruction: str, journal: Journal) -> RoutePlan:
        """Return what an instruction says.

        Raises:
            LanguageModelError: The model did not answer, or twice not with a plan.
        """
        first = journal.ask(self._model, self.request(instruction), "plan")
        try:
            return read_plan_reply(first)
        except PlanFileError as error:
            journal.note("repair", error=str(error))
            refused = (first, str(error))
        second = journal.ask(self._model, self.request(instruction, refused), "plan")
        try:
            return read_plan_reply(second)
        except PlanFileError as error:
            raise LanguageModelError(
                f"{self._model.name}: expected a plan, got twice something else: {error}"
            ) from None


def read_plan_reply(reply: str) -> RoutePlan:
    """Return the plan in a reply: one JSON object, whatever stands around it.

    Raises:
        PlanFileError: There is none; says what is wrong with it.
    """
    begin, end = reply.find("{"), reply.rfind("}")
    if not 0 <= begin < end:
        raise PlanFileError(f"plan: expected one JSON object, got {shown(reply)}")
    try:
        record = parse_record(reply[begin : end + 1])
    except ValueError as error:
        raise PlanFileError(f"plan: {error}") from None
    return parse_plan(record, "plan")
