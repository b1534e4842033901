import threading
from collections.abc import Callable, Generator
from dataclasses import replace
from http.client import HTTPConnection
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page
from shapely import Point, Polygon, box

from memorymaze.evaluation.episode import EpisodeRun
from memorymaze.geometry.pose import Pose
from memorymaze.results.watching import Onlooker, Present
from memorymaze.results.watching.browser import BrowserView
from memorymaze.sites import Site


@pytest.fixture
def view(t_site: Site) -> Generator[BrowserView]:
    route = t_site.reference_route("R1")
    with BrowserView(
        t_site, route, "Go <i>left</i>.", "A walk", lambda _: None
    ) as view:
        yield view


def asked(view: BrowserView, path: str, host: str | None = None) -> tuple[int, bytes]:
    """Ask the server for a path under its secret, or for an absolute one."""
    place = urlsplit(view.address)
    connection = HTTPConnection("127.0.0.1", place.port or 0, timeout=10)
    full = path if path.startswith("/") else place.path + path
    connection.request("GET", full, headers={"Host": host or place.netloc})
    answer = connection.getresponse()
    content = answer.read()
    connection.close()
    return answer.status, content


def test_the_page_and_its_parts_are_served_to_this_machine_only(
    view: BrowserView,
) -> None:
    assert urlsplit(view.address).hostname == "127.0.0.1"
    for part in ("", "page.css", "page.js", "plan.svg"):
        status, content = asked(view, part)
        assert status == 200
        assert content
        assert b"//cdn" not in content
    assert asked(view, "/")[0] == 404
    assert asked(view, "/guess/page.js")[0] == 404
    assert asked(view, "../page_server.py")[0] == 404


def test_names_of_other_places_are_refused(view: BrowserView) -> None:
    assert asked(view, "", host="evil.example")[0] == 403


def test_who_comes_late_is_told_everything_to_the_end(
    view: BrowserView, present: Present
) -> None:
    view.show(present)
    heard: list[bytes] = []
    listener = threading.Thread(target=lambda: heard.append(asked(view, "news")[1]))
    listener.start()
    assert view.wait_for_somebody(10)
    view.finish("arrived")
    view.__exit__(None, None, None)
    listener.join(10)
    assert heard[0].count(b"data: ") == 3
    assert b"say(Hello" in heard[0]
    assert b"arrived" in heard[0]


def test_a_walk_goes_on_when_nobody_comes(view: BrowserView) -> None:
    assert not view.wait_for_somebody(0.01)


def test_the_page_shows_the_part_of_the_plan_where_the_walk_is(
    builtin_sites: dict[str, Site], present: Present, page: Page
) -> None:
    site = builtin_sites["university"]
    route = site.reference_route("R1")

    def shown() -> Polygon:
        west, top, wide, high = map(
            float, str(page.get_attribute("#map", "viewBox")).split()
        )
        return box(west, -top - high, west + wide, -top)

    with BrowserView(site, route, "Go.", "A walk", lambda _: None) as view:
        page.goto(view.address)
        assert view.wait_for_somebody(10)
        page.wait_for_function("document.title === 'A walk'")
        assert shown().covers(route.line)
        assert not shown().covers(site.walkable_floor)
        away = site.walkable_floor.bounds[2:]
        view.show(replace(present, pose=Pose(*away, 0.0)))
        page.wait_for_selector("#robot:not([hidden])")
        assert shown().covers(Point(away))
        view.finish("over")


@pytest.fixture
def page(browser: Browser) -> Generator[Page]:
    opened = browser.new_page(bypass_csp=True)
    yield opened
    opened.close()


def test_the_page_shows_the_walk_and_its_end(
    t_site: Site, walk: Callable[..., EpisodeRun], page: Page, tmp_path: Path
) -> None:
    problems: list[str] = []
    page.on("console", lambda message: problems.append(message.text))
    page.on("pageerror", lambda error: problems.append(str(error)))
    route = t_site.reference_route("R1")
    with BrowserView(
        t_site, route, "Go <i>left</i>.", "A walk", lambda _: None
    ) as view:
        page.goto(view.address)
        assert view.wait_for_somebody(10)
        onlooker = Onlooker(view, pace=None)
        walk(onlooker)
        onlooker.end("ARRIVED <b>at last</b>")
    page.wait_for_selector("body[data-over]")
    assert page.title() == "A walk"
    assert page.inner_text("#instruction") == "Go <i>left</i>."
    assert page.inner_text("#over") == "ARRIVED <b>at last</b>"
    assert "turn(left)" in page.inner_text("#log")
    assert page.locator("#robot").is_visible()
    assert len(str(page.get_attribute("#path", "points")).split()) > 20
    assert not problems
    found = Axe().run(page, options={"preload": False}).response["violations"]
    assert [(each["id"], each["nodes"][0]["html"]) for each in found] == []
