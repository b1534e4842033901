"""Which texts in view can be read, and reading them from pictures."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from PIL import Image, ImageDraw, ImageFont

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.steps import CameraPicture
from memorymaze.robot.perception.camera_view import (
    ObjectDescription,
    VisibleObject,
    VisibleText,
)
from memorymaze.robot.perception.sign_reading import (
    FoundLine,
    PictureSignReader,
    TextRecognizer,
    TruthSignReader,
)

SIGN = VisibleText(
    text="Library",
    bearer=VisibleObject(
        description=ObjectDescription("sign", text="Library"),
        position=(3.0, 0.0),
        length=0.8,
        box=(300.0, 200.0, 340.0, 220.0),
        distance=3.0,
        bearing=math.radians(10),
        visible_fraction=1.0,
    ),
    facing=0.0,
    letter_height=12.0,
)
FONT = Path(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans-Bold.ttf")


class View:
    """Shows what it is given."""

    pose = Pose(0, 0, 0)

    def __init__(self, *texts: VisibleText) -> None:
        self.texts = texts

    def visible_texts(self, range_limit: float, widest: float = math.pi):
        return [each for each in self.texts if each.bearer.distance <= range_limit]


def at(distance: float, text: str, **changes) -> VisibleText:
    bearer = replace(SIGN.bearer, distance=distance, position=(distance, 0.0))
    return replace(SIGN, text=text, bearer=bearer, **changes)


def test_a_sign_ahead_is_read_with_its_distance_and_direction():
    [read] = TruthSignReader().read(View(SIGN))

    assert (read.text, read.distance, read.track_id) == ("Library", 3.0, 1)
    assert read.bearing_deg == pytest.approx(10)


def test_the_nearest_text_comes_first():
    read = TruthSignReader().read(View(at(5, "far"), at(2, "near")))

    assert [each.text for each in read] == ["near", "far"]


@pytest.mark.parametrize(
    "sign",
    [
        pytest.param(at(6.1, "far"), id="beyond 6 m"),
        pytest.param(replace(SIGN, facing=math.radians(70)), id="turned away"),
        pytest.param(replace(SIGN, facing=math.pi), id="from behind"),
        pytest.param(replace(SIGN, cut=True), id="cut by the picture's edge"),
        pytest.param(replace(SIGN, letter_height=4.0), id="letters too small"),
        pytest.param(
            replace(SIGN, bearer=replace(SIGN.bearer, visible_fraction=0.4)),
            id="half hidden",
        ),
        pytest.param(replace(SIGN, text=" \n "), id="nothing written"),
    ],
)
def test_what_cannot_be_read_is_left_out(sign: VisibleText):
    assert TruthSignReader().read(View(sign)) == []


def test_lines_are_joined():
    [read] = TruthSignReader().read(View(replace(SIGN, text="Mail\n  room")))

    assert read.text == "Mail room"


def test_a_text_read_again_keeps_its_number_and_another_gets_its_own():
    reader = TruthSignReader()
    [first] = reader.read(View(at(3, "Library")))
    both = reader.read(View(at(3, "Library"), at(3.1, "Lifts")))

    assert [each.track_id for each in both] == [first.track_id, 2]


class Board:
    """A view of a wall, at a depth, with words on it."""

    def __init__(
        self, *words: tuple[int, int, str], depth: float = 3.0, pose: Pose | None = None
    ) -> None:
        self.words = words
        self.depth = depth
        self.pose = pose or Pose(0, 0, 0)

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        image = Image.new("RGB", (width, height), (235, 235, 230))
        pen = ImageDraw.Draw(image)
        font = ImageFont.truetype(FONT, 40)
        for x, y, word in self.words:
            pen.text((x, y), word, (20, 20, 60), font)
        depth = np.full((height, width), self.depth, dtype=np.float32)
        return CameraPicture(np.asarray(image), depth)


class Reader:
    """Reads what it is told to."""

    def __init__(self, *lines: FoundLine) -> None:
        self.found = lines

    def lines(self, rgb):
        return self.found


def line(left: float, top: float, text: str, score: float = 0.9, tall: float = 30):
    return FoundLine((left, top, left + 20 * len(text), top + tall), text, score)


@pytest.fixture(scope="module")
def recognizer() -> TextRecognizer:
    return TextRecognizer()


def test_words_on_a_wall_are_read_with_distance_and_direction(
    recognizer: TextRecognizer,
):
    board = Board((300, 400, "Library"), (900, 700, "Room 2347"))

    library, room = PictureSignReader(recognizer).read(board)

    assert (library.text, room.text) == ("Library", "Room 2347")
    assert 3.0 < library.distance < room.distance < 3.8
    assert library.bearing_deg == pytest.approx(20, abs=5)
    assert room.bearing_deg == pytest.approx(-31, abs=5)


def test_a_bare_wall_has_no_texts(recognizer: TextRecognizer):
    assert PictureSignReader(recognizer).read(Board()) == []


def test_lines_below_each_other_are_one_text():
    reader = Reader(line(300, 440, "and Shop"), line(300, 400, "Restrooms"))

    [sign] = PictureSignReader(reader).read(Board())

    assert sign.text == "Restrooms and Shop"


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(line(700, 400, "Lifts"), id="beside it"),
        pytest.param(line(300, 500, "Lifts"), id="far below it"),
        pytest.param(line(300, 440, "Lifts", tall=100), id="in other letters"),
    ],
)
def test_lines_apart_are_texts_of_their_own(other: FoundLine):
    signs = PictureSignReader(Reader(line(300, 400, "Restrooms"), other)).read(Board())

    assert {sign.text for sign in signs} == {"Restrooms", "Lifts"}


def test_doubtful_and_far_texts_are_dropped():
    doubtful = Reader(line(300, 400, "Rxsfr", score=0.5), line(300, 600, " "))
    sure = Reader(line(600, 400, "Restrooms"))

    assert PictureSignReader(doubtful).read(Board()) == []
    assert PictureSignReader(sure).read(Board(depth=6.2)) == []
    assert len(PictureSignReader(sure).read(Board(depth=5.8))) == 1


def test_a_text_read_again_keeps_its_number_even_misread():
    reader: Callable[..., Reader] = Reader
    signs = PictureSignReader(reader(line(600, 400, "Library")))
    [first] = signs.read(Board())
    signs._recognizer.found = (line(600, 400, "Librory"), line(100, 400, "Lifts"))

    again = {
        sign.text: sign.track_id for sign in signs.read(Board(pose=Pose(0.1, 0, 0)))
    }

    assert again["Librory"] == first.track_id != again["Lifts"]
