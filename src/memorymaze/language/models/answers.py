"""Models that keep answers in a file, or give those in a file.

An answer is found by the whole request; else, in a replay, by its question. So a mended
prompt does not orphan the answers to an older version; that they were given to another
one, the run says (`runs/episodes/plan.py`).
"""

import warnings
from dataclasses import replace
from pathlib import Path

from memorymaze.basics.errors import (
    LanguageModelError,
    RecordedAnswersWarning,
    SettingsError,
)
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.kept_answers import KeptAnswer, request_key
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    WrappedModel,
)


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


class RecordingModel(WrappedModel):
    """Asks a model and keeps its answers; what is kept already is not asked again."""

    def __init__(self, model: LanguageModel, path: Path | str) -> None:
        """Open or make the file."""
        super().__init__(model)
        self._file = AnswerFile.sound(path, make=True)

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the answer kept for a request, else ask, keep and return it.

        Where two processes ask the same at once, both return the answer that was kept.
        """
        self._file.refresh()
        kept = self._file.find(self.name, request)
        if kept is None:
            said = self._model.complete(request)
            kept = self._file.keep(self.name, request, said)
        return kept.completion(self.name)


class ReplayingModel:
    """Gives the answers in a file, and never asks a model."""

    def __init__(self, path: Path | str, *, name: str | None = None) -> None:
        """Look into a file; of one with several models one must be named."""
        self.file = AnswerFile.sound(path)
        self._warned = False
        models = self.file.models
        if not models and self.file.answers:
            # All of it is by hand.
            models = [name or self.file.path.stem]
        if name is None and len(models) == 1:
            [name] = models
        if name is None or (models and name not in models):
            raise SettingsError(
                f"{path}: expected replies of {name or 'a single model'}, "
                f"got replies of {', '.join(models) or 'none'}; name one of them with "
                "--model, or give another file"
            )
        self._name = name

    @property
    def name(self) -> str:
        """Name of the model whose answers these are."""
        return self._name

    def complete(self, request: CompletionRequest) -> Completion:
        """Return the answer to a request, else to its question.

        Where there is none for these pictures but one for pictures of their names,
        that is returned, and a warning says so once.
        """
        found = self.file.find(self._name, request) or self._by_names(request)
        asked = request.question
        if found is None and asked is not None and asked.instruction:
            found = self.file.find_by_question(self._name, asked)
        if found is not None:
            return found.completion(self._name)
        if asked is None or not asked.instruction:
            what = f"this request ({request_key(self._name, request)[:12]})"
        else:
            number = f" number {asked.number}" if asked.number > 1 else ""
            what = f"{asked.stage}{number} of {asked.instruction!r}"
        raise UnansweredError(
            f"{self.file.path}: no reply of {self._name} is recorded for {what}; it was "
            "never asked for, or differs from what was asked when recording",
            request,
        )

    @property
    def stages_answered(self) -> frozenset[str]:
        """The stages that there are answers to, without their variants."""
        return frozenset(stage.partition("+")[0] for _, stage in self.versions())

    def versions(self) -> dict[tuple[str, str], set[str | None]]:
        """Return the versions of prompts answered, by instruction and stage."""
        return self.file.stages(self._name)

    def _by_names(self, request: CompletionRequest) -> KeptAnswer | None:
        found = self.file.find_by_names(self._name, request)
        if found is not None and not self._warned:
            self._warned = True
            warnings.warn(
                f"{self.file.path}: the pictures differ from those that {self._name} was "
                "shown, as they do when drawn by another OpenGL; its replies to the "
                "pictures of the same names are taken",
                RecordedAnswersWarning,
                stacklevel=4,
            )
        return found
