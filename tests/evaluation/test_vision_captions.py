"""-"""

import io
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from memorymaze.agents.agent import Journal
from memorymaze.errors import LanguageModelError, SettingsError
from memorymaze.evaluation.vision_captions import (
    CaptionKey,
    CaptionStore,
    VisionCaptions,
    read_captions,
    take_pictures,
)
from memorymaze.language.model import Completion, Picture, Usage
from memorymaze.language.scripted_model import ScriptedLanguageModel
from memorymaze.robot.viewpoints import Panorama
from memorymaze.simulation.robot import SimulatedRobot
from memorymaze.simulation.scene import build_scene
from memorymaze.sites import Site
from memorymaze.sites.navigation_graph import Viewpoint

SENTENCES = [f"View {k} of the model." for k in range(8)]
REPLY = json.dumps({"views": SENTENCES, "summary": "A place."})
PLACE = Viewpoint("a" * 32, 10.0, 0.0)
DOT = Picture(b"\xff\xd8\xff", "image/jpeg")


def shoot(*_: Any) -> tuple[Picture, ...]:
    return (DOT,) * 8


@pytest.fixture
def robot(corridor_site: Site) -> SimulatedRobot:
    return SimulatedRobot(
        build_scene(corridor_site), corridor_site.reference_route("R1").start
    )


def test_the_model_describes_and_the_camera_measures(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    model, journal = ScriptedLanguageModel([REPLY], name="eyes"), Journal()
    captions = VisionCaptions(model, CaptionStore(tmp_path / "c.sqlite"), shoot)
    panorama = captions.in_episode(robot, journal)(PLACE)
    assert [outlook.scene for outlook in panorama.outlooks] == SENTENCES
    assert (panorama.summary, panorama.described_by) == ("A place.", "eyes")
    assert "bench" in str(panorama.outlooks[4].things)
    assert model.requests[0].messages[-1].pictures == (DOT,) * 8
    assert journal.model_calls == 1
    assert journal.notes[0]["stage"] == "caption"


def test_captions_are_asked_for_once_and_counted_in_every_episode(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    model = ScriptedLanguageModel(["Hm.", REPLY])
    journals = [Journal(), Journal()]
    seen: list[Panorama] = []
    for journal in journals:
        store = CaptionStore(tmp_path / "c.sqlite")
        look = VisionCaptions(model, store, shoot).in_episode(robot, journal)
        seen += [look(PLACE), look(PLACE)]
    assert seen == seen[:1] * 4
    assert len(model.requests) == 2
    first, second = journals
    assert first.notes == second.notes
    assert (first.model_calls, first.tokens) == (second.model_calls, second.tokens)
    assert first.model_calls == 2


def test_another_place_and_another_model_are_described_anew(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    store, journal = CaptionStore(tmp_path / "c.sqlite"), Journal()
    for name in ("one", "other"):
        model = ScriptedLanguageModel([REPLY, REPLY], name=name)
        look = VisionCaptions(model, store, shoot).in_episode(robot, journal)
        assert look(PLACE).described_by == name
        look(Viewpoint("b" * 32, 5.0, 0.0))
        assert len(model.requests) == 2


def test_a_reply_that_cannot_be_read_is_asked_for_once_more(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    model, journal = ScriptedLanguageModel(["I see a hall.", REPLY]), Journal()
    captions = VisionCaptions(model, CaptionStore(tmp_path / "c.sqlite"), shoot)
    assert captions.in_episode(robot, journal)(PLACE).summary == "A place."
    assert "expected one JSON object" in model.requests[1].messages[-1].content
    assert journal.model_calls == 2


def test_a_model_that_does_not_describe_ends_the_episode(
    robot: SimulatedRobot, tmp_path: Path
) -> None:
    model = ScriptedLanguageModel(["No.", "No."], name="eyes")
    store = CaptionStore(tmp_path / "c.sqlite")
    journal = Journal()
    look = VisionCaptions(model, store, shoot).in_episode(robot, journal)
    with pytest.raises(LanguageModelError, match="eyes: no captions in 2 replies"):
        look(PLACE)
    assert journal.model_calls == 2


def test_a_site_without_a_file_cannot_have_captions_kept(
    corridor_site: Site, tmp_path: Path
) -> None:
    site = replace(corridor_site, source=str(tmp_path / "gone.geojson"))
    robot = SimulatedRobot(build_scene(site), site.reference_route("R1").start)
    captions = VisionCaptions(
        ScriptedLanguageModel([REPLY]), CaptionStore(tmp_path / "c.sqlite"), shoot
    )
    look = captions.in_episode(robot, Journal())
    with pytest.raises(SettingsError, match="captions=templates"):
        look(PLACE)


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
    captions = read_captions(f"Here you are:\n```json\n{REPLY}\n```\nAnything else?")
    assert list(captions.views) == SENTENCES


def test_pictures_show_eight_directions(corridor_site: Site) -> None:
    pictures = take_pictures(build_scene(corridor_site), PLACE)
    assert [picture.name for picture in pictures] == [
        f"{PLACE.id}-{k}" for k in range(8)
    ]
    sizes = {Image.open(io.BytesIO(picture.data)).size for picture in pictures}
    assert sizes == {(256, 512)}
    assert len({picture.data for picture in pictures}) == 8


KEY = CaptionKey("scene", "viewpoint", "model", "prompt")
CAPTIONS = (
    Completion("Hm.", "model", Usage(900, 1, 0.002), 1.5),
    Completion("A hall with é.", "model", Usage(1000, 50), 2.5),
)


def test_what_is_kept_is_found_again_by_another(tmp_path: Path) -> None:
    path = tmp_path / "captions.sqlite"
    assert CaptionStore(path).find(KEY) == ()
    CaptionStore(path).keep(KEY, CAPTIONS)
    assert CaptionStore(path).find(KEY) == CAPTIONS


@pytest.mark.parametrize("part", ["scene", "viewpoint", "model", "prompt"])
def test_captions_hold_for_what_determines_them_only(tmp_path: Path, part: str) -> None:
    store = CaptionStore(tmp_path / "captions.sqlite")
    store.keep(KEY, CAPTIONS)
    assert store.find(replace(KEY, **{part: "other"})) == ()


def test_the_first_captions_stay(tmp_path: Path) -> None:
    store = CaptionStore(tmp_path / "captions.sqlite")
    store.keep(KEY, CAPTIONS)
    assert store.keep(KEY, CAPTIONS[:1]) == CAPTIONS


def test_a_file_that_is_something_else_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "captions.txt"
    path.write_text("no database at all, and long enough to tell that " * 40)
    with pytest.raises(SettingsError, match=r"captions\.txt.*--set caption_file=FILE"):
        CaptionStore(path)
