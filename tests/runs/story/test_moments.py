import math

import numpy as np
import pytest

from memorymaze.robot.api.control import Detection
from memorymaze.runs.episodes.trace_entries import (
    CallEntry,
    NoteEntry,
    PeopleEntry,
    TraceEntry,
    TrajectoryEntry,
)
from memorymaze.runs.story import RecordedEpisode
from memorymaze.runs.story.events import Event, news
from memorymaze.runs.story.moments import Moments
from memorymaze.runs.story.story import story_of
from memorymaze.runs.story.understanding import step_of, understood

WALK = TrajectoryEntry(
    ("time", "x", "y", "heading"), [(0, 0, 0, 3.0), (2, 2, 0, 3.0), (4, 2, 0, -3.0)]
)


def moments_of(*entries: TraceEntry) -> Moments:
    return Moments(story_of([*entries, WALK], "here"))


def test_between_two_poses_the_robot_is_between_them() -> None:
    moment = moments_of().at(1.0)
    assert moment.pose == pytest.approx((1.0, 0.0, 3.0))


def test_headings_turn_the_short_way_round() -> None:
    moment = moments_of().at(3.0)
    assert abs(moment.pose.heading) == pytest.approx(math.pi)


def test_nothing_is_told_before_it_happens() -> None:
    said = CallEntry(1.5, (1.5, 0, 0), "say", {"text": "Hello"}, None)
    moments = moments_of(said)
    assert not moments.at(1.4).events
    assert [each.kind for each in moments.at(1.5).events] == ["say"]


def test_a_person_is_where_the_trace_says_and_faces_the_way_walked() -> None:
    walk = [(0, 5, 0), (1, 5, 1), (9, 5, 1)]
    people = PeopleEntry(("time", "x", "y"), {"person_1": walk})
    moments = moments_of(people)
    walking, standing = (moments.at(time).people["person_1"] for time in (0.5, 4.0))
    assert walking == pytest.approx((5, 0.5, math.pi / 2))
    assert standing == pytest.approx((5, 1, math.pi / 2))


def test_every_sighting_lies_where_distance_and_bearing_say() -> None:
    found = Detection("bench", (0, 0, 9, 9), 1.0, 2.0, 90, 1)
    name = "detect_from_RGB_image"
    look = CallEntry(1, (1, 0, 0), name, {"object": "bench"}, [found])
    [sighting] = moments_of(look).sightings
    assert (sighting.x, sighting.y) == pytest.approx((1, 2))


def test_answers_that_stay_the_same_are_told_once() -> None:
    def ask(time: float, text: str) -> Event:
        return Event(time, "ask", text, 0)

    told = news([ask(1, "1"), ask(2, "1"), ask(3, "2"), ask(4, "1")])
    assert [event.time for event in told] == [1, 3, 4]


def test_the_step_at_work_is_the_one_that_notes_name() -> None:
    entries = [
        NoteEntry(0, "plan", {"steps": ["go", "turn", "stop"]}),
        NoteEntry(1, "decision", {"legs_done": 1}),
    ]
    step = step_of(understood(entries), 1, [])
    assert (step.heading, step.lines) == ("Step 2 of 3", ("turn",))


def test_of_a_program_the_line_that_makes_the_call_is_shown() -> None:
    program = "a = 1\nmove_forward(2)\nturn('left')\nb = 2\nc = 3"
    call = CallEntry(1, (0, 0, 0), "turn", {"direction": "left"}, None)
    entries = [NoteEntry(0, "program", {"program": program}), call]
    step = step_of(understood(entries), 1, [])
    assert step.heading == "Program, line 3"
    assert step.lines[step.current or 0] == "turn('left')"


def test_the_line_of_a_program_is_that_of_the_call_that_goes_on() -> None:
    program = "move_forward(2)\nturn('left')\nstop()"
    moments = moments_of(
        NoteEntry(0, "program", {"program": program}),
        # A call stands in the trace at the time at which it ended.
        CallEntry(2, (2, 0, 3.0), "move_forward", {"distance": 2}, None),
        CallEntry(4, (2, 0, -3.0), "turn", {"direction": "left"}, None),
    )
    at_work = [moments.at(time).step for time in (1.0, 3.0)]
    assert [step.lines[step.current or 0] for step in at_work] == [
        "move_forward(2)",
        "turn('left')",
    ]


def test_agents_without_plan_show_their_latest_thought() -> None:
    events = [
        Event(1, "note", "thought: left looks right", 0),
        Event(2, "move", "m", 1),
    ]
    assert step_of(understood([]), 1, events).lines == ("thought: left looks right",)


def test_the_walk_ends_where_the_trace_ends(crowded_episode: RecordedEpisode) -> None:
    moments = Moments(crowded_episode.story)
    last = moments.at(moments.duration)
    np.testing.assert_allclose(last.pose[:2], moments.points[-1])
    assert last.walked == len(moments.points)
    assert moments.things
    assert last.people
