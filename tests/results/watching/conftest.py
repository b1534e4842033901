"""A walk on a tiny site, watched or not, and moments of it."""

from collections.abc import Callable

import pytest

from memorymaze.evaluation.episode import EpisodeRun, Watcher
from memorymaze.evaluation.navigation import navigate
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.geometry.pose import Pose
from memorymaze.results.story.events import Event
from memorymaze.results.story.understanding import CurrentStep
from memorymaze.results.watching import Present
from memorymaze.sites import Site

TEXT = "Go to the T and turn left."


@pytest.fixture
def walk(t_site: Site) -> Callable[..., EpisodeRun]:
    """Let `rules` follow a text on the T, with someone watching or not."""

    def run(watcher: Watcher | None = None) -> EpisodeRun:
        route = t_site.reference_route("R1")
        return navigate(t_site, route, TEXT, AgentSettings("rules"), watcher=watcher)

    return run


@pytest.fixture
def present() -> Present:
    """A robot five metres before the T, that looks north."""
    return Present(
        time=4.0,
        pose=Pose(0.0, -5.0, 1.57),
        path=[(0.0, -8.0), (0.0, -7.0), (0.0, -6.0)],
        distance=3.0,
        step=CurrentStep("Step 1 of 2", ("turn left",), 0),
        events=[Event(3.0, "say", "say(Hello <b>you</b>)", 0)],
        fresh=[Event(3.0, "say", "say(Hello <b>you</b>)", 0)],
        people={"person_1": Pose(0.0, -2.0, 0.0)},
        things={},
    )
