"""Tiny sites, instructions, runs and a browser that the tests of every room share."""

import gc
import json
import math
import os
import shutil
import signal
from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack
from dataclasses import replace
from functools import cache
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any, get_args

import pytest
from hypothesis import settings as property_settings
from hypothesis import strategies as st

# Each worker of pytest has a core; threads of linear algebra, which count cores when it is
# first imported, would wait for each other.
os.environ.setdefault("OMP_NUM_THREADS", "1")

from memorymaze.basics.errors import CommandError, EpisodeOver
from memorymaze.basics.input_files import FileStamp
from memorymaze.language.plans import (
    Arrival,
    Junction,
    Kind,
    Leg,
    Length,
    Mention,
    Passing,
    Place,
    RoutePlan,
    Side,
    Start,
    Totals,
    Turn,
    Unit,
    Way,
)
from memorymaze.robot.api.control import (
    Detection,
    Direction,
    MoveResult,
    SignText,
    TurnResult,
)
from memorymaze.robot.api.specification import api_specification
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import RunPlan, plan_run
from memorymaze.runs.episodes.provenance import CodeStamp
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import (
    AgentSettings,
    RunDefinition,
    RunSettings,
)
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder
from memorymaze.texts.corpus import Corpus, load_corpus
from memorymaze.world.construction import BuildingKind, make_building
from memorymaze.world.sites import Site, load_site, load_sites

# What a script starts in the background ignores Ctrl-C, and so would servers under test.
signal.signal(signal.SIGINT, signal.default_int_handler)

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

# How long an example takes says more of the machine than of the code; each run of the
# tests draws other examples. `make proof` draws many: --hypothesis-profile=thorough.
property_settings.register_profile("quick", deadline=None, max_examples=12)
property_settings.register_profile("thorough", deadline=None, max_examples=250)
property_settings.load_profile("quick")

# What is imported while tests are collected stays: it is no garbage to look through.
gc.disable()


def pytest_collection_finish() -> None:
    """Look for garbage from here on, now and then, among what the tests themselves make."""
    gc.freeze()
    gc.set_threshold(10_000)
    gc.enable()


Plan = dict[str, Any]

TINY_SITES = Path(__file__).parent / "tiny_sites"
TINY_INSTRUCTIONS = Path(__file__).parent / "tiny_instructions.jsonl"


BROWSERS = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="session")
def browser() -> "Generator[Browser]":
    """The Chromium that is installed on this machine."""
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        pytest.fail(
            "these tests look at pages in Chromium, and none is installed; type: "
            "sudo apt-get install chromium (scripts/setup_browser.sh does it)"
        )
    arguments = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(
            executable_path=path, headless=True, args=arguments
        )
        yield chromium
        chromium.close()


@pytest.fixture(scope="session")
def complaints() -> "Callable[[Page], list[str]]":
    """What axe finds in a page as it is, and whether one must scroll it sideways.

    axe is a script of its own, which the pages' policy would keep out: the page's context
    is made with `bypass_csp=True`.
    """
    from axe_playwright_python.sync_playwright import Axe

    def found(page: "Page") -> list[str]:
        broken = Axe().run(page, options={"preload": False}).response["violations"]
        complaints = [f"{each['id']}: {each['nodes'][0]['html']}" for each in broken]
        wide = page.evaluate("document.documentElement.scrollWidth")
        size = page.viewport_size
        assert size is not None
        if wide > size["width"]:
            complaints.append(f"{wide} pixels wide")
        return [f"{page.title()}: {each}" for each in complaints]

    return found


ChatServer = Callable[..., tuple[str, list[dict[str, Any]]]]


@pytest.fixture
def chat_server() -> Generator[ChatServer]:
    """Serve an OpenAI-compatible model: `chat_server(reply, model="m", tokens=(9, 1))`.

    It says what `reply` makes of a request. What comes back are the server's address, and
    the requests it has had.
    """
    with ExitStack() as servers:

        def serve(
            reply: Callable[[dict[str, Any]], str], model: str, tokens: tuple[int, int]
        ) -> tuple[str, list[dict[str, Any]]]:
            requests: list[dict[str, Any]] = []

            class Handler(BaseHTTPRequestHandler):
                def do_POST(self) -> None:
                    length = int(self.headers["content-length"])
                    requests.append(json.loads(self.rfile.read(length)))
                    message = {"role": "assistant", "content": reply(requests[-1])}
                    usage = dict(
                        zip(("prompt_tokens", "completion_tokens"), tokens, strict=True)
                    )
                    answer = {"model": model, "choices": [{"message": message}]}
                    body = json.dumps(answer | {"usage": usage}).encode()
                    self.send_response(200)
                    self.send_header("content-type", "application/json")
                    self.send_header("content-length", str(len(body)))
                    self.end_headers()
                    self.wfile.write(body)

                def log_message(self, format: str, *args: object) -> None:
                    """Keep quiet."""

            http = servers.enter_context(ThreadingHTTPServer(("127.0.0.1", 0), Handler))
            thread = Thread(target=http.serve_forever, args=(0.01,))
            thread.start()
            servers.callback(thread.join)
            servers.callback(http.shutdown)
            return f"http://127.0.0.1:{http.server_port}/v1", requests

        yield serve


