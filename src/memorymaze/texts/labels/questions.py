"""What annotators are asked, the ways they choose among, and checking their answers."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from memorymaze.basics.errors import did_you_mean
from memorymaze.texts.corpus.records import Failure, Instruction
from memorymaze.texts.labels.labels import LABEL_KINDS, NO_WAY, Label, text_stamp
from memorymaze.world.sites.records import Route, Site, TurningPoint

BEYOND = 0.5
"""Metres after a turning point at which one is in the hallway turned into."""
YES, NO = ("yes", "y", "1", "true"), ("no", "n", "0", "false")


@dataclass(frozen=True)
class LabelQuestion:
    """An instruction that waits for a label."""

    instruction: Instruction
    site: Site

    @property
    def ways(self) -> list[str]:
        """Ids of the ways that it can describe, the reference first."""
        return [way.id for way in self.site.ways(self.instruction.route)]

    def label(self, annotator: str, way: str, failures: Sequence[Failure]) -> Label:
        """Return the answer as a label."""
        told = self.instruction
        stamp = text_stamp(told.text)
        return Label(told.id, stamp, annotator, way, tuple(failures))


def questions(
    instructions: Sequence[Instruction],
    sites: Mapping[str, Site],
    done: Collection[str] = (),
) -> list[LabelQuestion]:
    """Return the instructions without a label, in their order."""
    return [
        LabelQuestion(each, sites[each.site])
        for each in instructions
        if each.id not in done
    ]


def read_yes_or_no(answer: str) -> bool:
    """Return whether an answer is yes."""
    said = answer.strip().casefold()
    if said in YES:
        return True
    if said in NO:
        return False
    raise ValueError(f"expected yes or no, got {answer!r}")


def read_way(answer: str, ways: Sequence[str]) -> str:
    """Return the way of an answer: its id, its number from 1, or 0 or `none`."""
    return _choice(answer, (NO_WAY, *ways), "a way")


def read_kind(answer: str) -> str:
    """Return the kind of failure of an answer: its name, or its number from 0."""
    return _choice(answer.replace(" ", "_"), tuple(LABEL_KINDS), "a kind of failure")


def _choice(answer: str, choices: Sequence[str], what: str) -> str:
    said = answer.strip().strip("_").casefold()
    if said.isdecimal() and int(said) < len(choices):
        return choices[int(said)]
    for choice in choices:
        if said == choice.casefold():
            return choice
    raise ValueError(
        f"expected {what} (0 to {len(choices) - 1}, or {', '.join(choices)}), got "
        f"{answer!r}{did_you_mean(said, choices)}"
    )


def way_in_words(site: Site, way: Route) -> str:
    """Return a way's length, turns and goal in a line."""
    points = {point.id: point for point in site.turning_points}
    turns: list[str] = []
    for turn in way.turns:
        into = _name_beyond(site, way, points[turn.at])
        words = turn.direction.replace("_", " ") + (f" into {into}" if into else "")
        turns.append(f"{words} ({turn.at})")
    walk = ", ".join(turns) or "no turn"
    return f"{way.role}, {way.length:.0f} m: {walk}; to {way.goal}"


def _name_beyond(site: Site, way: Route, point: TurningPoint) -> str | None:
    """Return the name of where a way goes on after a turning point."""
    crossing = way.line.project(point.polygon.centroid)
    reach = point.polygon.length / 4 + BEYOND
    beyond = way.line.interpolate(min(crossing + reach, way.line.length))
    for place in (*site.corridors, *site.areas):
        if place.name and place.polygon.covers(beyond):
            return place.name
    return None
