"""Labels that several people give descriptions on the plan, and what is settled of them."""

import json
from dataclasses import asdict, dataclass, replace

import numpy as np

from memorymaze.basics.errors import LabelFileError
from memorymaze.basics.tables import Table
from memorymaze.texts.corpus.records import Failure, Instruction
from memorymaze.texts.labels.agreement import agreement, agreement_table
from memorymaze.texts.labels.consensus import Consensus, consensus
from memorymaze.texts.labels.labels import NO_WAY, Label, text_stamp
from memorymaze.web.studies.labels.marking import Marks
from memorymaze.web.studies.store import Store
from memorymaze.web.studies.tellings import StudyTelling, StudyTellings


@dataclass(frozen=True, slots=True)
class Given:
    """A label and who gave it."""

    label: Label
    places: tuple[str, ...]
    """The turning points of a way that is none of the plan's."""
    settles: bool
    """Whether it was given to settle a difference."""


@dataclass(frozen=True, slots=True)
class Labelled:
    """A description and the labels of its present text."""

    told: StudyTelling
    instruction: Instruction
    labels: tuple[Given, ...]
    """Each given without a look at the others."""
    settled_by: Given | None

    @property
    def consensus(self) -> Consensus | None:
        """What two people or more, or who settled it, say; None before."""
        if self.settled_by is not None:
            [agreed] = consensus({("", ""): self.settled_by.label})
            is_other = self.settled_by.label.way == NO_WAY
            # To have settled that it is another way leaves nothing open.
            return _closed(agreed) if is_other else agreed
        if len(self.labels) < 2:
            return None
        [agreed] = consensus({
            (each.label.annotator, self.instruction.id): each.label
            for each in self.labels
        })
        ways = {each.label.way for each in self.labels}
        if ways == {NO_WAY} and len({each.places for each in self.labels}) == 1:
            return _closed(agreed, keep=("has a failure", "kind of failure"))
        return agreed

    @property
    def agreed(self) -> Consensus | None:
        """The consensus where nothing is open."""
        found = self.consensus
        return None if found is None or found.open else found

    @property
    def places(self) -> tuple[str, ...]:
        """The turning points of another way than the plan's, where it is settled."""
        if self.agreed is None or self.agreed.way is not None:
            return ()
        return (self.settled_by or self.labels[0]).places


def _closed(agreed: Consensus, keep: tuple[str, ...] = ()) -> Consensus:
    still = tuple(each for each in agreed.open if each.startswith(keep)) if keep else ()
    return replace(agreed, open=still)


class Labelling:
    """The labels in a store of answers."""

    def __init__(self, store: Store, tellings: StudyTellings) -> None:
        """Take the store, and what is told."""
        self._store = store
        self._tellings = tellings

    def add(
        self, told: StudyTelling, annotator: str, marks: Marks, *, settles: bool
    ) -> None:
        """Keep what somebody marked; it takes the place of what they marked before."""
        instruction = self._tellings.instruction(told)
        stamp = text_stamp(instruction.text)
        label = Label(instruction.id, stamp, annotator, marks.way, marks.failures)
        with self._store.writing() as rows:
            rows.execute(
                "INSERT OR REPLACE INTO labels SELECT ?1, ?2, ?3, ?4, ?5, ?6, ?7 WHERE "
                "EXISTS (SELECT 1 FROM participants WHERE id = ?1)",
                (
                    told.participant,
                    told.step,
                    annotator,
                    settles,
                    json.dumps(asdict(label), ensure_ascii=False),
                    json.dumps(marks.places),
                    self._store.now(),
                ),
            )

    def labelled(self) -> list[Labelled]:
        """Return every description that can be labelled; labels of older texts are left."""
        kept: dict[tuple[str, str], list[Given]] = {}
        for who, step, settles, label, places in self._store.rows(
            "SELECT participant, step, settles, label, places FROM labels ORDER BY at"
        ):
            read = json.loads(label)
            failures = tuple(Failure(**each) for each in read.pop("failures"))
            given = Given(
                Label(**read, failures=failures),
                tuple(json.loads(places)),
                bool(settles),
            )
            kept.setdefault((who, step), []).append(given)
        excluded = {
            each.id for each in self._store.participants() if each.state == "excluded"
        }
        return [
            self._labelled(told, kept.get((told.participant, told.step), []))
            for told in self._tellings.told()
            if told.text and told.participant not in excluded
        ]

    def _labelled(self, told: StudyTelling, kept: list[Given]) -> Labelled:
        instruction = self._tellings.instruction(told)
        stamp = text_stamp(instruction.text)
        current = [each for each in kept if each.label.text_sha256 == stamp]
        settling = [each for each in current if each.settles]
        return Labelled(
            told,
            instruction,
            tuple(each for each in current if not each.settles),
            settling[-1] if settling else None,
        )

    def agreement(self) -> Table | str:
        """Return how far people agree who labelled the same texts; or why it is unknown."""
        labelled = self.labelled()
        labels = {
            (each.label.annotator, each.label.instruction): each.label
            for some in labelled
            for each in some.labels
        }
        site = self._store.study.site
        try:
            found = agreement(
                labels,
                [each.instruction for each in labelled],
                {site.name: site},
                np.random.default_rng(0),
            )
        except LabelFileError as error:
            return str(error)
        return agreement_table(found, sorted({name for name, _ in labels}))
