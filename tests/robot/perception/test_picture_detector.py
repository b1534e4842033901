"""From boxes in a picture to detections with distance, direction and track."""

import math
from collections.abc import Callable

import pytest

from memorymaze.basics.errors import CommandError
from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.perception.picture_detector import FoundBox, PictureDetector


class Finder:
    """Finds what it is told to."""

    def __init__(self, *found: FoundBox) -> None:
        self.found = found
        self.asked: list[tuple[tuple[int, ...], str]] = []

    def find(self, rgb, query: str):
        self.asked.append((rgb.shape, query))
        return self.found


def found(*box: float, label: str = "door", score: float = 0.8) -> FoundBox:
    return FoundBox(box, label, score)


def test_distance_comes_from_the_depth_picture_and_direction_from_the_box(wall):
    view = wall(((400, 200, 480, 280), 2.0))
    finder = Finder(found(400, 200, 480, 280))

    [door] = PictureDetector(finder).detect(view, "door")

    assert finder.asked == [((480, 640, 3), "door")]
    assert door.distance == pytest.approx(2 * math.hypot(1, 120 / 320))
    assert door.bearing_deg == pytest.approx(-math.degrees(math.atan2(120, 320)))
    assert (door.label, door.box, door.score) == ("door", (400, 200, 480, 280), 0.8)


def test_the_median_takes_no_notice_of_what_shows_through_a_chair(wall):
    view = wall(((300, 200, 340, 264), 1.5))  # the wall shows in a fifth of the box

    [chair] = PictureDetector(Finder(found(300, 200, 340, 280))).detect(view, "chair")

    assert chair.distance == pytest.approx(1.5, rel=0.01)


def test_what_is_beyond_four_metres_or_in_the_sky_is_dropped(wall):
    view = wall(((0, 0, 100, 100), 4.2), ((300, 200, 340, 280), math.inf))
    finder = Finder(found(0, 0, 100, 100), found(300, 200, 340, 280))

    assert PictureDetector(finder).detect(view, "door") == []


def test_the_nearest_comes_first(wall):
    view = wall(((300, 200, 340, 280), 1.0))
    finder = Finder(found(310, 0, 330, 40, score=0.9), found(300, 200, 340, 280))

    near, far = PictureDetector(finder).detect(view, "door")

    assert near.distance < far.distance


def test_of_two_boxes_round_one_thing_the_better_is_kept(wall):
    finder = Finder(
        found(300, 200, 340, 280, score=0.4),
        found(301, 201, 340, 281, score=0.6, label="red door"),
        found(400, 200, 440, 280, score=0.4),
    )

    labels = [each.label for each in PictureDetector(finder).detect(wall(), "door")]

    assert sorted(labels) == ["door", "red door"]


def test_boxes_are_cut_at_the_pictures_edge(wall):
    finder = Finder(found(-50, -20, 60, 500), found(700, 0, 800, 100))

    [cut] = PictureDetector(finder).detect(wall(((0, 0, 60, 480), 2.0)), "door")

    assert cut.box == (0, 0, 60, 480)


def test_a_thing_seen_again_from_elsewhere_keeps_its_number(wall):
    finder = Finder(found(300, 200, 340, 280))
    detector = PictureDetector(finder)
    box = (300, 200, 340, 280)
    [first] = detector.detect(wall((box, 3.0)), "door")
    nearer = wall((box, 2.0), pose=Pose(1.0, 0, 0))
    finder.found = (found(*box, label="red door"),)

    [again] = detector.detect(nearer, "red door")
    [other] = detector.detect(wall((box, 3.0), pose=Pose(0, 5, 0)), "door")

    assert again.track_id == first.track_id != other.track_id


def test_an_endless_query_is_refused_before_anything_is_drawn(
    wall: Callable[..., object],
):
    view = wall()

    with pytest.raises(CommandError, match="300 characters, got 301"):
        PictureDetector(Finder()).detect(view, "x" * 301)
    assert view.drawn == 0
