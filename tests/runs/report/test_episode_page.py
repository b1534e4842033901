import json

from memorymaze.runs.episodes.trace_entries import NoteEntry, TrajectoryEntry
from memorymaze.runs.report.episode_page import story_record
from memorymaze.runs.story.story import story_of


def walk(*poses: tuple[float, float, float, float]) -> TrajectoryEntry:
    return TrajectoryEntry(("time", "x", "y", "heading"), list(poses))


def test_poses_on_a_straight_way_are_left_out_and_corners_kept() -> None:
    east = [(step / 5, step / 5, 0.0, 0.0) for step in range(20)]
    north = [(4 + step / 5, 3.8, step / 5, 1.57) for step in range(20)]
    record = json.loads(
        story_record(story_of([walk(*east, *north)], "trace")).replace("\\u003c", "<")
    )
    kept = [
        tuple(record["poses"][i : i + 4]) for i in range(0, len(record["poses"]), 4)
    ]
    assert kept[0][:3] == (0, 0, 0)
    assert kept[-1][:3] == (7.8, 3.8, 3.8)
    assert any(abs(x - 3.8) < 0.01 and y == 0 for _, x, y, _ in kept)
    assert len(kept) < 8


def test_a_record_holds_no_character_that_could_end_a_script() -> None:
    text = "</script>\u2028&\ud800<!--"
    said = NoteEntry(0.0, "said", {"text": text})
    story = story_of([said, walk((0, 0, 0, 0))], "trace")
    record = story_record(story)
    assert record.isascii()
    assert not set("<>&") & set(record)
    assert json.loads(record)["words"] == ["said: </script>\u2028&\ud800<!--"]
