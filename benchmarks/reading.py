"""How much of what texts say the grammar reads, beside plans that a language model read.

Both readings of the 564 shipped texts are compared part by part, and two readings of 60
texts by the model with each other, which is what agreement can be had at best:
`python -m benchmarks.reading` (docs/lab/benches.md).

`--made K` compares what right made-up texts on K floors of each kind of building say with what
the grammar reads (or `--reader learned`): the share of legs whose turn, count and thing at the turn are read as told.

The plans come from the kind of model that wrote the texts, so agreement flatters. Those
of participants whose texts were not read while the grammar was developed (`held_out`) are
used as numbers only.
"""

import argparse
import json
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.made_walks import floor_seeds, made_floors
from memorymaze.agents.plan_readers import read_plan_reply
from memorymaze.agents.reader_doubts import aligned_turns
from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.tables import Column, Table
from memorymaze.language.plans import Arrival, Leg, RoutePlan
from memorymaze.language.reading import parse_route_description, place_on_sign
from memorymaze.language.reading.marking import read_by_marks
from memorymaze.texts.corpus import load_corpus
from memorymaze.texts.corpus.records import Episode
from memorymaze.texts.writing import ErrorRates, cells_of, sample_outlines, write_texts
from memorymaze.world.construction import BUILDING_KINDS, BuildingKind

READERS: dict[str, Callable[[str], RoutePlan]] = {
    "grammar": parse_route_description,
    "learned": read_by_marks,
}
RECORDED = Path(__file__).parents[1] / "examples" / "recorded"
SAME_LENGTH = 0.2
"""Lengths that differ by no more than this share of the longer one are the same."""
PARTS = {
    "turns": "every turn, in order",
    "turn": "turns",
    "ordinal": "counts",
    "length": "lengths",
    "landmark": "things",
    "placed": "things, with place",
    "destination": "destination",
}


@dataclass
class Agreement:
    """How often two readings say the same of one part."""

    both: float = 0.0
    reference: float = 0.0
    """How often the reference says it."""
    read: float = 0.0

    def add(self, both: float, reference: float, read: float) -> None:
        """Add another text."""
        self.both += both
        self.reference += reference
        self.read += read

    @property
    def f1(self) -> float | None:
        """Harmonic mean of precision and recall; None where neither says anything."""
        told = self.reference + self.read
        return 2 * self.both / told if told else None


@dataclass
class Score:
    """The agreement on all parts, over texts."""

    texts: int = 0
    parts: dict[str, Agreement] = field(
        default_factory=lambda: {name: Agreement() for name in PARTS}
    )

    def add(self, reference: RoutePlan, read: RoutePlan) -> None:
        """Compare two plans of one text, and count what both say."""
        self.texts += 1
        pairs = aligned_turns(reference, read)
        same = len(pairs) == len(reference.legs) == len(read.legs)
        self.parts["turns"].add(same, 1, 1)
        self.parts["turn"].add(len(pairs), len(reference.legs), len(read.legs))
        ends: list[tuple[Leg | Arrival, Leg | Arrival]] = [
            *((reference.legs[one], read.legs[two]) for one, two in pairs),
            (reference.arrival, read.arrival),
        ]
        ordinals = [(_ordinal(one), _ordinal(two)) for one, two in ends]
        self._add_values("ordinal", reference, read, _ordinal, ordinals, _is_equal)
        lengths = [(_metres(one), _metres(two)) for one, two in ends]
        self._add_values("length", reference, read, _metres, lengths, _is_about)
        for part, keys in (("landmark", _things), ("placed", _placed_things)):
            both = sum(_shared(keys(one), keys(two)) for one, two in ends)
            told = [
                sum(len(keys(each)) for each in (*plan.legs, plan.arrival))
                for plan in (reference, read)
            ]
            self.parts[part].add(both, *told)
        names = [names_of(plan.arrival) for plan in (reference, read)]
        self.parts["destination"].add(
            bool(names[0] & names[1]), bool(names[0]), bool(names[1])
        )

    def _add_values(
        self,
        part: str,
        reference: RoutePlan,
        read: RoutePlan,
        value: Callable[[Leg | Arrival], float | None],
        pairs: Iterable[tuple[float | None, float | None]],
        is_same: Callable[[float, float], bool],
    ) -> None:
        """Count what is told of legs by a number, where the turns correspond."""
        both = sum(
            one is not None and two is not None and is_same(one, two)
            for one, two in pairs
        )
        told = [
            sum(value(each) is not None for each in (*plan.legs, plan.arrival))
            for plan in (reference, read)
        ]
        self.parts[part].add(both, *told)


def _ordinal(part: Leg | Arrival) -> float | None:
    return part.turn.ordinal if isinstance(part, Leg) else part.nth


def _metres(part: Leg | Arrival) -> float | None:
    return None if part.length is None else part.length.metres


def _is_equal(one: float, two: float) -> bool:
    return one == two


def _is_about(one: float, two: float) -> bool:
    return abs(one - two) <= SAME_LENGTH * max(one, two)


def _things(part: Leg | Arrival) -> Counter[Hashable]:
    return Counter(each.phrase.casefold() for each in part.mentions)


def _placed_things(part: Leg | Arrival) -> Counter[Hashable]:
    return Counter((each.phrase.casefold(), each.place) for each in part.mentions)


def _shared(one: Counter[Hashable], two: Counter[Hashable]) -> int:
    return (one & two).total()


def names_of(arrival: Arrival) -> set[str]:
    """Return the names of the destination; of a sign or door what it says."""
    told = (place_on_sign(each) or each for each in arrival.destinations)
    return {each.removeprefix("door that says ").casefold() for each in told}


