import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from memorymaze.errors import RunFolderError
from memorymaze.results.story import RecordedEpisode
from memorymaze.results.story.events import Event, news
from memorymaze.results.story.moments import Moments
from memorymaze.results.story.story import story_of
from memorymaze.results.story.understanding import step_of, understood

WALK = {
    "kind": "trajectory",
    "poses": [[0, 0, 0, 3.0], [2, 2, 0, 3.0], [4, 2, 0, -3.0]],
}


def moments_of(*entries: Mapping[str, Any]) -> Moments:
    everything = [{"kind": "episode", "instruction": "Go."}, *entries, WALK]
    return Moments(story_of(everything, "here"))


def test_between_two_poses_the_robot_is_between_them() -> None:
    moment = moments_of().at(1.0)
    assert moment.pose == pytest.approx((1.0, 0.0, 3.0))


def test_headings_turn_the_short_way_round() -> None:
    moment = moments_of().at(3.0)
    assert abs(moment.pose.heading) == pytest.approx(math.pi)


def test_nothing_is_told_before_it_happens() -> None:
    said = {
        "kind": "call",
        "time": 1.5,
        "pose": [1.5, 0, 0],
        "call": "say",
        "arguments": {"text": "Hello"},
        "result": None,
    }
    moments = moments_of(said)
    assert not moments.at(1.4).events
    assert [each.kind for each in moments.at(1.5).events] == ["say"]


def test_a_person_is_where_the_trace_says_and_faces_the_way_walked() -> None:
    people = {
        "kind": "people",
        "walks": {"person_1": [[0, 5, 0], [1, 5, 1], [9, 5, 1]]},
    }
    moments = moments_of(people)
    walking, standing = (moments.at(time).people["person_1"] for time in (0.5, 4.0))
    assert walking == pytest.approx((5, 0.5, math.pi / 2))
    assert standing == pytest.approx((5, 1, math.pi / 2))


def test_every_sighting_lies_where_distance_and_bearing_say() -> None:
    found = {"label": "bench", "box": [0, 0, 9, 9], "distance": 2.0, "bearing_deg": 90}
    look = {
        "kind": "call",
        "time": 1,
        "pose": [1, 0, 0],
        "call": "detect_from_RGB_image",
        "arguments": {"object": "bench"},
        "result": [found],
    }
    [sighting] = moments_of(look).sightings
    assert (sighting.x, sighting.y) == pytest.approx((1, 2))


def test_a_detection_that_no_episode_leaves_is_refused() -> None:
    look = {
        "kind": "call",
        "time": 1,
        "pose": [1, 0, 0],
        "call": "detect_from_RGB_image",
        "arguments": {"object": "bench"},
        "result": [{"label": "bench", "distance": 2.0, "bearing_deg": 90}],
    }
    with pytest.raises(RunFolderError, match="expected detections"):
        moments_of(look)


def test_answers_that_stay_the_same_are_told_once() -> None:
    def ask(time: float, text: str) -> Event:
        return Event(time, "ask", text, 0)

    told = news([ask(1, "1"), ask(2, "1"), ask(3, "2"), ask(4, "1")])
    assert [event.time for event in told] == [1, 3, 4]


def test_the_step_at_work_is_the_one_that_notes_name() -> None:
    entries = [
        {"kind": "note", "time": 0, "about": "plan", "steps": ["go", "turn", "stop"]},
        {"kind": "note", "time": 1, "about": "decision", "legs_done": 1},
    ]
    step = step_of(understood(entries), 1, [])
    assert (step.heading, step.lines) == ("Step 2 of 3", ("turn",))


def test_of_a_program_the_line_that_makes_the_call_is_shown() -> None:
    program = "a = 1\nmove_forward(2)\nturn('left')\nb = 2\nc = 3"
    call = {"kind": "call", "call": "turn", "arguments": {"direction": "left"}}
    entries = [{"kind": "note", "about": "program", "program": program}, call]
    step = step_of(understood(entries), 1, [])
    assert step.heading == "Program, line 3"
    assert step.lines[step.current or 0] == "turn('left')"


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
