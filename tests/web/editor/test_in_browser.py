"""Plans drawn and edited in Chromium, by mouse and by keyboard."""

import json
import shutil
from collections.abc import Callable, Generator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Browser, Page, expect

import memorymaze
from memorymaze.world.sites import find_site_problems, plan_file

EditPlan = Callable[..., AbstractContextManager[str]]
Complaints = Callable[[Page], list[str]]
LAPTOP = {"width": 1280, "height": 720}
WAY = "Go straight on to the corner, turn left, and stop at the door on your right."


class Draughtsman:
    """Somebody at the page of a plan."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.heard: list[str] = []
        page.on("pageerror", lambda error: self.heard.append(str(error)))
        page.on("console", self._hear)

    def _hear(self, message: Any) -> None:
        # What is refused on purpose has code 409, which the browser logs.
        if message.type == "error" and "409" not in message.text:
            self.heard.append(message.text)

    @contextmanager
    def working_at(self, address: str) -> Generator[None]:
        """Open the page, and leave it before its server ends."""
        self.page.goto(f"{address}/enter/token")
        self.is_checked()
        try:
            yield
        finally:
            self.page.close()

    def is_checked(self) -> None:
        """Wait until the page has the answer to the last edit."""
        expect(self.page.locator("#checked")).not_to_have_text("…")

    def tool(self, name: str) -> None:
        self.page.get_by_role("button", name=name, exact=True).click()

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Return where a place of the plan is on the screen."""
        found = self.page.evaluate(
            """([x, y]) => {
            const plan = document.getElementById("plan");
            const at = new DOMPoint(x, -y).matrixTransform(plan.getScreenCTM());
            return [at.x, at.y];
            }""",
            [x, y],
        )
        return found[0], found[1]

    def click(self, x: float, y: float) -> None:
        self.page.mouse.click(*self.at(x, y))

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        self.page.mouse.move(*self.at(*start))
        self.page.mouse.down()
        self.page.mouse.move(*self.at(*end), steps=4)
        self.page.mouse.up()

    def keys(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)

    def fill(self, label: str, value: str) -> None:
        """Fill in a field of what is chosen, as one who leaves it does."""
        field = self.page.locator("#form").get_by_label(label, exact=True)
        field.fill(value)
        field.press("Tab")

    def save(self) -> None:
        self.page.keyboard.press("Control+s")
        expect(self.page.locator("#saved")).to_have_text("saved")


def drawing_in(browser: Browser, **options: Any) -> Generator[Draughtsman]:
    context = browser.new_context(viewport=LAPTOP, **options)
    somebody = Draughtsman(context.new_page())
    yield somebody
    context.close()
    assert somebody.heard == []


@pytest.fixture
def draughtsman(browser: Browser) -> Generator[Draughtsman]:
    """Somebody whose browser lets axe in; the test fails on any complaint."""
    yield from drawing_in(browser, bypass_csp=True)


@pytest.fixture
def strict_draughtsman(browser: Browser) -> Generator[Draughtsman]:
    """Somebody whose browser keeps the page's policy."""
    yield from drawing_in(browser)


def feature(path: Path, identity: str) -> dict[str, Any]:
    features = json.loads(path.read_text(encoding="utf-8"))["features"]
    return next(each for each in features if each["id"] == identity)