@pytest.fixture(scope="session")
def tiny_sites_folder() -> Path:
    """Folder with the plans of all tiny sites."""
    return TINY_SITES


@pytest.fixture(scope="session")
def tiny_instructions() -> Path:
    """File of twelve instructions on three tiny sites."""
    return TINY_INSTRUCTIONS


@pytest.fixture(scope="session")
def tiny_corpus() -> Corpus:
    """Those instructions on those sites."""
    return load_corpus([TINY_INSTRUCTIONS], sites=TINY_SITES)


@pytest.fixture(scope="session")
def tiny_files() -> list[str]:
    """What the command line is given to follow them."""
    return ["--instructions", str(TINY_INSTRUCTIONS), "--sites", str(TINY_SITES)]


@pytest.fixture(scope="session")
def tiny_sites() -> dict[str, Site]:
    """All tiny sites by name."""
    return load_sites(TINY_SITES)


@pytest.fixture(scope="session")
def builtin_sites() -> dict[str, Site]:
    """The three floors of the benchmark by name."""
    return load_sites()


@pytest.fixture(scope="session")
def made_building() -> Callable[[BuildingKind], Site]:
    """Buildings that no one built, one of each kind, made once."""
    return _made_building


@cache
def _made_building(kind: BuildingKind) -> Site:
    return make_building(kind, 2)


@pytest.fixture(scope="session")
def corridor_site() -> Site:
    """One straight corridor, 20 m by 3 m along y = 0, no turning point.

    Four equal doors on the north side at x = 3, 7.5, 12, 16.5; a bench on the south
    side at x = 10. R1 runs from (2, 0) to the fourth door.
    """
    return load_site(TINY_SITES / "corridor.geojson")


@pytest.fixture(scope="session")
def l_site() -> Site:
    """East along y = 0, then a corner at (11, 0) that leaves only a left turn."""
    return load_site(TINY_SITES / "l_shape.geojson")


@pytest.fixture(scope="session")
def t_site() -> Site:
    """North along x = 0 to a T junction at (0, 0): R1 goes left, R2 right."""
    return load_site(TINY_SITES / "t_junction.geojson")


@pytest.fixture(scope="session")
def crossing_site() -> Site:
    """Two corridors that cross at (0, 0): R1 comes from the west and turns left."""
    return load_site(TINY_SITES / "crossing.geojson")


@pytest.fixture(scope="session")
def slanted_crossing_site() -> Site:
    """Ways west, east and south of (0, 0), and one at 50 degrees that R1 takes."""
    return load_site(TINY_SITES / "slanted_crossing.geojson")


@pytest.fixture(scope="session")
def two_rooms() -> Site:
    """Two halls, 6 m by 6 m, joined by a passage along y = 3; areas, no T or corner."""
    return load_site(TINY_SITES / "two_rooms.geojson")


@pytest.fixture(scope="session")
def loop_site() -> Site:
    """Four corridors round a block: R1 has a short reference and a long alternative."""
    return load_site(TINY_SITES / "loop.geojson")


@pytest.fixture(scope="session")
def scenes(tiny_sites: dict[str, Site]) -> dict[str, Scene]:
    """Scenes of all tiny sites by name."""
    return {name: build_scene(site) for name, site in tiny_sites.items()}


@pytest.fixture(scope="session")
def plan_texts(tiny_sites_folder: Path) -> dict[str, str]:
    """Contents of the tiny plans by name."""
    return {
        path.stem: path.read_text(encoding="utf-8")
        for path in sorted(tiny_sites_folder.glob("*.geojson"))
    }


@pytest.fixture
def plan(plan_texts: dict[str, str]) -> Callable[[str], Plan]:
    """Return a fresh copy of a tiny plan as parsed JSON."""
    return lambda name: json.loads(plan_texts[name])


@pytest.fixture
def write_plan(tmp_path: Path) -> Callable[..., Path]:
    """Write a plan to a file and return the path."""

    def write(content: Plan, stem: str = "changed") -> Path:
        path = tmp_path / f"{stem}.geojson"
        path.write_text(json.dumps(content), encoding="utf-8")
        return path

    return write


