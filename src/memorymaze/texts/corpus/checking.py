"""Everything that is wrong or looks odd in instruction files, all at once."""

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from memorymaze.basics.errors import InstructionFileError, did_you_mean
from memorymaze.texts.corpus.corpus import site_problems
from memorymaze.texts.corpus.error_kinds import ERROR_KINDS
from memorymaze.texts.corpus.files import (
    Findings,
    instruction_place,
    placed,
    read_instruction_file,
    repeated_ids,
)
from memorymaze.texts.corpus.record_format import InstructionProblem
from memorymaze.texts.corpus.records import Failure, Instruction
from memorymaze.texts.corpus.text_damage import invisible_characters, text_damage
from memorymaze.world.sites.records import Route, Site

FOREIGN_SHARE = 0.3
"""Share of letters outside the Latin script from which a text is hardly English."""
_NO_WORD = re.compile(r"[\W_]+")
_ENDS = frozenset(("start", "beginning", "end", "goal", "destination", "route", "way"))
"""Places that every route has."""
_ID = re.compile(r"[a-z]+\d*(?:_[a-z0-9]+)+")
_WORD = re.compile(r"\w+")


@dataclass(frozen=True, slots=True)
class CheckReport:
    """What a check of instruction files found."""

    good: int
    """Instructions with nothing wrong; there may be notes on them."""
    errors: tuple[InstructionProblem, ...]
    """What keeps instructions from being used, or makes results wrong."""
    notes: tuple[InstructionProblem, ...]
    """What someone should look at, and may well be meant."""


def check_instruction_files(
    paths: Sequence[str | Path], sites: Mapping[str, Site]
) -> CheckReport:
    """Check files, also against the sites they speak of; raises for missing ones alone.

    Errors: what is not of the format, sites and routes that do not exist, ids that
    repeat, an instruction that is there twice, and texts whose encoding was damaged.
    Notes: equal or nearly equal texts, ids that name another site or route, labels that
    sit ill with the plan, invisible characters, another script than the language's.
    """
    instructions: list[Instruction] = []
    problems: list[InstructionProblem] = []
    for path in paths:
        try:
            read, wrong = read_instruction_file(path)
        except InstructionFileError as error:
            if error.is_missing:
                raise
            place, _, message = str(error).partition(": ")
            problems.append(InstructionProblem(place, message))
        else:
            instructions += read
            problems += wrong
    unusable = placed(
        repeated_ids(instructions),
        site_problems(instructions, sites),
        _double_counts(instructions),
        _damaged(instructions),
    )
    notes = placed(
        _repeated_texts(instructions),
        _odd_ids(instructions, sites),
        _label_notes(instructions, sites),
        _odd_characters(instructions),
    )
    bad = {problem.place for problem in unusable}
    return CheckReport(
        good=sum(
            instruction_place(instruction) not in bad for instruction in instructions
        ),
        errors=tuple(problems + unusable),
        notes=tuple(notes),
    )


def _damaged(instructions: Sequence[Instruction]) -> Findings:
    for each in instructions:
        for field, text in _texts(each):
            for message in text_damage(text):
                yield each, f"field {field!r}: {message}"


def _texts(each: Instruction) -> list[tuple[str, str]]:
    texts = [("text", each.text), ("original_text", each.original_text or "")]
    for number, failure in enumerate(each.failures):
        texts.append((f"failures[{number}].where", failure.where))
        texts.append((f"failures[{number}].detail", failure.detail))
    return texts


def _odd_characters(instructions: Sequence[Instruction]) -> Findings:
    for each in instructions:
        hidden = invisible_characters(each.text)
        if hidden:
            yield each, f"field 'text': invisible characters ({', '.join(hidden)})"
        letters = [character for character in each.text if character.isalpha()]
        foreign = sum(ord(character) > 0x24F for character in letters)
        if each.language.startswith("en") and foreign > FOREIGN_SHARE * len(letters):
            yield (
                each,
                f"field 'language': {each.language!r}, but {foreign} of {len(letters)} "
                "letters are not Latin",
            )


def _normalised(text: str) -> str:
    """Return a text's letters and numbers, in small letters, single spaces between.

    >>> _normalised("Turn LEFT,  then \u2013 stop!")
    'turn left then stop'
    """
    plain = unicodedata.normalize("NFKC", text).casefold()
    return _NO_WORD.sub(" ", plain).strip()


def _double_counts(instructions: Iterable[Instruction]) -> Findings:
    """Yield instructions that another one repeats in everything but its id."""
    first: dict[tuple[object, ...], Instruction] = {}
    for each in instructions:
        earlier = first.setdefault((*_given(each), each.text), each)
        if earlier is not each and earlier.id != each.id:
            yield (
                each,
                f"expected a new instruction, got {each.id!r}, which is "
                f"{earlier.id!r} ({instruction_place(earlier)}) under another id; remove one",
            )


def _repeated_texts(instructions: Iterable[Instruction]) -> Findings:
    """Yield texts that stand elsewhere too, word for word or but for punctuation.

    Short texts of different people can be the same by chance; long ones hardly.
    """
    first: dict[str, Instruction] = {}
    cells: dict[tuple[object, ...], Instruction] = {}
    for each in instructions:
        earlier = first.setdefault(_normalised(each.text), each)
        counted_twice = _given(earlier) == _given(each) and earlier.text == each.text
        if earlier is not each and not counted_twice and not _paired(earlier, each):
            alike = (
                "the same text" if earlier.text == each.text else "nearly the same text"
            )
            place = instruction_place(earlier)
            yield each, f"{each.id!r} has {alike} as {earlier.id!r} ({place})"
        other = cells.setdefault(_given(each), each)
        if other.text != each.text and not _paired(other, each):
            yield (
                each,
                f"{each.id!r} and {other.id!r} ({instruction_place(other)}) are both of "
                f"participant {each.participant!r} for {each.site} {each.route}, "
                f"iteration {each.iteration}",
            )