@pytest.mark.proof
def test_a_bench_is_moved_by_the_keyboard_alone_and_saved(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page = draughtsman.page
    before = json.loads(annex.read_bytes())
    with edit(annex) as address, draughtsman.working_at(address):
        assert complaints(page) == []
        page.get_by_label("Features").focus()
        draughtsman.keys("b")  # lists find what begins so
        expect(page.locator("#form h2")).to_contain_text("bench")
        assert complaints(page) == []
        page.locator("#plan").focus()
        draughtsman.keys("Shift+ArrowRight", "ArrowRight", "ArrowLeft", "ArrowLeft")
        expect(page.get_by_label("x of place 1")).to_have_value("5.9")
        draughtsman.fill("Color", "red")
        assert page.evaluate("document.activeElement.name") == "name"
        draughtsman.fill("y of place 1", "-0.8")
        draughtsman.save()
        moved = feature(annex, "bench")
        assert moved["geometry"]["coordinates"] == [5.9, -0.8]
        assert moved["properties"]["color"] == "red"
        page.locator("#plan").focus()
        for _ in range(10):
            draughtsman.keys("Control+z")
        expect(page.get_by_role("button", name="Undo")).to_be_disabled()
        draughtsman.save()
    assert json.loads(annex.read_bytes()) == before


@pytest.mark.proof
def test_a_number_that_is_not_taken_gives_way_to_the_one_of_the_plan(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman
) -> None:
    page = draughtsman.page
    with edit(annex) as address, draughtsman.working_at(address):
        page.get_by_label("Features").select_option("corridor_east")
        for label, value in (("Width (m)", "0"), ("x of place 1", "")):
            field = page.locator("#form").get_by_label(label, exact=True)
            before = field.input_value()
            assert before
            draughtsman.fill(label, value)
            expect(field).to_have_value(before)
            assert page.evaluate("document.activeElement.name")


@pytest.mark.proof
def test_a_building_is_drawn_from_nothing_and_walked(
    tmp_path: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page, path = draughtsman.page, tmp_path / "tower.geojson"
    with edit(path) as address, draughtsman.working_at(address):
        assert complaints(page) == []
        draughtsman.tool("Corridor")
        draughtsman.drag((0, 0), (10, 0))
        # The second corridor by the keyboard; it begins in the middle of the paper.
        draughtsman.keys("c", "Enter")
        expect(page.locator("#status")).to_have_text("8, 4")
        draughtsman.keys(*["Shift+ArrowRight"] * 3, *["Shift+ArrowDown"] * 3, "Enter")
        draughtsman.keys(*["Shift+ArrowUp"] * 8, "Enter")
        draughtsman.is_checked()
        draughtsman.tool("Make turning points")
        expect(page.locator("#status")).to_have_text("1 turning point made.")
        draughtsman.tool("Room")
        draughtsman.drag((12, 4), (16, 8))
        draughtsman.fill("Name", "Library")
        draughtsman.is_checked()
        draughtsman.tool("Door")
        draughtsman.click(12.1, 6)
        expect(page.get_by_label("Room", exact=True)).to_have_value("room_1")
        draughtsman.fill("Label", "Library")
        draughtsman.tool("Thing")
        draughtsman.click(5, -0.7)
        draughtsman.fill("Category", "plant")
        draughtsman.tool("Route")
        draughtsman.click(1, 0)
        draughtsman.click(11, 0)
        draughtsman.click(11, 6)
        draughtsman.keys("Enter")
        expect(page.get_by_label("Goal", exact=True)).to_have_value("Library")
        draughtsman.is_checked()
        expect(page.locator("#errors-count")).to_have_text("0 errors")
        assert complaints(page) == []
        draughtsman.save()
    assert [
        each.line() for each in find_site_problems(path) if each.severity == "error"
    ] == []
    thing = feature(path, "thing_1")
    assert thing["geometry"]["coordinates"] == [5, -0.775]
    assert feature(path, "route_r1_reference")["properties"]["turns"] == [
        {"at": "tp_1", "direction": "left"}
    ]
    for agent in ("oracle", "guide"):
        assert memorymaze.follow(WAY, agent, site=path).result.success


@pytest.mark.proof
def test_what_is_chosen_is_dragged_copied_and_deleted_and_each_step_taken_back(
    annex: Path, edit: EditPlan, strict_draughtsman: Draughtsman
) -> None:
    draughtsman, page = strict_draughtsman, strict_draughtsman.page
    before = annex.read_bytes()
    undo = page.get_by_role("button", name="Undo")
    with edit(annex) as address, draughtsman.working_at(address):
        draughtsman.click(14, 6)
        expect(page.locator("#form h2")).to_contain_text("room_library")
        draughtsman.drag((14, 6), (14.52, 6))
        expect(page.get_by_label("x of place 1")).to_have_value("12.5")
        draughtsman.drag((16.5, 8), (16.1, 9.02))  # near an axis of the corridor
        expect(page.get_by_label("x of place 3")).to_have_value("16.1")
        expect(page.get_by_label("y of place 3")).to_have_value("9")
        draughtsman.keys(".", "Delete", "Control+d")
        expect(page.locator("#form h2")).to_contain_text("room_library_1")
        draughtsman.keys("Delete")
        draughtsman.is_checked()
        assert page.locator("#features option").count() == 8
        for _ in range(5):
            expect(undo).to_be_enabled()
            draughtsman.keys("Control+z")
        expect(undo).to_be_disabled()
        draughtsman.keys(*["Control+Shift+z"] * 2, *["Control+z"] * 2)
        draughtsman.save()
    assert annex.read_bytes() == before


@pytest.mark.proof
def test_what_is_wrong_is_shown_where_it_is_and_a_broken_plan_is_mended(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page = draughtsman.page
    plan = json.loads(annex.read_text(encoding="utf-8"))
    plan["features"][0]["geometry"]["coordinates"] = None
    plan["features"][4]["properties"]["room"] = "nowhere"
    annex.write_text(json.dumps(plan), encoding="utf-8")
    with edit(annex) as address, draughtsman.working_at(address):
        assert complaints(page) == []
        expect(page.locator("#errors-count")).to_have_text("2 errors")
        page.locator("#errors button").first.press("Enter")
        expect(page.locator("#form h2")).to_contain_text("corridor_east")
        page.get_by_text("As JSON").click()
        ring = [[0, -1], [10, -1], [10, 1], [0, 1], [0, -1]]
        mended = plan["features"][0] | {
            "geometry": {"type": "Polygon", "coordinates": [ring]}
        }
        page.get_by_label("JSON", exact=True).fill(json.dumps(mended))
        draughtsman.keys("Tab")
        draughtsman.is_checked()
        expect(page.locator("#errors-count")).to_have_text("1 error")
        expect(page.locator("#marks .error")).to_have_count(1)
        page.locator("#errors button").press("Enter")
        draughtsman.fill("Room", "room_library")
        draughtsman.is_checked()
        expect(page.locator("#errors-count")).to_have_text("0 errors")
        draughtsman.save()
    assert not [each for each in find_site_problems(annex) if each.severity == "error"]


@pytest.mark.proof
def test_typed_json_is_saved_when_it_is_left_and_kept_where_it_cannot_be_read(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page = draughtsman.page
    features, typed = page.get_by_label("Features"), page.locator("[name=json]")

    def type_instead(old: str, new: str) -> None:
        typed.fill(typed.input_value().replace(old, new))

    def choose(name: str) -> None:
        features.focus()
        features.select_option(name)
        expect(page.locator("#form h2")).to_contain_text(name)

    with edit(annex) as address, draughtsman.working_at(address):
        choose("bench")
        page.get_by_text("As JSON").click()
        type_instead('"green"', '"red"')
        draughtsman.keys("Control+s")
        expect(page.locator("#status")).to_have_text("Saved.")
        assert feature(annex, "bench")["properties"]["color"] == "red"
        type_instead('"red"', '"brown"')
        draughtsman.keys("Control+d")
        expect(page.locator("#form h2")).to_contain_text("bench_1")
        type_instead('"brown"', '"blue"')
        choose("corridor_east")
        draughtsman.save()
        assert feature(annex, "bench")["properties"]["color"] == "brown"
        assert feature(annex, "bench_1")["properties"]["color"] == "blue"
        choose("bench")
        type_instead('"brown",', '"brown"')
        choose("corridor_east")
        expect(page.locator("#form .wrong")).to_have_text("")
        draughtsman.keys("Control+s")
        expect(page.locator("#status")).to_contain_text("Not saved: correct the JSON")
        expect(page.locator("#form h2")).to_contain_text("bench")
        expect(page.locator("#form .wrong")).to_contain_text("JSON")
        assert complaints(page) == []
        type_instead('"brown"', '"green",')
        draughtsman.keys("Control+s")
        expect(page.locator("#status")).to_have_text("Saved.")
        assert feature(annex, "bench")["properties"]["color"] == "green"
        expect(page.locator("#form .wrong")).to_have_text("")


@pytest.mark.proof
def test_a_reload_loses_nothing_and_another_hand_is_not_overwritten(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page = draughtsman.page
    page.on("dialog", lambda dialog: dialog.accept())
    with edit(annex) as address, draughtsman.working_at(address):
        page.get_by_label("Title").fill("Tower")
        page.reload()
        draughtsman.is_checked()
        expect(page.locator("#draft")).to_be_visible()
        expect(page.get_by_label("Title")).to_have_value("Tower")
        draughtsman.tool("Throw it away")
        expect(page.get_by_label("Title")).to_have_value("Annex")
        expect(page.locator("#saved")).to_have_text("saved")
        page.get_by_label("Title").fill("Tower")
        other = annex.read_text(encoding="utf-8").replace("Library", "Archive")
        annex.write_text(other, encoding="utf-8")
        draughtsman.keys("Control+s")
        expect(page.locator("#conflict-words")).to_contain_text("changed on the disk")
        assert complaints(page) == []
        page.get_by_role("button", name="Go on without saving").press("Enter")
        assert annex.read_text(encoding="utf-8") == other
        draughtsman.keys("Control+s")
        page.get_by_role("button", name="Save over it").press("Enter")
        expect(page.locator("#saved")).to_have_text("saved")
    plan = json.loads(annex.read_text(encoding="utf-8"))
    assert plan["title"] == "Tower"
    assert "Archive" not in annex.read_text(encoding="utf-8")


@pytest.mark.proof
def test_what_another_window_saved_is_only_replaced_on_purpose(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman
) -> None:
    page = draughtsman.page
    with edit(annex) as address, draughtsman.working_at(address):
        other = Draughtsman(page.context.new_page())
        with other.working_at(address):
            other.fill("Title", "Tower")
            other.save()
        draughtsman.fill("Floor", "first floor")
        draughtsman.is_checked()
        draughtsman.keys("Control+s")
        expect(page.locator("#conflict-words")).to_contain_text("in another window")
        assert json.loads(annex.read_text(encoding="utf-8"))["title"] == "Tower"
        page.get_by_role("button", name="Save over it").press("Enter")
        expect(page.locator("#saved")).to_have_text("saved")
    plan = json.loads(annex.read_text(encoding="utf-8"))
    assert (plan["title"], plan["floor"]) == ("Annex", "first floor")


@pytest.mark.proof
def test_a_picture_is_laid_beneath_to_scale(
    annex: Path, edit: EditPlan, draughtsman: Draughtsman, complaints: Complaints
) -> None:
    page, picture = draughtsman.page, annex.with_name("floor.png")
    Image.new("RGB", (400, 200), "white").save(picture)
    with edit(annex, picture) as address, draughtsman.working_at(address):
        expect(page.get_by_label("Metres a pixel")).to_have_value("0.02")
        draughtsman.tool("Scale by two points")
        draughtsman.click(0, 0)
        draughtsman.click(4, 0)
        page.get_by_label("Metres", exact=True).fill("10")
        assert complaints(page) == []
        with page.expect_response("**/place"):
            page.get_by_role("button", name="Scale the picture").press("Enter")
        expect(page.get_by_label("Metres a pixel")).to_have_value("0.05")
        page.reload()
        expect(page.get_by_label("Metres a pixel")).to_have_value("0.05")
        assert complaints(page) == []


@pytest.mark.proof
def test_a_floor_of_six_hundred_features_is_edited_without_waiting(
    tmp_path: Path, edit: EditPlan, strict_draughtsman: Draughtsman
) -> None:
    draughtsman, page = strict_draughtsman, strict_draughtsman.page
    path = Path(shutil.copy(plan_file("university"), tmp_path))
    with edit(path) as address, draughtsman.working_at(address):
        page.get_by_label("Features").select_option(label="door_a_2101")
        page.locator("#plan").focus()
        milliseconds = page.evaluate(
            """async () => {
            const plan = document.getElementById("plan");
            const took = [];
            for (let n = 0; n < 40; n += 1) {
              const began = performance.now();
              plan.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
              await new Promise(requestAnimationFrame);
              took.push(performance.now() - began);
            }
            return took.sort((a, b) => a - b);
            }"""
        )
        assert milliseconds[20] < 150