@pytest.fixture
def changed(
    plan: Callable[[str], Plan], write_plan: Callable[..., Path]
) -> Callable[[str, str, dict[str, Any]], Path]:
    """Change a tiny plan, write it under its own name, and return the path.

    Changes are values by dotted path inside the feature, or inside the plan where the
    feature is `-`; `...` removes a member.
    """

    def write(name: str, feature: str, changes: dict[str, Any]) -> Path:
        content = plan(name)
        for dotted, value in changes.items():
            target = content if feature == "-" else _feature(content, feature)
            *steps, last = (
                int(step) if step.isdecimal() else step for step in dotted.split(".")
            )
            for step in steps:
                target = target[step]
            if value is ...:
                del target[last]
            else:
                target[last] = value
        return write_plan(content, name)

    return write


@pytest.fixture
def enlarged(
    plan: Callable[[str], Plan], write_plan: Callable[..., Path]
) -> Callable[[float], Path]:
    """Write the plan of `l_shape` with all its positions multiplied, and return the path."""

    def write(factor: float) -> Path:
        content = plan("l_shape")
        for feature in content["features"]:
            geometry = feature["geometry"]
            geometry["coordinates"] = _times(geometry["coordinates"], factor)
        return write_plan(content, "l_shape")

    return write


def _times(coordinates: Any, factor: float) -> Any:
    if isinstance(coordinates, list):
        return [_times(each, factor) for each in coordinates]
    return coordinates * factor


def _feature(content: Plan, identity: str) -> Plan:
    return next(each for each in content["features"] if each["id"] == identity)


@pytest.fixture(scope="session")
def api_says() -> Callable[[str], None]:
    """Ties a test to a sentence of the control API: whoever changes one sees the other."""
    lines = api_specification().splitlines()
    whole = " ".join(" ".join(line.removeprefix("#") for line in lines).split())

    def says(sentence: str) -> None:
        assert sentence in whole

    return says


@pytest.fixture(scope="session")
def any_plans() -> st.SearchStrategy[RoutePlan]:
    """Plans of all kinds, also such as nobody would tell."""
    things = ["door", "drinking fountain", "sign that says Library", "2nd floor"]
    words = st.text(min_size=1).filter(str.strip) | st.sampled_from(things)
    ordinals = st.none() | st.just(-1) | st.integers(1, 10**6)
    doubts = st.floats(0, 1)
    metres = st.floats(0, 1e308)
    sides = st.none() | st.sampled_from(get_args(Side))
    lengths = st.none() | st.builds(
        Length, metres, st.sampled_from(get_args(Unit)), st.none() | st.floats(0.5, 99)
    )
    mentions = st.lists(
        st.builds(
            Mention,
            words,
            st.sampled_from(get_args(Kind)),
            st.sampled_from(get_args(Place)),
            sides,
            ordinals,
            st.none() | metres,
            st.booleans(),
            doubts,
        ),
        max_size=2,
    ).map(tuple)
    passings = st.lists(
        st.builds(
            Passing,
            st.none() | st.integers(1, 10**6),
            st.none() | st.sampled_from(["left", "right"]),
            st.none() | words,
        ),
        max_size=2,
    ).map(tuple)
    several = st.lists(words, max_size=2).map(tuple)
    turns = st.builds(
        Turn,
        st.sampled_from(get_args(Way)),
        ordinals,
        ordinals,
        st.none() | words,
        st.booleans(),
        st.none() | st.sampled_from(get_args(Junction)),
        st.booleans(),
        st.booleans(),
        doubts,
    )
    legs = st.builds(
        Leg, turns, st.booleans(), lengths, mentions, passings, several, several, doubts
    )
    arrivals = st.builds(
        Arrival,
        several,
        sides,
        ordinals,
        st.booleans(),
        lengths,
        mentions,
        passings,
        several,
        several,
        st.booleans(),
        doubts,
        doubts,
        st.lists(doubts, max_size=2).map(tuple),
    )
    return st.builds(
        RoutePlan,
        st.builds(Start, st.none() | words, st.none() | words),
        st.lists(legs, max_size=3).map(tuple),
        arrivals,
        st.builds(Totals, st.none() | st.integers(0, 99), st.none() | metres),
    )


