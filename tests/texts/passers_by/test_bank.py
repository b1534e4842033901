"""What passers-by say, by the bank."""

import json
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from memorymaze.basics.errors import AnswerFileError, SettingsError
from memorymaze.texts.passers_by.bank import DATA_FOLDER, load_bank
from memorymaze.texts.passers_by.bank_records import (
    MANY_TURNS,
    OPPOSITES,
    REPLY_CASES,
    SLOT,
    WAY_CASES,
    BankAnswer,
    TurnFact,
    WayFacts,
)

BANK = load_bank()
TOLD = {"destination": "room 2347", "thing": "the bin", "place": "the library"}
PERHAPS = {"metres": "14", "near": "the lifts", "where": "left"}

turns = st.builds(
    TurnFact,
    side=st.sampled_from(sorted(OPPOSITES)),
    cue=st.sampled_from(["next", "ordinal", "end", "thing", "crossing"]),
    ordinal=st.integers(1, 30),
    thing=st.just("the drinks machine"),
    metres=st.floats(0, 500),
)
ways = st.builds(
    WayFacts,
    start=st.sampled_from(["ahead", "left", "right", "back"]),
    turns=st.lists(turns, max_size=7).map(tuple),
    end=st.sampled_from(["ahead", "left", "right", "end"]),
    destination=st.just("the library"),
    metres=st.floats(0, 500),
)


def way(*sides: str) -> WayFacts:
    told = (TurnFact(side, "thing", 1, "the bin", 12) for side in sides)
    return WayFacts("ahead", tuple(told), "end", "room 2347", 20)


def sides_in(text: str) -> list[str]:
    return re.findall(r"\b(left|right)\b", text.lower())


def is_told_in_order(told: Sequence[str], said: Sequence[str]) -> bool:
    rest = iter(said)
    return all(side in rest for side in told)


def slots_for(kind: str, case: str) -> dict[str, str]:
    allowed = REPLY_CASES[kind, case]
    return {slot: text for slot, text in (TOLD | PERHAPS).items() if slot in allowed}


@given(ways, st.integers(0, 2**32), st.sampled_from((None, *BANK.manners)))
def test_every_way_is_said_without_a_slot_left(
    facts: WayFacts, seed: int, manner: str | None
) -> None:
    said = BANK.way(facts, np.random.default_rng(seed), manner)
    assert "{" not in said
    assert "}" not in said
    assert said[0] == said[0].upper()


@given(ways, st.integers(0, 2**32))
def test_the_same_generator_gives_the_same_words(facts: WayFacts, seed: int) -> None:
    said = [BANK.way(facts, np.random.default_rng(seed)) for _ in range(2)]
    assert said[0] == said[1]


@pytest.mark.parametrize(("kind", "case"), REPLY_CASES)
def test_every_reply_is_said_in_every_manner(kind: str, case: str) -> None:
    rng = np.random.default_rng(5)
    slots = slots_for(kind, case)
    fewest = {slot: text for slot, text in slots.items() if slot in TOLD}
    for manner in BANK.manners:
        for given_slots in (slots, fewest):
            said = BANK.reply(kind, case, given_slots, rng, manner)  # pyright: ignore[reportArgumentType]
            assert said
            assert "{" not in said


def corrects_itself(answer: BankAnswer) -> bool:
    """Tell whether the wrong side of a turn is said before the one that is meant."""
    return any(slot.startswith("wrong") for slot in answer.slots)


@pytest.mark.parametrize(
    "answer",
    [a for a in BANK.answers if a.case in WAY_CASES and not corrects_itself(a)],
    ids=lambda answer: answer.id,
)
def test_the_turns_of_an_answer_are_said_in_order(answer: BankAnswer) -> None:
    numbers = [
        int(number)
        for name, number in SLOT.findall(answer.text)
        if name in {"side", "bend", "turn"}
    ]
    assert numbers == sorted(numbers)
    assert set(numbers) == set(range(1, answer.turns_told + 1))


@given(ways, st.integers(0, 2**32))
def test_the_sides_of_a_way_of_few_turns_are_said_in_order(
    facts: WayFacts, seed: int
) -> None:
    few = facts.turns[: MANY_TURNS - 1]
    facts = WayFacts(facts.start, few, facts.end, facts.destination, facts.metres)
    said = BANK.way(facts, np.random.default_rng(seed))
    sides = [turn.side.removeprefix("half ") for turn in few]
    assert is_told_in_order(sides, sides_in(said))


def test_a_way_of_many_turns_is_told_whole_or_sends_one_to_ask_again() -> None:
    rng = np.random.default_rng(2)
    facts = way("left", "right", "left", "right", "right", "left")
    said = [sides_in(BANK.way(facts, rng)) for _ in range(200)]
    whole = [s for s in said if is_told_in_order([t.side for t in facts.turns], s)]
    assert 0 < len(whole) < len(said)


def test_a_length_is_said_rounded() -> None:
    rng = np.random.default_rng(3)
    words = " ".join(
        BANK.reply(
            "where_is", "far", {"thing": "it", "metres": "41", "near": "it"}, rng
        )
        for _ in range(200)
    )
    assert "forty metres" in words


