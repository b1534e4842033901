"""A robot to try without a browser: it looks round, follows, waits, and goes away."""

import io
import multiprocessing
import time
from collections.abc import Callable, Generator
from typing import Any

import pytest
from PIL import Image

from memorymaze.runs.episodes.settings import AgentSettings, RunSettings
from memorymaze.web.try_page.sessions import (
    LEAVING,
    PATIENCE,
    NoRobotFree,
    PageVisit,
    Visits,
)
from memorymaze.world.sites import Site

TEXT = "Go to the T and turn left, then go to the end."
ENOUGH = 60.0
"""Seconds in which a process has begun and has done something."""


class Clock:
    """A clock that tests put forward."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture(scope="module")
def clock() -> Clock:
    return Clock()


@pytest.fixture(scope="module")
def visits(clock: Clock) -> Generator[Visits]:
    """One robot for all these tests: to begin a process takes seconds."""
    beside = [AgentSettings("explorer")]
    with Visits(RunSettings(), beside, most=1, clock=clock) as visits:
        yield visits


@pytest.fixture(scope="module")
def the_visit(visits: Visits, t_site: Site) -> PageVisit:
    return visits.begin(t_site, t_site.find_route("R1"), "one")


@pytest.fixture
def visit(visits: Visits, the_visit: PageVisit) -> PageVisit:
    """A visitor whose robot listens."""
    if the_visit.state in {"walking", "away"}:
        visits.stop(the_visit)
    wait_until(visits, the_visit, lambda: the_visit.state in {"ready", "over"})
    return the_visit


def wait_until(
    visits: Visits,
    visit: PageVisit,
    happened: Callable[[], bool],
    *,
    looks: bool = True,
) -> None:
    """Look at a visit, as its page does, until something has happened."""
    deadline = time.monotonic() + ENOUGH
    while not happened():
        assert time.monotonic() < deadline, (visit.state, visit.trouble)
        assert not looks or visits.find(visit.id) is visit
        time.sleep(0.01)


def moved(visit: PageVisit) -> list[list[float]]:
    return [news["robot"] for news in visit.news if "robot" in news]


def overs(visit: PageVisit) -> list[dict[str, Any]]:
    return [news["over"] for news in visit.news if "over" in news]


@pytest.mark.proof
def test_a_robot_looks_round_where_it_starts(visit: PageVisit) -> None:
    strip = Image.open(io.BytesIO(visit.pictures["round"]))
    assert strip.width > 4 * strip.height


def test_a_robot_follows_a_text_and_tells_all_of_it(
    visits: Visits, visit: PageVisit
) -> None:
    visits.change_pace(visit, 30.0, paused=False)
    assert visits.set_out(visit, TEXT)
    assert not visits.set_out(visit, TEXT), "one walk at a time"
    wait_until(visits, visit, lambda: visit.state == "over")
    walk = visit.walk
    news = visits.news_after(visit, walk, 0)["news"]
    steps = next(each["steps"] for each in news if "steps" in each)
    assert steps[0].startswith("turn left")
    assert any("belief" in each for each in news)
    thoughts = [told for each in news for told in each.get("thoughts", [])]
    assert [kind for _, kind, text in thoughts if "We are there" in text] == ["says"]
    guide, explorer = overs(visit)
    assert guide["headline"] == "The robot arrived."
    assert 0 < guide["confidence"] <= 1
    assert explorer["path"].startswith("M")
    camera = Image.open(io.BytesIO(visit.pictures["camera"]))
    assert camera.size == (640, 480)
    known = len(news)
    assert visits.news_after(visit, walk, known)["news"] == []
    assert visits.set_out(visit, TEXT), "the same robot listens again"
    again = visits.news_after(visit, walk, known)
    assert again["walk"] == walk + 1
    assert len(again["news"]) < known


@pytest.mark.proof
def test_a_text_told_before_the_robot_is_ready_is_followed_then(
    visits: Visits, visit: PageVisit
) -> None:
    visits.stop(visit)
    assert visits.set_out(visit, TEXT)
    assert not visits.set_out(visit, "another")
    wait_until(visits, visit, lambda: bool(moved(visit)))
    assert visit.text == TEXT


@pytest.mark.proof
def test_a_paused_robot_stands_and_goes_on(visits: Visits, visit: PageVisit) -> None:
    visits.change_pace(visit, 1.0, paused=False)
    visits.set_out(visit, TEXT)
    wait_until(visits, visit, lambda: len(moved(visit)) > 3)
    visits.change_pace(visit, None, paused=True)
    wait_until(visits, visit, lambda: is_still(visit))
    assert not overs(visit)
    visits.change_pace(visit, 1000.0, paused=False)
    wait_until(visits, visit, lambda: visit.state == "over")
    assert overs(visit)[0]["arrived"]


def is_still(visit: PageVisit) -> bool:
    before = len(visit.news)
    time.sleep(0.5)  # several periods of news
    return len(visit.news) == before


def test_a_stopped_walk_is_over_at_once_and_its_text_is_kept(
    visits: Visits, visit: PageVisit
) -> None:
    visits.change_pace(visit, 1.0, paused=False)
    visits.set_out(visit, TEXT)
    wait_until(visits, visit, lambda: bool(moved(visit)))
    visits.stop(visit)
    assert (visit.state, visit.news, visit.text) == ("opening", [], TEXT)


@pytest.mark.proof
def test_a_closed_page_ends_its_walk_and_frees_the_robot(
    visits: Visits, visit: PageVisit, clock: Clock, t_site: Site
) -> None:
    visits.change_pace(visit, 1.0, paused=False)
    visits.set_out(visit, TEXT)
    wait_until(visits, visit, lambda: bool(moved(visit)))
    begun = set(multiprocessing.active_children())
    route = t_site.find_route("R1")
    with pytest.raises(NoRobotFree, match="try again"):
        visits.begin(t_site, route, "another")
    clock.now += PATIENCE + 1
    wait_until(visits, visit, lambda: visit.state == "away", looks=False)
    assert begun - {*multiprocessing.active_children()}, "its process has ended"
    assert "nobody was watching" in visit.trouble
    other = visits.begin(t_site, route, "another")
    with pytest.raises(NoRobotFree, match="try again"):
        visits.set_out(visit, TEXT)
    third = visits.begin(t_site, route, "another")
    assert other.process is None, "a browser has one robot at a time"
    clock.now += PATIENCE + 1
    wait_until(visits, third, lambda: third.process is None, looks=False)


@pytest.mark.parametrize("again", ["told the way again", "stopped"])
def test_a_robot_on_another_page_of_a_browser_is_put_away_for_one_that_is_asked_again(
    visits: Visits, visit: PageVisit, t_site: Site, again: str
) -> None:
    other = visits.begin(t_site, t_site.find_route("R1"), "one")
    assert visit.process is None
    if again == "stopped":
        visits.stop(visit)
    else:
        assert visits.set_out(visit, TEXT)
    assert visit.process is not None
    assert (other.process, other.state) == (None, "away")
    assert "on another way" in other.trouble


def test_a_page_that_is_loaded_anew_keeps_its_robot_and_a_closed_one_does_not(
    visits: Visits, visit: PageVisit, clock: Clock
) -> None:
    visits.leave(visit)
    clock.now += LEAVING / 2
    assert visits.find(visit.id) is visit, "the page is there again"
    clock.now += LEAVING
    assert visit.process is not None
    visits.leave(visit)
    clock.now += LEAVING + 1
    wait_until(visits, visit, lambda: visit.state == "away", looks=False)


def test_a_robot_that_dies_is_told_of_and_another_takes_the_text_up(
    visits: Visits, visit: PageVisit
) -> None:
    assert visit.process is not None
    visit.process.end()
    wait_until(visits, visit, lambda: visit.state == "away")
    assert visit.trouble
    assert visits.set_out(visit, TEXT)
    assert visit.process is not None
