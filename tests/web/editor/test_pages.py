import json
import re
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import httpx2
import pytest

EditPlan = Callable[..., AbstractContextManager[str]]


class Script:
    """What the page's script sends, without a browser."""

    def __init__(self, address: str) -> None:
        self.client = httpx2.Client(base_url=address, follow_redirects=True)
        page = self.client.get("/enter/token")
        found = re.search(r'name="csrf-token" content="(\w+)"', page.text)
        assert found, page.text
        self.client.headers["x-csrf-token"] = found[1]
        loaded = self.client.get("/plan").json()
        self.base, plan = loaded["base"], loaded["plan"]
        self.features: list[Any] = plan.pop("features")
        self.members = plan

    def send(self, path: str, **more: Any) -> Any:
        message = {
            "base": self.base,
            "members": self.members,
            "features": self.features,
        }
        return self.client.post(path, json=message | more)


@pytest.fixture
def script(annex: Path, edit: EditPlan) -> Iterator[Script]:
    with edit(annex) as address:
        script = Script(address)
        yield script
        script.client.close()


def test_nobody_gets_in_without_the_token(annex: Path, edit: EditPlan) -> None:
    with edit(annex) as address:
        for path in ("/", "/plan", "/picture", "/enter/guessed"):
            assert httpx2.get(address + path).status_code == 403


def test_forms_offer_the_words_that_the_format_and_the_cameras_know(
    script: Script,
) -> None:
    forms = script.client.get("/plan").json()["forms"]
    assert set(forms["kinds"]) >= {"corridor", "turning_point", "landmark", "route"}
    assert "stairwell" in forms["words"]["use"]
    assert "bench" in forms["words"]["category"]
    assert "red" in forms["words"]["color"]


def test_a_form_from_elsewhere_is_refused(script: Script, annex: Path) -> None:
    before = annex.read_bytes()
    del script.client.headers["x-csrf-token"]
    assert script.send("/save").status_code == 403
    assert annex.read_bytes() == before


def test_problems_are_told_with_the_features_they_are_of(script: Script) -> None:
    script.features[4]["geometry"]["coordinates"] = [[11, 5.5], [11, 6.5]]
    told = script.send("/check").json()
    errors = [each for each in told["problems"] if each["severity"] == "error"]
    assert [(each["feature"], each["rule"]) for each in errors] == [
        ("door_library", "door-on-wall"),
        ("door_library", "door-at-room"),
    ]
    assert [12.0, 9.0] in told["walls"][0]


def test_a_broken_plan_is_edited_and_its_broken_features_are_named(
    script: Script,
) -> None:
    script.features[0]["geometry"] = None
    script.features[1] = "nothing"
    del script.members["title"]
    told = script.send("/check").json()
    named = {each["feature"] for each in told["problems"]}
    assert {"corridor_east", "features[1]", "-"} <= named
    assert told["walls"] == []


def test_a_warning_says_what_has_no_look(script: Script) -> None:
    script.features[5]["properties"]["category"] = "flux capacitor"
    rules = [each["rule"] for each in script.send("/check").json()["problems"]]
    assert "known-look" in rules


def test_the_draft_is_back_when_the_page_is_loaded_again(script: Script) -> None:
    script.members["title"] = "Tower"
    script.send("/check")
    assert script.client.get("/plan").json()["draft"]["title"] == "Tower"
    script.client.post("/discard", json={})
    assert script.client.get("/plan").json()["draft"] is None


def test_saving_says_when_the_file_was_changed_by_others(
    script: Script, annex: Path
) -> None:
    annex.write_text(json.dumps(json.loads(annex.read_text("utf-8"))), encoding="utf-8")
    script.members["title"] = "Tower"
    refused = script.send("/save")
    assert refused.status_code == 409
    assert "was changed on the disk" in refused.json()["problem"]
    script.base = script.client.get("/plan").json()["base"]
    assert script.send("/save").status_code == 200
    assert json.loads(annex.read_text("utf-8"))["title"] == "Tower"


def test_a_drawn_route_gets_its_turns_and_its_goal(script: Script) -> None:
    route = script.features.pop()
    drawn = route | {
        "properties": route["properties"] | {"turns": [], "goal_landmark": ""}
    }
    [proposed] = script.send("/propose", feature=drawn).json()["features"]
    assert proposed["properties"]["turns"] == [{"at": "tp_corner", "direction": "left"}]
    assert proposed["properties"]["goal_landmark"] == "door_library"


@pytest.mark.parametrize("sent", [b"{", b"[]", b'{"base": 1}'])
def test_what_is_no_plan_is_refused(script: Script, sent: bytes) -> None:
    assert script.client.post("/check", content=sent).status_code == 400
