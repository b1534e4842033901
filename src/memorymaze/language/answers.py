"""Models that keep answers, or give the answers in a store or a file.

An answer is found by the whole request; else, in a replay, by its question. So a mended
prompt does not orphan the answers to an older version; that they were given to another
one, the run says (`evaluation/answers.py`).
"""

import warnings
from dataclasses import replace
from pathlib import Path

from memorymaze.errors import (
    AnswerFileError,
    LanguageModelError,
    RecordedPicturesWarning,
    SettingsError,
)
from memorymaze.input_files import refusal
from memorymaze.language.answer_files import AnswerFile
from memorymaze.language.answer_store import AnswerStore, request_key
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    WrappedModel,
    takes_grammar,
    takes_pictures,
)

SQLITE = b"SQLite format 3\0"


def open_answers(path: str | Path) -> AnswerStore | AnswerFile:
    """Open a store, or read a file of answers."""
    path = Path(path)
    try:
        with path.open("rb") as file:
            beginning = file.read(len(SQLITE))
    except OSError:
        beginning = SQLITE
    if beginning == SQLITE:
        return AnswerStore(path)
    answers = AnswerFile(path)
    if answers.problems:
        raise refusal(answers.problems, AnswerFileError)
    return answers


class UnansweredError(LanguageModelError):
    """There is no answer to a request, which is at hand for somebody to answer."""

    def __init__(self, message: str, request: CompletionRequest) -> None:
        """Keep the request."""
        super().__init__(message)
        self.request = request


class AboutInstruction(WrappedModel):
    """A model asked about an instruction; says so in the question of each request."""

    def __init__(self, model: LanguageModel, instruction: str) -> None:
        """Stand before a model; agents do not know the id of their instruction."""
        super().__init__(model)
        self.instruction = instruction
        """Id of the one that it is asked about."""

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask the model."""
        if request.question is not None:
            question = replace(request.question, instruction=self.instruction)
            request = replace(request, question=question)
        return self._model.complete(request)


class RecordingModel:
    """Asks a model and keeps its answers; what is kept already is not asked again."""

    def __init__(self, model: LanguageModel, path: Path | str) -> None:
        """Open or make the store."""
        self._model = model
        self._store = AnswerStore(path, make=True)

    @property
    def name(self) -> str:
        """Name of the model asked."""
        return self._model.name

    @property
    def takes_pictures(self) -> bool:
        """Whether the model asked may be shown pictures."""
        return takes_pictures(self._model)

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the answer kept for a request, else ask, keep and return it.

        Where two processes ask the same at once, both return the answer that was kept.
        """
        if not takes_grammar(self._model):
            # It does not determine the reply, so it is not in the key.
            request = replace(request, grammar=None)
        kept = self._store.find(self.name, request)
        if kept is not None:
            return kept
        return self._store.keep(self.name, request, self._model.complete(request))


class ReplayingModel:
    """Gives the answers in a store or a file, and never asks a model."""

    def __init__(self, path: Path | str, *, name: str | None = None) -> None:
        """Look into a store or a JSONL file of answers.

        Of a store with several models one must be named; answers of a file get the name.
        """
        self.answers = open_answers(path)
        self._path = Path(path)
        self._warned = False
        if isinstance(self.answers, AnswerFile):
            self._name = name or self.answers.model
            return
        models = self.answers.models
        if name not in models and not (name is None and len(models) == 1):
            raise SettingsError(
                f"{self._path}: expected replies of {name or 'a single model'}, "
                f"got replies of {', '.join(models) or 'none'}"
            )
        self._name = name or models[0]

    @property
    def name(self) -> str:
        """Name of the model whose answers these are."""
        return self._name

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the answer to a request, else to its question.

        Where there is none for these pictures but one for pictures of their names,
        that is returned, and a warning says so once.
        """
        found = self._by_request(request) or self._by_question(request)
        if found is not None:
            return found
        asked = request.question
        if asked is None or not asked.instruction:
            what = f"this request ({request_key(self._name, request)[:12]})"
        else:
            number = f" number {asked.number}" if asked.number > 1 else ""
            what = f"{asked.stage}{number} of {asked.instruction!r}"
        raise UnansweredError(
            f"{self._path}: no reply of {self._name} is recorded for {what}; it was "
            "never asked for, or differs from what was asked when recording",
            request,
        )

    @property
    def stages_answered(self) -> frozenset[str]:
        """The stages that there are answers to, without their variants."""
        return frozenset(stage.partition("+")[0] for _, stage in self.versions())

    def versions(self) -> dict[tuple[str, str], set[str | None]]:
        """Return the versions of prompts answered, by instruction and stage."""
        if isinstance(self.answers, AnswerFile):
            return self.answers.stages()
        return self.answers.stages(self._name)

    def _by_request(self, request: CompletionRequest) -> Completion | None:
        if isinstance(self.answers, AnswerFile):
            return None
        # Whether the model recorded was held to a grammar, its replies tell.
        ways = dict.fromkeys((request, replace(request, grammar=None)))
        for each in ways:
            kept = self.answers.find(self._name, each)
            if kept is not None:
                return kept
        for each in ways:
            kept = self.answers.find_by_names(self._name, each)
            if kept is not None:
                self._warn()
                return kept
        return None

    def _by_question(self, request: CompletionRequest) -> Completion | None:
        question = request.question
        if question is None or not question.instruction:
            return None
        if isinstance(self.answers, AnswerStore):
            return self.answers.find_by_question(self._name, question)
        answer = self.answers.find_by_question(question)
        if answer is None:
            return None
        if answer.completion is None:
            raise LanguageModelError(answer.error or "the model did not answer")
        return replace(answer.completion, model=self._name)

    def _warn(self) -> None:
        if not self._warned:
            self._warned = True
            warnings.warn(
                f"{self._path}: the pictures differ from those that {self._name} was "
                "shown, as they do when drawn by another OpenGL; its replies to the "
                "pictures of the same names are taken",
                RecordedPicturesWarning,
                stacklevel=4,
            )
