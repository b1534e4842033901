"""Answers in a file: JSONL, one answer a line, recorded, read from batches or by hand.

A recorded answer has a `key`: a digest of what was asked, by which it is found. One written
by hand has none, and is found by its question. Files are only ever appended to, by any
number of processes; several of them one after another are one. What a line may hold is in
`docs/language_models.md`.
"""

import warnings
from pathlib import Path

from memorymaze.basics.durable_files import append_lines, is_broken_off
from memorymaze.basics.errors import (
    AnswerFileError,
    LanguageModelError,
    RecordedAnswersWarning,
    SettingsError,
)
from memorymaze.basics.input_files import decoded, parse_record, read_file, refusal
from memorymaze.language.models.kept_answers import (
    KeptAnswer,
    pictures_shown,
    request_key,
)
from memorymaze.language.models.model import (
    Completion,
    CompletionRequest,
    ModelQuestion,
)

RECORDED = b'{"key": "'
"""What each line begins with that a run wrote; only such a line can have been broken off."""


class AnswerFile:
    """The answers in one file, sound or not, which others may add to.

    `problems` says what is wrong, one line each with its place; `unused` names fields that
    the format does not know.
    """

    def __init__(self, path: str | Path, *, make: bool = False) -> None:
        """Read the file, and find all that is wrong with it; make it if so wished."""
        self.path = Path(path)
        self.answers: list[KeptAnswer] = []
        self.problems: list[str] = []
        self.unused: dict[str, None] = {}
        self.places: dict[str, str] = {}
        """Where the last answer by hand to an instruction stands, `file:line`."""
        self._lines = self._end = 0
        self._by_key: dict[str, list[KeptAnswer]] = {}
        self._by_question: dict[tuple[str, int], list[KeptAnswer]] = {}
        self._by_hand: dict[tuple[object, ...], str] = {}
        if make:
            try:
                self.path.open("ab").close()
            except OSError as error:
                raise SettingsError(
                    f"{path}: expected a place for a file of answers ({error})"
                ) from None
        elif not self.path.exists():
            raise SettingsError(f"{path}: there are no recorded replies here")
        if self._read(read_file(path, AnswerFileError)):
            warnings.warn(
                f"{path}:{self._lines + 1}: the last answer was broken off while it was "
                "written; it is left out",
                RecordedAnswersWarning,
                stacklevel=2,
            )

    @classmethod
    def sound(cls, path: str | Path, *, make: bool = False) -> "AnswerFile":
        """Read a file; `AnswerFileError` names all that is wrong with it."""
        found = cls(path, make=make)
        if found.problems:
            raise refusal(found.problems, AnswerFileError)
        return found

    @property
    def models(self) -> list[str]:
        """Names of the models asked."""
        return sorted({each.model for each in self.answers if each.model})

    @property
    def is_by_hand(self) -> bool:
        """Whether somebody wrote all of it; else a run may have left some out."""
        return all(each.key is None for each in self.answers)

    def find(self, model: str, request: CompletionRequest) -> KeptAnswer | None:
        """Return the first answer to exactly this request, whoever gave it."""
        shown = pictures_shown(request)
        return next(
            (e for e in self._kept(model, request) if e.pictures == shown), None
        )

    def find_by_names(
        self, model: str, request: CompletionRequest
    ) -> KeptAnswer | None:
        """Return the one answer to this request with other pictures of the same names.

        OpenGL draws slightly other pixels on other machines.
        """
        found = self._kept(model, request)
        same = len({each.pictures for each in found}) == 1
        return found[0] if same else None

    def find_by_question(
        self, model: str, question: ModelQuestion
    ) -> KeptAnswer | None:
        """Return the answer to a question.

        One by hand under this version of the prompt or another; else the one that was
        recorded under the last other version. Under the same version that was given to
        another request: to another text, or in another place. None too where there are
        several.
        """
        asked = self._by_question.get((question.instruction, question.number), [])
        matching = [
            each
            for each in asked
            if each.answers(question.stage) and each.model in {None, model}
        ]
        by_hand = [each for each in matching if each.key is None]
        if by_hand:
            same = [each for each in by_hand if each.prompt == question.prompt]
            return (same or by_hand)[-1]
        prompts = [each.prompt for each in matching]
        if not matching or question.prompt in prompts:
            return None
        last = [each for each in matching if each.prompt == prompts[-1]]
        return last[0] if len({each.key for each in last}) == 1 else None

    def stages(
        self, model: str | None = None
    ) -> dict[tuple[str, str], set[str | None]]:
        """Return the versions of prompts answered, by instruction and stage."""
        found: dict[tuple[str, str], set[str | None]] = {}
        for each in self.answers:
            ours = model is None or each.model in {None, model}
            if ours and each.instruction_id and each.stage and not each.is_open:
                asked = found.setdefault((each.instruction_id, each.stage), set())
                asked.add(each.prompt)
        return found

    def keep(
        self, model: str, request: CompletionRequest, completion: Completion
    ) -> KeptAnswer:
        """Add an answer; return the one that counts, which another process may have."""
        ours = KeptAnswer.asked(model, request).said(completion)
        self._add(ours)
        return self.find(model, request) or ours

    def ask(self, model: str, request: CompletionRequest) -> str:
        """Keep a request that somebody else is to answer; return its id.

        Questions that are asked in the same words are one request.
        """
        ours = KeptAnswer.asked(model, request)
        known = [each for each in self.answers if each.key == ours.key]
        if ours not in known:
            self._add(ours)
        return (known or [ours])[0].id

    def answer(self, identifier: str, completion: Completion) -> None:
        """Keep the answer to a request that was kept before."""
        asked = [each for each in self.answers if each.is_open]
        keys = {each.key for each in asked if each.id == identifier}
        if not keys:
            raise ValueError(
                f"{self.path} has not asked {identifier!r}; give the store that "
                "`memorymaze answers requests` wrote the request to"
            )
        for each in [each for each in asked if each.key in keys]:
            ours = each.said(completion)
            known = self._by_key.get(each.key or "", [])
            if any(other.reply != ours.reply for other in known):
                raise ValueError(
                    f"{self.path} has another answer to {identifier!r} already; choose "
                    "another store to compare them"
                )
            if ours not in known:
                self._add(ours)

    def _kept(self, model: str, request: CompletionRequest) -> list[KeptAnswer]:
        return self._by_key.get(request_key(model, request), [])

    def refresh(self) -> None:
        """Read what was added since, by whomever."""
        try:
            with self.path.open("rb") as file:
                file.seek(self._end)
                self._read(file.read())
        except OSError as error:
            raise LanguageModelError(
                f"{self.path}: the recorded replies cannot be read ({error})"
            ) from error

    def _add(self, answer: KeptAnswer) -> None:
        try:
            append_answers(self.path, answer.line().encode() + b"\n")
        except OSError as error:
            raise LanguageModelError(
                f"{self.path}: the reply could not be kept ({error})"
            ) from error
        self.refresh()

    def _read(self, content: bytes) -> bool:
        """Read what comes next in the file; tell whether a last line was broken off."""
        *lines, last = content.split(b"\n")
        broken = is_broken_off(last, RECORDED)
        if last and not broken:
            lines.append(last)
        self._end += len(content) - (len(last) if broken else 0)
        text = decoded(b"\n".join(lines), self.path, AnswerFileError)
        for line in text.split("\n") if lines else ():
            self._lines += 1
            if not line.strip():
                continue
            place = f"{self.path}:{self._lines}"
            try:
                found, unknown = KeptAnswer.of_record(parse_record(line))
                self._index(found, place)
            except ValueError as error:
                self.problems.append(f"{place}: {error}")
                continue
            self.unused.update(dict.fromkeys(unknown))
        return broken

    def _index(self, found: KeptAnswer, place: str) -> None:
        if found.key is None:
            question = (found.instruction_id, found.stage, found.number, found.prompt)
            known = self._by_hand.setdefault((*question, found.model), place)
            if known != place:
                raise ValueError(
                    f"expected one answer to a question, got a second one to "
                    f"{found.stage} of {found.instruction_id!r}, which {known} has"
                )
            self.places[found.instruction_id or ""] = place
        self.answers.append(found)
        if found.is_open:
            return
        if found.key is not None:
            self._by_key.setdefault(found.key, []).append(found)
        if found.instruction_id is not None:
            question = (found.instruction_id, found.number)
            self._by_question.setdefault(question, []).append(found)


def append_answers(path: Path, lines: bytes) -> None:
    """Add lines to a file that other processes add to; they are on the disk then."""
    append_lines(path, lines, RECORDED)
