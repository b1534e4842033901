from typing import Any

import pytest

from memorymaze.basics.errors import RunFolderError
from memorymaze.robot.api.control import Detection, MoveResult, TurnResult
from memorymaze.runs.episodes.trace_entries import (
    CallEntry,
    CollisionEntry,
    NoteEntry,
    TrajectoryEntry,
)
from memorymaze.runs.story.story import story_of
from memorymaze.runs.story.understanding import understood


def call(time: float, name: str, arguments: dict[str, Any], result: Any) -> CallEntry:
    return CallEntry(time, (0.0, 0.0, 0.0), name, arguments, result)


def note(about: str, **told: Any) -> NoteEntry:
    return NoteEntry(0.0, about, told)


def walk(*poses: tuple[float, float, float, float]) -> TrajectoryEntry:
    return TrajectoryEntry(COLUMNS, list(poses))


COLUMNS = ("time", "x", "y", "heading")
DOOR = Detection("door", (0.0, 0.0, 9.0, 9.0), 1.0, 2.0, 90.0, 1)


def test_questions_at_one_moment_are_told_in_one_line_each_for_looks_and_others() -> (
    None
):
    story = story_of(
        [
            call(1.0, "detect_from_RGB_image", {"object": "door"}, [DOOR]),
            call(1.0, "turning_point_id", {}, 4),
            call(1.0, "detect_from_RGB_image", {"object": "lift"}, []),
            call(2.0, "detect_from_RGB_image", {"object": "lift"}, []),
            walk((0, 0, 0, 0)),
        ],
        "trace",
    )
    assert [event.text for event in story.events] == [
        "saw door 2.0 m 90° left (looked for door, lift)",
        "turning_point_id() → 4",
        "saw nothing (looked for lift)",
    ]
    [(x, y, label)] = story.events[0].seen
    assert (round(x, 6), round(y, 6), label) == (0.0, 2.0, "door")


def test_calls_are_told_with_what_they_returned() -> None:
    story = story_of(
        [
            call(1.0, "move_forward", {"distance": 1.0}, MoveResult(0.5, "wall")),
            call(2.0, "turn", {"direction": "left"}, TurnResult(True, 90.0, "turned")),
            CollisionEntry(3.0, (0.0, 0.0, 0.0), "wall", "w1"),
            walk((0, 0, 0, 0)),
        ],
        "trace",
    )
    assert [event.text for event in story.events] == [
        "move_forward(1.00) → 0.50 m, wall",
        "turn(left) → turned",
        "touched a wall (w1)",
    ]


def test_what_an_agent_writes_cannot_steer_a_terminal() -> None:
    steering = "\x1b[2J\x07hello\x00"
    story = story_of(
        [
            note("plan", steps=[steering]),
            note("said", text=steering),
            walk((0, 0, 0, 0)),
        ],
        "trace",
    )
    shown = story.events[0].text + story.understanding.steps[0]
    assert "hello" in shown
    assert all(letter.isprintable() for letter in shown)


def test_long_texts_are_cut_and_say_so() -> None:
    story = story_of([note("said", text="x" * 5000), walk((0, 0, 0, 0))], "trace")
    assert len(story.events[0].text) < 700
    assert "5006 characters; the trace has them all" in story.events[0].text


def test_a_trace_without_a_trajectory_is_refused() -> None:
    with pytest.raises(RunFolderError, match=r"^trace: expected a trajectory"):
        story_of([note("plan", steps=["go"])], "trace")


def test_a_step_is_worked_on_from_the_note_that_those_before_are_done() -> None:
    found = understood([
        note("plan", steps=["1. turn left", "2. turn right", "3. stop"]),
        note("decision", legs_done=1),
        note("decision", legs_done=99),
        note("arrival", reason="seen"),
    ])
    assert found.steps == ("turn left", "turn right", "stop")
    assert found.marks == {0: (0,), 1: (1,), 2: (2,), 3: (2,)}


def test_lines_of_a_program_are_those_that_may_make_the_call() -> None:
    program = "for way in ['left']:\n    turn(way)\nturn('right')\nmove_forward(2)\n"
    found = understood([
        note("program", program=program),
        call(0.0, "turn", {"direction": "left"}, None),
        call(0.0, "turn", {"direction": "right"}, None),
        call(0.0, "move_forward", {"distance": 2.0}, None),
        call(0.0, "stop", {}, None),
    ])
    assert found.marks == {1: (1,), 2: (1, 2), 3: (3,), 4: ()}


def test_a_program_that_is_none_is_shown_without_marks() -> None:
    found = understood([
        note("program", program="turn('left'\n"),
        call(0.0, "turn", {"direction": "left"}, None),
    ])
    assert found.programs == (("turn('left'",),)
    assert found.marks == {1: ()}


def test_lines_are_counted_through_all_programs() -> None:
    found = understood([
        note("program", program="stop()\nstop()"),
        note("program", program="turn('left')"),
        call(0.0, "turn", {"direction": "left"}, None),
    ])
    assert found.marks == {2: (2,)}