def _paired(one: Instruction, other: Instruction) -> bool:
    """Tell whether a generator made one text from the other."""
    return one.pair is not None and one.pair == other.pair


def _given(each: Instruction) -> tuple[object, ...]:
    return each.study, each.participant, each.site, each.route, each.iteration


def _odd_ids(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> Findings:
    """Yield ids that name another site or route, or are hard to tell apart."""
    folded: dict[str, Instruction] = {}
    studies: dict[str, Instruction] = {}
    for each in instructions:
        for field, got in (("id", each.id), ("participant", each.participant)):
            if got != got.strip() or not got.isprintable():
                yield (
                    each,
                    f"field {field!r}: spaces at an end or control characters: {got!r}",
                )
            for what in _contradictions(each, got, sites):
                yield each, f"field {field!r}: {got!r} names {what}"
        alike = folded.setdefault(each.id.casefold(), each)
        if alike.id != each.id:
            yield (
                each,
                f"field 'id': {each.id!r} and {alike.id!r} differ in capitals only; "
                "some disks take their traces for the same file",
            )
        before = studies.setdefault(each.participant, each)
        if before.study != each.study:
            yield (
                each,
                f"field 'participant': {each.participant!r} is in study "
                f"{each.study!r} here and {before.study!r} at {instruction_place(before)}",
            )


def _contradictions(
    each: Instruction, name: str, sites: Mapping[str, Site]
) -> list[str]:
    """Say which other site or route an id names, part by part."""
    parts = re.split(r"[-./: ]", name.casefold())
    found: list[str] = []
    others = {site.casefold() for site in sites} - {each.site.casefold()}
    if each.site.casefold() not in parts:
        found += [
            f"site {part!r}, not {each.site!r}" for part in parts if part in others
        ]
    site = sites.get(each.site)
    routes = {route.route.casefold() for route in site.routes} if site else set[str]()
    if each.route.casefold() not in parts:
        found += [
            f"route {part!r}, not {each.route!r}" for part in parts if part in routes
        ]
    return found


class _PlaceNames:
    """All by which a place of a building can be named."""

    def __init__(self, site: Site) -> None:
        """Read them from the plan."""
        self.site = site
        places = (*site.corridors, *site.areas, *site.turning_points, *site.rooms)
        self.ids = frozenset(
            part.id for part in (*places, *site.doors, *site.landmarks)
        )
        said = [place.name for place in places]
        said += [place.shape for place in site.turning_points]
        said += [door.label for door in site.doors]
        for thing in site.landmarks:
            said += [thing.name, thing.category, thing.text]
        names = {_words(words.replace("_", " ")) for words in said if words}
        self.names = frozenset(name for name in names if name)

    def has(self, where: str) -> bool:
        """Tell whether some words name a place of the building, or an end of a route.

        An id counts, and a name, category, label, inscription or shape of the plan when
        all of its words are there, with or without the s of a plural.
        """
        if self.ids.intersection(_WORD.findall(where)):
            return True
        said = _words(where)
        return bool(said & _ENDS) or any(name <= said for name in self.names)


def _words(text: str) -> frozenset[str]:
    words = _WORD.findall(text.casefold())
    return frozenset(word.removesuffix("s") or word for word in words)


def _label_notes(
    instructions: Iterable[Instruction], sites: Mapping[str, Site]
) -> Findings:
    """Yield labels that contradict the site or what the study was like."""
    names = {name: _PlaceNames(site) for name, site in sites.items()}
    for each in instructions:
        routes = sites[each.site].routes if each.site in sites else ()
        for route in routes:
            if route.id == each.reference_route:
                for message in _notes(each, names[each.site], route):
                    yield each, message


def _notes(each: Instruction, names: _PlaceNames, route: Route) -> Iterator[str]:
    if each.study == "online" and route.role == "alternative":
        yield (
            f"field 'reference_route': {route.id!r} is an alternative way, but online "
            "everyone saw a walk along the reference route"
        )
    known = [kind.name for kind in ERROR_KINDS]
    for number, failure in enumerate(each.failures):
        field = f"field 'failures[{number}]"
        if failure.kind not in known:
            hint = did_you_mean(failure.kind, known) or f": {', '.join(known)}"
            yield f"{field}.kind': {failure.kind!r} is none of the paper's kinds{hint}"
        if failure in each.failures[:number]:
            yield f"{field}': the same failure stands there twice"
        where = _where_note(failure, names, route)
        if where is not None:
            yield f"{field}.where': {where}"


def _where_note(failure: Failure, names: _PlaceNames, route: Route) -> str | None:
    site = names.site
    where = failure.where.strip()
    if not where:
        return "empty; name a turning point's id or a place of the plan"
    if _ID.fullmatch(where):
        points = {point.id: point for point in site.turning_points}
        if where in points:
            if points[where].polygon.distance(route.line) > 0:
                return f"turning point {where!r} is not on {route.id}"
            return None
        if where in names.ids:
            return None
        return (
            f"{where!r} is not in the plan of {site.name}{did_you_mean(where, points)}"
        )
    if not names.has(where):
        return f"{where!r} names no turning point, place or thing of {site.name}"
    return None
