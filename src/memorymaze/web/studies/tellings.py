"""What participants told, typed or said, in all its versions, and as instructions."""

from dataclasses import dataclass
from pathlib import Path

from memorymaze.texts.corpus.records import Instruction
from memorymaze.web.studies.schedule import TELLINGS, StudyStep
from memorymaze.web.studies.store import RECORDINGS, Store


@dataclass(frozen=True, slots=True)
class Recording:
    """A file with somebody's voice."""

    file: str
    participant: str
    step: str
    media_type: str
    seconds: float


@dataclass(frozen=True, slots=True)
class Transcript:
    """A version of what was said in a recording."""

    written_by: str
    is_heard: bool
    """Whether a recogniser wrote it."""
    text: str
    at: float


@dataclass(frozen=True, slots=True)
class StudyTelling:
    """A description, as far as it is known."""

    participant: str
    step: StudyStep
    """`tell.R1` or `retell.R1`."""
    recording: Recording | None
    versions: tuple[Transcript, ...]
    """What was typed first, then the others in the order they came."""

    @property
    def text(self) -> str:
        """What a person wrote last, else a recogniser; empty where nobody has yet."""
        by_people = [each for each in self.versions if not each.is_heard]
        latest = by_people or list(self.versions)
        return latest[-1].text if latest else ""

    @property
    def first_text(self) -> str:
        """The version before all corrections."""
        return self.versions[0].text if self.versions else ""

    @property
    def route(self) -> str:
        """The route it is about."""
        return self.step.route


class StudyTellings:
    """The descriptions in a store of answers."""

    def __init__(self, store: Store) -> None:
        """Take the store."""
        self._store = store

    def recordings(self) -> list[Recording]:
        """Return all recordings, in the order they came."""
        query = "SELECT file, participant, step, media_type, seconds FROM recordings"
        return [Recording(*row) for row in self._store.rows(f"{query} ORDER BY rowid")]

    def path_of(self, recording: Recording) -> Path:
        """Return where a recording lies."""
        return self._store.folder / RECORDINGS / recording.file

    def add_transcript(
        self, participant: str, step: str, written_by: str, text: str, *, is_heard: bool
    ) -> None:
        """Keep a version of what was said, unless the person has withdrawn."""
        with self._store.writing() as rows:
            rows.execute(
                "INSERT INTO transcripts SELECT ?1, ?2, ?3, ?4, ?5, ?6 WHERE EXISTS "
                "(SELECT 1 FROM participants WHERE id = ?1)",
                (participant, step, written_by, is_heard, text, self._store.now()),
            )

    def told(self, participant: str | None = None) -> list[StudyTelling]:
        """Return all descriptions, or those of one participant, typed or recorded."""
        recordings = {(each.participant, each.step): each for each in self.recordings()}
        versions: dict[tuple[str, str], list[Transcript]] = {}
        for who, step, text, at in self._store.rows(
            "SELECT participant, step, text, at FROM answers WHERE (step LIKE 'tell.%' "
            "OR step LIKE 'retell.%') AND (?1 IS NULL OR participant = ?1) "
            "ORDER BY rowid",
            participant,
        ):
            typed = [Transcript("", False, text, at)] if text else []
            versions[who, step] = typed
        for who, step, *row in self._store.rows(
            "SELECT participant, step, written_by, is_heard, text, at FROM transcripts "
            "ORDER BY rowid"
        ):
            if (who, step) in versions:
                by, is_heard, text, at = row
                versions[who, step].append(Transcript(by, bool(is_heard), text, at))
        return [
            StudyTelling(who, StudyStep(step), recordings.get((who, step)), tuple(some))
            for (who, step), some in versions.items()
        ]

    def instruction(self, told: StudyTelling) -> Instruction:
        """Return a description as a corpus has it."""
        study = self._store.study
        iteration = 1 if told.step.kind == TELLINGS[0] else 2
        is_corrected = told.first_text != told.text
        return Instruction(
            id=f"{told.participant}-{told.route.lower()}-{iteration}",
            site=study.site.name,
            route=told.route,
            study="online" if study.design.kind == "follow" else study.design.kind,
            iteration=iteration,
            participant=told.participant,
            text=told.text,
            source="human",
            language=study.design.language,
            original_text=told.first_text if is_corrected else None,
        )
