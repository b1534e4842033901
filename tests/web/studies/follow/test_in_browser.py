"""Following a text in Chromium, from the page with the robot to the scored walk."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from memorymaze.runs.work.run_folder import read_run
from memorymaze.web.studies.follow.runs import export_walks
from memorymaze.web.studies.study_file import Study

MakeStudy = Callable[..., Study]
ServeStudy = Callable[[Study], Any]
ENOUGH = 60_000.0
"""Milliseconds in which a robot is set up, or does a command."""


def consent_and_go_to_the_first_way(page: Page) -> None:
    for box in page.locator("input[type=checkbox]").all():
        box.press("Space")
    page.get_by_role("button").first.press("Enter")
    answers = [
        ("Drive a robot through a building", "From the words of somebody"),
        ("I have never been there",),
        (),
    ]
    for chosen in answers:
        for each in chosen:
            page.get_by_label(each).press("Space")
        page.get_by_role("button", name="Go on").press("Enter")


def press(page: Page, keys: list[str], done: int = 0) -> None:
    """Press keys, each when the robot has done what the one before said."""
    drive = page.locator("#drive")
    for number, key in enumerate(keys, start=done + 1):
        expect(page.locator("[data-command=forward]")).to_be_enabled(timeout=ENOUGH)
        page.keyboard.press(key)
        expect(drive).to_have_attribute("data-done", str(number), timeout=ENOUGH)


@pytest.mark.proof
@pytest.mark.parametrize(
    "width", [pytest.param(390, id="phone"), pytest.param(1280, id="desktop")]
)
def test_somebody_drives_by_keyboard_reloads_the_page_and_arrives(
    make_study: MakeStudy,
    serve_study: ServeStudy,
    tiny_instructions: Path,
    browser: Browser,
    complaints: Callable[[Page], list[str]],
    tmp_path: Path,
    width: int,
) -> None:
    study = make_study(
        "follow",
        f"instructions = [{json.dumps(str(tiny_instructions))}]",
        "platform_ids = []",
    )
    problems: list[str] = []
    context = browser.new_context(
        bypass_csp=True,
        reduced_motion="reduce",
        viewport={"width": width, "height": 844},
    )
    with serve_study(study) as served, context:
        page = context.new_page()
        page.on("pageerror", lambda error: problems.append(str(error)))
        page.on("console", lambda message: problems.append(message.text))
        page.goto(served.addresses.participants)
        consent_and_go_to_the_first_way(page)
        expect(page.locator("#camera")).to_be_visible(timeout=ENOUGH)
        assert complaints(page) == []
        turn = "ArrowLeft" if is_first(page) else "ArrowRight"
        press(page, ["ArrowUp"] * 12)
        page.reload()
        expect(page.locator("#drive")).to_have_attribute("data-done", "12")
        press(page, ["ArrowUp"] * 8 + [turn] * 3 + ["ArrowUp"] * 18, done=12)
        expect(page.locator("#metres")).to_have_text(re.compile("1[89]"))
        page.get_by_label("The robot is where the words lead.").press("Space")
        page.get_by_label("entirely").press("Space")
        page.get_by_role("button", name="End this walk").press("Enter")
        expect(page.get_by_role("heading", level=1)).to_have_text("A short question")
        done = export_walks(study, served.store, tmp_path / "people")
    assert done.walks == 1
    _, [result] = read_run(tmp_path / "people")
    assert (result.agent, result.success, result.confidence) == ("people", True, 1.0)
    assert not problems


@pytest.mark.proof
@pytest.mark.parametrize(
    ("ends", "shown"),
    [
        pytest.param("ended", "Thank you", id="ended"),
        pytest.param("withdrawn", "Welcome", id="withdrawn"),
    ],
)
def test_a_walk_that_is_over_in_another_window_leads_on_to_what_the_study_says(
    make_study: MakeStudy,
    serve_study: ServeStudy,
    tiny_instructions: Path,
    browser: Browser,
    ends: str,
    shown: str,
) -> None:
    study = make_study(
        "follow",
        f"instructions = [{json.dumps(str(tiny_instructions))}]",
        "platform_ids = []",
    )
    with serve_study(study) as served, browser.new_context() as context:
        page = context.new_page()
        page.goto(served.addresses.participants)
        consent_and_go_to_the_first_way(page)
        if ends == "ended":
            end_walk(page)
            page.get_by_role("radio").first.press("Space")
            page.get_by_role("button", name="Go on").press("Enter")
            expect(page.locator("#drive")).to_have_count(1)
        other = context.new_page()
        other.goto(page.url)
        expect(other.locator("[data-command=forward]")).to_be_enabled(timeout=ENOUGH)
        if ends == "ended":
            end_walk(page)
        else:
            page.goto(f"{served.addresses.participants}/withdraw")
            page.get_by_role("button", name="Remove everything").press("Enter")
            expect(page.get_by_role("heading", level=1)).to_contain_text("removed")
        other.keyboard.press("ArrowUp")
        expect(other.get_by_role("heading", level=1)).to_contain_text(shown)


def end_walk(page: Page) -> None:
    page.get_by_label("I cannot find the way.").press("Space")
    page.get_by_label("not at all").press("Space")
    page.get_by_role("button", name="End this walk").press("Enter")
    expect(page.locator("#drive")).to_have_count(0)


def is_first(page: Page) -> bool:
    """Tell whether the way on the page is R1, which goes left."""
    return str(page.get_attribute("#drive", "data-robot")).endswith("R1")