@pytest.mark.parametrize(
    ("kind", "case", "slots", "problem"),
    [
        pytest.param("where_is", "above", {}, "expected a case of", id="case"),
        pytest.param("where_is", "left", {}, "expected the slots", id="missing"),
        pytest.param(
            "is_this", "yes", {"place": "it", "thing": "it"}, "got", id="unknown slot"
        ),
        pytest.param(
            "is_this", "not_yet", {"place": "it", "where": "up"}, "where", id="where"
        ),
    ],
)
def test_a_reply_that_the_bank_cannot_say_is_refused(
    kind: str, case: str, slots: dict[str, str], problem: str
) -> None:
    with pytest.raises(SettingsError, match=problem):
        BANK.reply(kind, case, slots, np.random.default_rng(0))  # pyright: ignore[reportArgumentType]


def test_an_unknown_manner_is_refused() -> None:
    with pytest.raises(SettingsError, match="expected a manner of"):
        BANK.way(way("left"), np.random.default_rng(0), "pirate")


def changed_bank(folder: Path, name: str, line: int, **changes: object) -> Path:
    for file in DATA_FOLDER.iterdir():
        (folder / file.name).write_text(file.read_text("utf-8"), "utf-8")
    lines = (folder / name).read_text("utf-8").splitlines()
    record = json.loads(lines[line - 1]) | changes
    kept = {field: value for field, value in record.items() if value is not None}
    lines[line - 1] = json.dumps(kept)
    (folder / name).write_text("\n".join(lines), "utf-8")
    return folder


@pytest.mark.parametrize(
    ("name", "changes", "problem"),
    [
        pytest.param("answers", {"text": "Go."}, "expected the slot", id="no slots"),
        pytest.param(
            "answers",
            {"text": "{start} {where} {cheese}"},
            r"got \['cheese'\]",
            id="strange slot",
        ),
        pytest.param(
            "answers",
            {"kind": "where_is", "case": "above", "text": "Up."},
            "expected a case of",
            id="unknown case",
        ),
        pytest.param(
            "answers",
            {"case": "4+", "text": "{start}, {turn1}, {where}"},
            r"expected the slot \{rest\}",
            id="turns left out",
        ),
        pytest.param(
            "answers",
            {"case": "1", "text": "{start}, {turn1}, {turn2}, {where}"},
            r"got \['turn2'\]",
            id="too many turns",
        ),
        pytest.param("answers", {"source": "human"}, "source", id="source"),
        pytest.param("answers", {"id": None}, "id", id="no id"),
        pytest.param("answers", {"tone": "kind"}, "tone", id="unknown field"),
        pytest.param("words", {"slot": "cheese"}, "expected a case", id="slot"),
        pytest.param("words", {"manners": ["pirate"]}, "pirate", id="manner"),
        pytest.param("words", {"text": "{side}"}, "expected slots", id="slot of words"),
    ],
)
def test_a_wrong_line_is_refused_with_its_place(
    tmp_path: Path, name: str, changes: dict[str, object], problem: str
) -> None:
    folder = changed_bank(tmp_path, f"{name}.jsonl", 1, **changes)
    with pytest.raises(AnswerFileError, match=rf"{name}\.jsonl:1: .*{problem}"):
        load_bank(folder)


def test_a_voice_without_an_answer_to_a_case_is_refused(tmp_path: Path) -> None:
    changed_bank(tmp_path, "answers.jsonl", 1, manner="pirate")
    with pytest.raises(AnswerFileError, match="of the manner pirate"):
        load_bank(tmp_path)


def test_an_id_that_comes_twice_is_refused(tmp_path: Path) -> None:
    first = BANK.answers[0].id
    changed_bank(tmp_path, "answers.jsonl", 2, id=first)
    with pytest.raises(AnswerFileError, match=r"answers\.jsonl:2: .* once more"):
        load_bank(tmp_path)


def test_a_slot_without_a_phrase_for_all_is_refused(tmp_path: Path) -> None:
    changed_bank(tmp_path, "words.jsonl", 1)
    words = (tmp_path / "words.jsonl").read_text("utf-8").splitlines()
    kept = [line for line in words if json.loads(line)["slot"] != "rest"]
    (tmp_path / "words.jsonl").write_text("\n".join(kept), "utf-8")
    with pytest.raises(AnswerFileError, match="a phrase for rest turn"):
        load_bank(tmp_path)


def test_every_case_has_many_answers() -> None:
    answers = Counter((answer.kind, answer.case) for answer in BANK.answers)
    assert min(answers["way_to", case] for case in WAY_CASES) >= 45
    assert min(answers[case] for case in REPLY_CASES) >= 15
    assert answers["way_to", "unknown"] >= 25


def test_an_answer_has_3_to_60_words() -> None:
    lengths = [len(answer.text.split()) for answer in BANK.answers]
    assert min(lengths) >= 3
    assert max(lengths) <= 60


@pytest.mark.parametrize(
    ("case", "other"), [("left", "right"), ("right", "left")], ids=["left", "right"]
)
def test_a_thing_at_one_side_is_never_said_to_be_at_the_other(
    case: str, other: str
) -> None:
    texts = [a.text.lower() for a in BANK.answers if a.case == case]
    assert texts
    assert not [text for text in texts if case not in text or other in text]


def test_a_capital_opens_sentences_only() -> None:
    rng = np.random.default_rng(4)
    said = [BANK.way(way("left", "right"), rng) for _ in range(300)]
    lengths = r"(?:Two|Five|Ten|Twelve|Fifteen|Twenty|Thirty|About|Maybe|Some) "
    assert not [text for text in said if re.search(rf"[a-z,] {lengths}", text)]
    assert not [text for text in said if re.search(r"[.!?] [a-z]", text)]
