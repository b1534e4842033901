"""Answers as an instruction file, and as a table with what else was measured."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import SettingsError, StudyError
from memorymaze.texts.corpus.files import write_instructions
from memorymaze.texts.corpus.records import Instruction
from memorymaze.texts.labels.consensus import Consensus, merged
from memorymaze.texts.labels.label_sheet import guarded_sheet
from memorymaze.web.studies.labels.labelling import Labelled, Labelling
from memorymaze.web.studies.schedule import TELLINGS, StudyStep
from memorymaze.web.studies.store import PageEvent, Participant, SentAnswer, Store
from memorymaze.web.studies.study_file import Study
from memorymaze.web.studies.tellings import StudyTelling, StudyTellings


@dataclass(frozen=True, slots=True)
class Exported:
    """What was written."""

    instructions: int
    participants: int
    table: Path
    """The CSV file beside the instruction file."""
    unwritten: int
    """Participants left out since a recording of theirs has no text yet."""
    lacking: tuple[str, ...]
    """Participants left out since a description of theirs never came."""
    settled: int
    """Instructions whose way and errors are labelled and settled."""


@dataclass(frozen=True, slots=True)
class _Telling:
    place: int
    told: StudyTelling
    answer: SentAnswer
    events: tuple[PageEvent, ...]

    @property
    def seconds(self) -> float:
        """Between the first look at the page and the answer."""
        opened = [
            each.at
            for each in self.events
            # Those of a video that was watched before are among them.
            if each.kind == "opened" and each.step == self.told.step
        ]
        return self.answer.at - min(opened, default=self.answer.at)

    def count(self, kind: str) -> int:
        """Return how often something happened on the page."""
        return sum(each.kind == kind for each in self.events)


def export_study(study: Study, store: Store, out: str | Path) -> Exported:
    """Write what all who finished have told, as `out` (JSONL) and a CSV file beside it.

    Neither ids of platforms nor times of day are in them; the store notes the export.
    """
    out = Path(out)
    if out.suffix != ".jsonl":
        raise SettingsError(f"--out: expected a file named *.jsonl, got {str(out)!r}")
    finished = [each for each in store.participants() if each.state == "complete"]
    if not finished:
        raise StudyError(
            f"{store.folder}: expected participants who have finished, got none; the "
            "experimenter's page shows how far they are"
        )
    tellings = StudyTellings(store)
    told: dict[str, dict[StudyStep, StudyTelling]] = {}
    for each in tellings.told():
        told.setdefault(each.participant, {})[each.step] = each
    lacking = tuple(
        who.id
        for who in finished
        if not told.get(who.id, {}).keys() >= set(_steps_told(who))
    )
    written = [
        who
        for who in finished
        if who.id not in lacking and all(x.text for x in told[who.id].values())
    ]
    if not written:
        never = f"; some of {', '.join(lacking)} never came" if lacking else ""
        raise StudyError(
            f"{store.folder}: expected participants whose descriptions all came and are "
            "written down, got none; the experimenter's page Texts lists what waits"
            f"{never}"
        )
    labelled = {
        each.instruction.id: each for each in Labelling(store, tellings).labelled()
    }
    settled = 0
    instructions: list[Instruction] = []
    rows: list[dict[str, Any]] = []
    for who in written:
        answers = store.answers(who.id)
        shared = _about(study, store, who, answers)
        for telling in _tellings(store, told[who.id], who, answers):
            instruction = tellings.instruction(telling.told)
            labels = labelled[instruction.id]
            agreed = labels.agreed
            if agreed is not None:
                settled += 1
                [instruction] = merged([instruction], [agreed])
            instructions.append(instruction)
            rows.append(_row(instruction, telling) | _labels(labels, agreed) | shared)
    # Noted first: what is killed meanwhile may be listed but not there, never there but
    # not listed.
    table = out.with_suffix(".csv")
    for path in (out, table):
        store.add_export(path, [each.id for each in written])
    write_instructions(out, instructions)
    write_whole(table, guarded_sheet(list(rows[0]), rows))
    unwritten = len(finished) - len(lacking) - len(written)
    return Exported(len(instructions), len(written), table, unwritten, lacking, settled)


def _steps_told(who: Participant) -> list[StudyStep]:
    return [StudyStep.of(kind, route) for route in who.order for kind in TELLINGS]


def _tellings(
    store: Store,
    told: dict[StudyStep, StudyTelling],
    who: Participant,
    answers: dict[StudyStep, SentAnswer],
) -> Iterator[_Telling]:
    for step in _steps_told(who):
        place = who.order.index(step.route) + 1
        events = store.events(who.id, step)
        if step.kind == TELLINGS[0]:
            watched = store.events(who.id, StudyStep.of("watch", step.route))
            events = [*watched, *events]
        yield _Telling(place, told[step], answers[step], tuple(events))


def _labels(labels: Labelled, agreed: Consensus | None) -> dict[str, Any]:
    if agreed is None:
        return {"way_told": "", "errors_labelled": ""}
    errors = len(agreed.failures or ())
    return {
        "way_told": agreed.way or " > ".join(labels.places) or "another",
        "errors_labelled": errors,
    }


def _about(
    study: Study, store: Store, who: Participant, answers: dict[StudyStep, SentAnswer]
) -> dict[str, Any]:
    attention = study.design.attention
    failed = [
        step
        for step, answer in answers.items()
        # Answers that an older version kept have no right answer with them.
        if step.kind == "attention"
        and answer.text != (answer.shown or attention[int(step.about)].answer)
    ]
    wrong = store.events(who.id, "comprehension")
    return {
        "attention_checks_failed": len(failed),
        "familiarity": "; ".join(
            answer.text
            for step, answer in answers.items()
            if step.kind == "familiarity"
        ),
        "comprehension_attempts": 1 + sum(each.kind == "wrong" for each in wrong),
    }


def _row(instruction: Instruction, telling: _Telling) -> dict[str, Any]:
    recording = telling.told.recording
    return {
        "id": instruction.id,
        "participant": instruction.participant,
        "study": instruction.study,
        "site": instruction.site,
        "route": instruction.route,
        "iteration": instruction.iteration,
        "place_in_order": telling.place,
        "text": instruction.text,
        "told_before": telling.answer.shown,
        "seconds": f"{telling.seconds:.1f}",
        "recording_seconds": f"{recording.seconds:.1f}" if recording else "",
        "video_plays": telling.count("play"),
        "video_watched_again": telling.count("again"),
        "video_ends": telling.count("ended"),
    }
