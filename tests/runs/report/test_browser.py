"""Reports as a reader meets them: in Chromium, from the disk."""

from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page

Opened = Callable[..., Page]


def episode_page(report: Path) -> Path:
    """Return the page of an episode on a site with a turn."""
    return next(
        page
        for page in sorted((report / "episodes").iterdir())
        if "turn left" in page.read_text(encoding="utf-8")
    )


@pytest.mark.proof
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_pages_pass_the_accessibility_checks_of_axe(
    report: Path,
    opened: Opened,
    complaints: Callable[[Page], list[str]],
    scheme: str,
) -> None:
    files = [next((report / "routes").rglob("*.html")), episode_page(report)]
    # Elsewhere only the contrasts could differ, and their colours are on these two.
    if scheme == "light":
        files += sorted(report.glob("*.html"))
    for file in files:
        page = opened(file, bypass_csp=True, color_scheme=scheme)
        assert complaints(page) == []


@pytest.mark.proof
def test_a_narrow_window_needs_no_sideways_scrolling(
    report: Path, opened: Opened
) -> None:
    for file in (report / "index.html", episode_page(report)):
        page = opened(file, viewport={"width": 400, "height": 800})
        wide = page.evaluate("document.documentElement.scrollWidth")
        assert wide <= 400, file


def test_the_slider_moves_every_robot_and_marks_what_is_worked_on(
    report: Path, opened: Opened
) -> None:
    page = opened(episode_page(report))
    slider = page.get_by_role("slider", name="Time")
    assert slider.is_visible()
    slider.focus()
    page.keyboard.press("Home")
    at_start = page.locator(".replay .robot").first.get_attribute("d")
    assert page.locator(".worked li[aria-current]").first.is_visible()
    assert "0.0 seconds" in str(slider.get_attribute("aria-valuetext"))
    page.get_by_role("button", name="Next event").press("Enter")
    page.keyboard.press("Enter")
    assert page.locator(".replay .robot").first.get_attribute("d") != at_start
    assert "move_forward" in page.locator(".replay .now").first.inner_text()
    assert "move_forward" in str(slider.get_attribute("aria-valuetext"))


def test_lines_of_a_program_are_marked_that_make_the_call_at_hand(
    report: Path, opened: Opened
) -> None:
    page = opened(episode_page(report))
    page.get_by_role("slider", name="Time").focus()
    page.keyboard.press("Home")
    marked: list[list[str]] = []
    for _ in range(200):
        texts = page.locator(".program li[aria-current] code").all_inner_texts()
        marked.append([text.strip() for text in texts])
        if ["move_forward(3)"] in marked:
            break
        page.get_by_role("button", name="Next event").click()
    assert ["move_forward(0.5)"] in marked
    assert ["move_forward(3)"] in marked
    # A call with other arguments is no reason to mark a line.
    assert ['turn("left")'] not in marked


def test_playing_ends_by_itself_also_for_those_who_want_no_motion(
    report: Path, opened: Opened
) -> None:
    page = opened(episode_page(report), reduced_motion="reduce")
    page.clock.install()
    page.get_by_role("button", name="Play").click()
    page.clock.run_for(2000)
    assert page.get_by_role("button", name="Pause").is_visible()
    page.clock.run_for(600_000)
    assert page.get_by_role("button", name="Play").is_visible()


def test_the_timeline_is_a_table_whose_times_go_there(
    report: Path, opened: Opened
) -> None:
    page = opened(episode_page(report))
    page.get_by_text("Calls, detections and notes").first.click()
    rows = page.locator(".timeline").first.locator("tbody tr")
    rows.first.wait_for()
    before = rows.count()
    page.get_by_label("Leave out questions").first.uncheck()
    assert rows.count() > before > 0
    rows.nth(1).get_by_role("button").click()
    assert rows.locator("xpath=self::*[contains(@class, 'current')]").count() == 1


def test_lists_of_episodes_are_filtered_and_sorted(
    report: Path, opened: Opened
) -> None:
    page = opened(report / "episodes.html")
    page.get_by_role("searchbox").fill("onsite")
    shown = page.locator("tbody tr:visible")
    assert 0 < shown.count() < page.locator("tbody tr").count()
    page.get_by_role("searchbox").fill("")
    head = page.get_by_role("columnheader", name="A: SPD (m)")
    head.get_by_role("button").click()
    assert head.get_attribute("aria-sort") == "ascending"
    column = page.locator("tbody tr td:nth-of-type(6)").all_inner_texts()
    assert column == sorted(column, key=float)


def test_walks_of_an_outcome_can_be_hidden_without_a_script(
    report: Path, opened: Opened
) -> None:
    route = next((report / "routes").rglob("*.html"))
    page = opened(route, java_script_enabled=False)
    crosses = page.locator(".walks .plan .end.elsewhere")
    assert crosses.first.is_visible()
    page.get_by_role("checkbox", name="stopped elsewhere").uncheck()
    assert not crosses.first.is_visible()


def test_hostile_texts_stay_texts(hostile_report: Path, opened: Opened) -> None:
    for file in sorted(hostile_report.rglob("*.html")):
        page = opened(file, bypass_csp=True)
        assert page.evaluate("window.hacked") is None, file
        assert page.locator("img, main b, main script").count() == 0, file
    [episode] = (hostile_report / "episodes").iterdir()
    page = opened(episode)
    page.get_by_text("Calls, detections and notes").click()
    page.locator(".timeline tbody tr").first.wait_for()
    assert "<b>go left</b>" in page.locator(".timeline").inner_text()
    assert "{{ 7 * 7 }}" in page.locator("blockquote").inner_text()
