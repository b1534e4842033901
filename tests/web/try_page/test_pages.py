"""The pages to try the robot, over a real connection and in a browser."""

import time
from collections.abc import Callable, Generator

import httpx2
import pytest
from playwright.sync_api import Browser, Page, expect

from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.web.serving.web import ServedApplication, make_app, serving
from memorymaze.web.try_page.pages import TRYING_ROOM, TryPages, examples_of
from memorymaze.web.try_page.sessions import LEAVING, PATIENCE, Visits
from memorymaze.world.sites import Site

ENOUGH = 60_000.0
"""Milliseconds in which a robot is ready, or has walked."""
ASTRAY = "Go to the T and turn right, <b>then</b> go to the end."


@pytest.fixture(scope="module")
def visits() -> Generator[Visits]:
    with Visits(RunSettings(), [AgentSettings("explorer")], most=2) as visits:
        yield visits


@pytest.fixture(scope="module")
def address(visits: Visits, t_site: Site) -> Generator[str]:
    app = make_app(TryPages(visits, {t_site.name: t_site}).routes(), TRYING_ROOM)
    with serving(ServedApplication(app)) as [address]:
        yield address


@pytest.fixture
def page(browser: Browser) -> Generator[Page]:
    opened = browser.new_page(bypass_csp=True, viewport={"width": 390, "height": 844})
    opened.set_default_timeout(ENOUGH)
    yield opened
    opened.close()


@pytest.mark.proof
def test_a_visitor_tells_a_way_with_the_keyboard_and_sees_where_it_was_lost(
    address: str, page: Page, complaints: Callable[[Page], list[str]]
) -> None:
    problems: list[str] = []
    page.on("console", lambda message: problems.append(message.text))
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(address)
    assert complaints(page) == []
    page.keyboard.press("Tab")  # past the link to the content
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#status")).to_have_text(
        "The robot is ready and listens.", timeout=ENOUGH
    )
    expect(page.locator("#round")).to_be_visible()
    page.wait_for_function("document.getElementById('round-strip').scrollLeft > 0")
    assert complaints(page) == []
    page.focus("#text")
    page.keyboard.type(ASTRAY)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.locator("#camera")).to_be_visible(timeout=ENOUGH)
    page.select_option("#pace", "30")
    expect(page.locator("#verdict-headline")).to_have_text(
        "✘ The robot did not arrive.", timeout=ENOUGH
    )
    assert page.inner_text("#told") == ASTRAY
    assert "turn right" in page.inner_text("#steps")
    assert "it went right" in page.inner_text("#verdict")
    assert page.locator("#lost").is_visible()
    expect(page.locator("#beside-rows tr")).to_have_count(2)
    expect(page.locator("#visit")).to_have_attribute("data-state", "over")
    assert "did not arrive" in page.inner_text("#announced")
    assert len(str(page.get_attribute("#walked", "points")).split()) > 20
    assert complaints(page) == []
    assert not problems


@pytest.mark.proof
def test_a_visitor_pauses_and_stops_and_leaves(
    visits: Visits, address: str, page: Page
) -> None:
    page.goto(address)
    page.get_by_role("button", name="To").first.click()
    page.fill("#text", "Go to the T and turn left.")
    page.get_by_role("button", name="Let the robot walk").click()
    page.get_by_role("button", name="Pause").click()
    expect(page.locator("#status")).to_have_text("The robot waits: the walk is paused.")
    expect(page.get_by_role("button", name="Go on")).to_be_focused()
    page.get_by_role("button", name="Stop").click()
    expect(page.locator("#tell")).to_be_visible(timeout=ENOUGH)
    assert page.input_value("#text") == "Go to the T and turn left."
    visit = visits.find(page.url.rpartition("/")[2])
    assert visit is not None
    assert visit.process is not None
    page.close()
    # What the page asked last may come in after it said that it leaves.
    deadline = time.monotonic() + PATIENCE + 3 * LEAVING
    while visit.process is not None:
        assert time.monotonic() < deadline, "a closed page gives its robot back"
        time.sleep(0.05)


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/visits/guessed", 404),
        ("/visits/guessed/camera.jpg", 404),
        ("/plans/../../etc/passwd.svg", 404),
        ("/plans/elsewhere.svg", 404),
    ],
)
def test_what_is_not_there_is_told_so(address: str, path: str, status: int) -> None:
    assert httpx2.get(address + path).status_code == status


def test_examples_are_of_the_shipped_plan_alone(
    builtin_sites: dict[str, Site], t_site: Site
) -> None:
    site = builtin_sites["museum_5f"]
    titles = [each.title for each in examples_of(site, site.find_route("R1"))]
    assert titles == ["Typed", "Spoken", "With a mistake in it"]
    assert not examples_of(t_site, t_site.find_route("R1"))