def recorded_plans(name: str) -> dict[str, RoutePlan]:
    """Return plans of a file of answers by the ids of instructions."""
    lines = (RECORDED / f"{name}.jsonl").read_text(encoding="utf-8").splitlines()
    answers = map(json.loads, lines)
    return {each["instruction_id"]: read_plan_reply(each["reply"]) for each in answers}


def scores(
    episodes: Sequence[Episode],
    reference: Mapping[str, RoutePlan],
    read: Callable[[Episode], RoutePlan | None],
) -> Iterator[tuple[str, str, Score]]:
    """Yield study, half and score, the half that was not read while developing first."""
    corpus = load_corpus()
    halves = {
        half: {each.id for each in corpus.of_split(half)}
        for half in ("held_out", "developed")
    }
    for half, ids in halves.items():
        for study in ("online", "onsite"):
            score = Score()
            for each in episodes:
                plan = read(each)
                if each.id in ids and each.instruction.study == study and plan:
                    score.add(reference[each.instruction.id], plan)
            yield study, half, score


def reading_table() -> Table:
    """Return how plans of each reader, and a second reading, agree with the model's."""
    episodes = load_corpus().episodes
    reference = recorded_plans("plans")
    second = recorded_plans("plans_second_reading")
    readers: dict[str, Callable[[Episode], RoutePlan | None]] = {
        **{
            name: lambda each, read=read: read(each.instruction.text)
            for name, read in READERS.items()
        },
        "second reading": lambda each: second.get(each.instruction.id),
    }
    rows = [
        {
            "reader": name,
            "half": half,
            "study": study,
            "texts": score.texts,
            **{part: found.f1 for part, found in score.parts.items()},
        }
        for name, read in readers.items()
        for study, half, score in scores(episodes, reference, read)
    ]
    return Table(
        "Readings of the shipped texts beside plans read by a large language model "
        "(recorded)",
        (
            Column("reader", "Reader", "group"),
            Column("half", "Half", "label"),
            Column("study", "Study", "label"),
            Column("texts", "n"),
            *(Column(name, heading, digits=2) for name, heading in PARTS.items()),
        ),
        tuple(rows),
        (
            "F1 of what both say, where the turns correspond (a longest common sequence); "
            "`every turn, in order`: the share of texts with equal turns. Things by "
            f"their exact words, lengths within {SAME_LENGTH:.0%}. The model is of the "
            "kind that wrote the texts: agreement flatters.",
        ),
        "reading",
    )


def legs_as_told(told: RoutePlan, read: RoutePlan) -> int:
    """Return how many legs are read with the turn, the count and the thing as told."""
    pairs = aligned_turns(told, read)
    return sum(_is_as_told(told.legs[one], read.legs[two]) for one, two in pairs)


def _is_as_told(told: Leg, read: Leg) -> bool:
    first = told.turn.ordinal in {None, 1} and read.turn.ordinal in {None, 1}
    named = {_plain_name(each.phrase) for each in read.mentions}
    cues = {_plain_name(m.phrase) for m in told.mentions if m.place == "turn"}
    return (first or told.turn.ordinal == read.turn.ordinal) and cues <= named


def _plain_name(phrase: str) -> str:
    """Return what a thing is told by: a room or a door by what is written on it."""
    words = phrase.casefold().removeprefix("door that says ").removeprefix("room ")
    return place_on_sign(words) or words


def made_table(
    floors: int,
    seed: int,
    folder: Path,
    kinds: Sequence[BuildingKind] = BUILDING_KINDS,
    reader: str = "grammar",
) -> Table:
    """Return how much of right made-up texts is read, by kind of building."""
    as_told = Counter[str]()
    scores = {name: Score() for name in (*kinds, "all")}
    made = made_floors(dict.fromkeys(kinds, floor_seeds(seed, floors)), folder)
    for kind, site in made:
        for cell in cells_of(site, iterations=(1,)):
            try:
                outlines = sample_outlines(cell, ErrorRates(failure=0.0), 1, seed)
            except SitePlanError:
                continue  # nothing plain can be said of this way
            for outline in outlines:
                told = outline.told_plan.said
                (text,) = write_texts(outline, paired=False)
                read = READERS[reader](text.text)
                for name in (kind, "all"):
                    scores[name].add(told, read)
                    as_told[name] += legs_as_told(told, read)
    rows = [
        {
            "kind": name,
            "texts": score.texts,
            "legs": as_told[name] / score.parts["turn"].reference,
            "turns": score.parts["turns"].both / score.texts,
            "named": score.parts["destination"].both / score.texts,
        }
        for name, score in scores.items()
    ]
    return Table(
        f"What right made-up texts say, as read by: {reader}",
        (
            Column("kind", "Building", role="label"),
            Column("texts", "n"),
            Column("legs", "Legs as told", digits=2),
            Column("turns", PARTS["turns"], digits=2),
            Column("named", PARTS["destination"], digits=2),
        ),
        tuple(rows),
        ("Texts and floors are made by a program.",),
        "made_texts_read",
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--made", type=int, metavar="K", help="floors of each kind")
    parser.add_argument("--seed", type=int, default=0, metavar="N")
    parser.add_argument(
        "--reader", choices=READERS, default="grammar", help="of --made"
    )
    options = parser.parse_args()
    if options.made is None:
        print(reading_table().text())
    else:
        with TemporaryDirectory() as folder:
            made = made_table(
                options.made, options.seed, Path(folder), reader=options.reader
            )
            print(made.text())
