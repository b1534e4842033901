"""-"""

import io
import json
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from memorymaze.agents.agent import Journal
from memorymaze.basics.errors import LanguageModelError
from memorymaze.language.models.answer_files import AnswerFile
from memorymaze.language.models.answers import RecordingModel, ReplayingModel
from memorymaze.language.models.model import Picture
from memorymaze.language.models.scripted_model import ScriptedLanguageModel
from memorymaze.robot.api.viewpoints import Panorama
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import build_scene
from memorymaze.runs.episodes.vision_captions import (
    VisionCaptions,
    read_captions,
    take_pictures,
)
from memorymaze.world.sites import Site
from memorymaze.world.sites.navigation_graph import Viewpoint

SENTENCES = [f"View {k} of the model." for k in range(8)]
REPLY = json.dumps({"views": SENTENCES, "summary": "A place."})
PLACE = Viewpoint("a" * 32, 10.0, 0.0)
DOT = Picture(b"\xff\xd8\xff", "image/jpeg")


def shoot(*_: Any) -> tuple[Picture, ...]:
    return (DOT,) * 8


@pytest.fixture
def robot(corridor_site: Site) -> SimulatedRobot:
    return SimulatedRobot(
        build_scene(corridor_site), corridor_site.find_route("R1").start
    )


def test_the_model_describes_and_the_camera_measures(robot: SimulatedRobot) -> None:
    model, journal = ScriptedLanguageModel([REPLY], name="eyes"), Journal()
    captions = VisionCaptions(model, shoot)
    panorama = captions.in_episode(robot, journal)(PLACE)
    assert [outlook.scene for outlook in panorama.outlooks] == SENTENCES
    assert (panorama.summary, panorama.described_by) == ("A place.", "eyes")
    assert "bench" in str(panorama.outlooks[4].things)
    assert model.requests[0].messages[-1].pictures == (DOT,) * 8
    assert journal.model_calls == 1
    assert journal.notes[0].details["stage"] == "caption"


@pytest.mark.parametrize("process", ["the same", "another"])
def test_captions_are_asked_for_once_and_counted_in_every_episode(
    robot: SimulatedRobot, tmp_path: Path, process: str
) -> None:
    model = ScriptedLanguageModel(["Hm.", REPLY])
    recording = RecordingModel(model, tmp_path / "answers.jsonl")
    captions = VisionCaptions(recording, shoot)
    journals = [Journal(), Journal()]
    seen: list[Panorama] = []
    for journal in journals:
        if process == "another":
            recording = RecordingModel(model, tmp_path / "answers.jsonl")
            captions = VisionCaptions(recording, shoot)
        look = captions.in_episode(robot, journal)
        seen += [look(PLACE), look(PLACE)]
    assert seen == seen[:1] * 4
    assert len(model.requests) == 2
    first, second = journals
    assert first.notes == second.notes
    assert (first.model_calls, first.tokens) == (second.model_calls, second.tokens)
    assert first.model_calls == 2


def test_captions_are_answers_whose_instruction_is_the_viewpoint(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    path = tmp_path / "answers.jsonl"
    model = RecordingModel(ScriptedLanguageModel([REPLY], name="eyes"), path)
    VisionCaptions(model, shoot).in_episode(robot, Journal())(PLACE)
    asked = {(f"corridor/{PLACE.id}", "caption")}
    assert AnswerFile(path).stages().keys() == asked
    replayed = VisionCaptions(ReplayingModel(path), shoot)
    assert replayed.in_episode(robot, Journal())(PLACE).summary == "A place."


def test_another_place_and_another_model_are_described_anew(
    robot: SimulatedRobot,
) -> None:
    journal = Journal()
    for name in ("one", "other"):
        model = ScriptedLanguageModel([REPLY, REPLY], name=name)
        look = VisionCaptions(model, shoot).in_episode(robot, journal)
        assert look(PLACE).described_by == name
        look(Viewpoint("b" * 32, 5.0, 0.0))
        assert len(model.requests) == 2


def test_a_reply_that_cannot_be_read_is_asked_for_once_more(
    robot: SimulatedRobot,
) -> None:
    model, journal = ScriptedLanguageModel(["I see a hall.", REPLY]), Journal()
    captions = VisionCaptions(model, shoot)
    assert captions.in_episode(robot, journal)(PLACE).summary == "A place."
    assert "expected one JSON object" in model.requests[1].messages[-1].content
    assert journal.model_calls == 2


def test_a_model_that_does_not_describe_ends_the_episode(robot: SimulatedRobot) -> None:
    model = ScriptedLanguageModel(["No.", "No."], name="eyes")
    journal = Journal()
    look = VisionCaptions(model, shoot).in_episode(robot, journal)
    with pytest.raises(LanguageModelError, match="eyes: no caption in 2 replies"):
        look(PLACE)
    assert journal.model_calls == 2


@pytest.mark.parametrize(
    ("reply", "message"),
    [
        ('{"views": ' + "[" * 100_000 + "}", "got none"),
        ("", "got none"),
        ("[1, 2]", "got none"),
        ('{"views": []}', "got none"),
        ('{"views": ["a"], "summary": "b"}', "got 1 views"),
        ('{"views": [1, 2, 3, 4, 5, 6, 7, 8], "summary": "b"}', "got other things"),
    ],
)
def test_only_eight_sentences_and_a_summary_will_do(reply: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        read_captions(reply)


def test_words_around_the_captions_do_not_matter() -> None:
    told = f"Here you are:\n```json\n{REPLY}\n```\nAnything else?"
    for reply in (told, f"<think>Perhaps {{a hall}}.</think>\n{told}"):
        assert list(read_captions(reply).views) == SENTENCES


def test_pictures_show_eight_directions(corridor_site: Site) -> None:
    pictures = take_pictures(build_scene(corridor_site), PLACE)
    assert [picture.name for picture in pictures] == [
        f"corridor/{PLACE.id}/{k} own 256x512" for k in range(8)
    ]
    sizes = {Image.open(io.BytesIO(picture.data)).size for picture in pictures}
    assert sizes == {(256, 512)}
    assert len({picture.data for picture in pictures}) == 8