class PaperRobot:
    """Records its calls; from 5 m on it is in a junction, at 20 m is a wall."""

    def __init__(self, call_budget: int = 200) -> None:
        self.calls: list[tuple[str, object]] = []
        self._call_budget = call_budget
        self._distance = 0.0

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.calls]

    def _record(self, name: str, argument: object = None) -> None:
        if len(self.calls) >= self._call_budget:
            raise EpisodeOver("budget")
        self.calls.append((name, argument))

    def move_forward(self, distance: float) -> MoveResult:
        self._record("move_forward", distance)
        if not (math.isfinite(distance) and distance > 0):
            raise CommandError(f"expected a distance greater than 0, got {distance}")
        moved = min(distance, 20 - self._distance)
        self._distance += moved
        return MoveResult(moved, "done" if moved == distance else "wall")

    def detect_turning_point(self) -> list[Direction]:
        self._record("detect_turning_point")
        return ["left", "forward"] if self._distance >= 5 else []

    def turning_point_id(self) -> int | None:
        self._record("turning_point_id")
        return 1 if self._distance >= 5 else None

    def turn(self, direction: str) -> TurnResult:
        self._record("turn", direction)
        if direction == "left":
            return TurnResult(True, 90.0, "turned left")
        return TurnResult(False, 0.0, f"no way {direction}")

    def turn_by(self, degrees: float) -> TurnResult:
        self._record("turn_by", degrees)
        return TurnResult(True, degrees, "turned")

    def detect_from_RGB_image(self, object: str) -> list[Detection]:
        self._record("detect_from_RGB_image", object)
        return [
            Detection("door", (0.0, 1.0, 2.0, 3.0), 0.9, 2.0, 10.0, 1),
            Detection("door", (4.0, 1.0, 6.0, 3.0), 0.8, 3.0, -10.0, 2),
        ]

    def read_signs(self) -> list[SignText]:
        self._record("read_signs")
        return [SignText("Library", 3.0, 5.0, 1)]

    def say(self, text: str) -> None:
        self._record("say", text)

    def distance_travelled(self) -> float:
        self._record("distance_travelled")
        return self._distance

    def stop(self) -> None:
        self._record("stop")
        raise EpisodeOver("agent")


@pytest.fixture
def make_paper_robot() -> Callable[..., PaperRobot]:
    """Makes robots for programs to drive, which live nowhere and record their calls."""
    return PaperRobot


@pytest.fixture
def result() -> Callable[..., EpisodeResult]:
    """Make the result of a successful episode; name the fields that differ."""

    def make(episode_id: str = "a-1", **changes: Any) -> EpisodeResult:
        right = EpisodeResult(
            episode_id=episode_id,
            instruction_id=episode_id,
            site="university",
            route="R1",
            reference_route="route_r1_reference",
            study="online",
            iteration=1,
            participant=episode_id.split("-")[0],
            source="llm",
            split="test",
            agent="guide",
            stopped_by="agent",
            success=True,
            oracle_success=True,
            spd=1.0,
            cls=0.5,
            spl=0.9,
            ndtw=0.8,
            sdtw=0.8,
            path_length=41.5,
            way_m=40.0,
            collisions=0,
            turns_in_order=1.0,
            duration_s=60.0,
            wall_s=0.5,
            api_calls=20,
            model_calls=0,
            tokens=0,
            cost_usd=0.0,
            error=None,
        )
        return replace(right, **changes)

    return make


@pytest.fixture
def settings() -> RunDefinition:
    """Settings of a run of two episodes."""
    return RunDefinition(
        agent=AgentSettings("guide"),
        instructions=(FileStamp("some.jsonl", "12ab"),),
        sites=(FileStamp("university", "34cd"),),
        seed=0,
        limit=None,
        episodes=2,
        success_distance=3.0,
        simulation=SimulationSettings(time_budget=529.0),
    )


@pytest.fixture
def record(settings: RunDefinition) -> RunRecord:
    """What `run.json` says of that run."""
    code = CodeStamp("0.1.0", "56ef", "0123456789abcdef", "3.11.0", {"numpy": "2.4"})
    return RunRecord(settings, code, "2026-01-01T00:00:00+00:00")


@pytest.fixture
def tiny_plan(tiny_corpus: Corpus) -> Callable[..., RunPlan]:
    """Plan a run of twelve instructions on three tiny sites."""

    def plan(agent: str, **options: Any) -> RunPlan:
        return plan_run(
            AgentSettings(agent),
            tiny_corpus,
            with_choices(RunSettings(), options),
        )

    return plan


@pytest.fixture
def write(tmp_path: Path, record: RunRecord) -> Callable[..., Path]:
    """Write a finished run folder."""

    def finished(
        name: str, results: Sequence[EpisodeResult], episodes: int = 0
    ) -> Path:
        settings = replace(record.settings, episodes=episodes or len(results))
        whole = replace(record, settings=settings)
        with open_run_folder(tmp_path / name, whole, resume=False) as run:
            for one in results:
                run.add(one)
        return tmp_path / name

    return finished
