import json
from collections.abc import Callable
from pathlib import Path

import pytest

import memorymaze as mm
from memorymaze.basics.errors import SettingsError
from memorymaze.language.models.spending import TokenPrice
from memorymaze.world.construction import BuildingKind

AGENT = """
from pathlib import Path

class Mine:
    name = "mine"

    def follow(self, instruction, robot, journal, rng):
        {line}
        journal.note("seen", words=len(instruction.split()))
        robot.move_forward(8.0)
"""


def _walk(tmp_path: Path, site: mm.Site, line: str, **choices: object) -> mm.Walk:
    path = tmp_path / "own.py"
    path.write_text(AGENT.format(line=line), encoding="utf-8")
    return mm.follow("Eight metres ahead.", f"{path}:Mine", site=site, **choices)


def test_an_isolated_agent_walks_as_it_would_otherwise(
    tmp_path: Path, corridor_site: mm.Site
) -> None:
    line = "robot.turn_by(-90); robot.turn_by(90); rng.random()"
    here = _walk(tmp_path, corridor_site, line)
    apart = _walk(tmp_path, corridor_site, line, isolate=True)
    assert apart.trace == here.trace
    assert apart.success == here.success
    assert any(entry.get("words") == 3 for entry in apart.trace)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        pytest.param(
            "import memorymaze.world.sites", "cannot load the rooms", id="rooms"
        ),
        pytest.param(
            "import memorymaze; memorymaze.load_site", "cannot load", id="front door"
        ),
        pytest.param("open({plan!r})", "cannot read plans", id="plan"),
        pytest.param(
            "import os; os.link({plan!r}, 'copy')", "cannot read plans", id="link"
        ),
        pytest.param(
            "import os; open(f'/proc/{{os.getppid()}}/mem')",
            "cannot read plans",
            id="memory",
        ),
        pytest.param("robot.scene", "has no 'scene': agents get", id="scene"),
        pytest.param("1 / 0", "ZeroDivisionError: division by zero", id="fault"),
        pytest.param("raise SystemExit(3)", "the agent's process ended", id="exit"),
    ],
)
def test_an_isolated_agent_gets_no_answers_and_its_faults_are_told(
    tmp_path: Path, corridor_site: mm.Site, line: str, said: str
) -> None:
    walk = _walk(
        tmp_path, corridor_site, line.format(plan=corridor_site.source), isolate=True
    )
    assert walk.stopped_by == "crash"
    assert said in str(walk.result.error)


@pytest.mark.parametrize(
    ("place", "shard"),
    [
        pytest.param("run/instructions.jsonl.gz", None, id="instructions"),
        pytest.param("run/plans/corridor.geojson.gz", None, id="plans"),
        pytest.param("run/episodes.jsonl", None, id="results"),
        pytest.param("run/part-2-of-6/plans/loop.geojson.gz", "1/6", id="another part"),
        pytest.param("texts.jsonl", None, id="corpus"),
    ],
)
def test_an_isolated_agent_reads_neither_the_run_nor_its_corpus(
    tmp_path: Path,
    tiny_instructions: Path,
    tiny_sites_folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    place: str,
    shard: str | None,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("texts.jsonl").write_bytes(tiny_instructions.read_bytes())
    line = f"open({str(tmp_path / place)!r})"
    Path("own.py").write_text(AGENT.format(line=line), encoding="utf-8")
    run = mm.evaluate(
        "own.py:Mine",
        mm.load_corpus("texts.jsonl", sites=tiny_sites_folder),
        out="run",
        isolate=True,
        workers=1,
        limit=2 if shard is None else 6,
        shard=shard,
    )
    assert all("cannot read plans, corpora" in str(one.error) for one in run.results)


def test_in_a_made_building_an_isolated_agent_reads_files_of_its_own(
    tmp_path: Path,
    made_building: Callable[[BuildingKind], mm.Site],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    site = made_building("office")
    way = site.routes[0].id
    walk = _walk(tmp_path, site, "open('own.py').close()", route=way, isolate=True)
    assert walk.result.error is None


def test_named_arguments_of_an_isolated_agent_arrive_by_their_names(
    tmp_path: Path, corridor_site: mm.Site
) -> None:
    line = "picture = robot.camera_picture(height=24, width=32); picture.rgb[23, 31]"
    walk = _walk(tmp_path, corridor_site, line, isolate=True)
    assert walk.stopped_by == "agent"


def test_an_isolated_agent_cannot_ask_for_what_stands_behind_the_robot(
    tmp_path: Path, corridor_site: mm.Site
) -> None:
    line = (
        "pipe = robot._FarRobot__connection; "
        "pipe.send(('call', ('__reduce_ex__', (2,), {}))); raise pipe.recv()[1]"
    )
    walk = _walk(tmp_path, corridor_site, line, isolate=True)
    assert "a robot has no '__reduce_ex__'" in str(walk.result.error)


def test_what_an_episode_left_unsaid_does_not_reach_the_next(
    tmp_path: Path, tiny_corpus: mm.Corpus
) -> None:
    path = tmp_path / "own.py"
    line = "robot._FarRobot__connection.send(5) if rng.integers(2) else None"
    path.write_text(AGENT.format(line=line), encoding="utf-8")
    run = mm.evaluate(
        f"{path}:Mine", tiny_corpus, out=tmp_path / "run", isolate=True, workers=1
    )
    ends = [(each.stopped_by, bool(each.error)) for each in run.results]
    assert set(ends) == {("agent", False), ("crash", True)}
    assert all("got int" in each.error for each in run.results if each.error)


def test_a_budget_that_runs_out_ends_an_isolated_agent(
    tmp_path: Path, corridor_site: mm.Site
) -> None:
    line = "[robot.move_forward(0.1) for _ in range(9)]"
    walk = _walk(tmp_path, corridor_site, line, isolate=True, call_budget=5)
    assert walk.stopped_by == "budget"


def test_an_agent_of_a_script_can_be_isolated_too(corridor_site: mm.Site) -> None:
    class Ahead:
        name = "ahead"

        def follow(self, instruction, robot, journal, rng) -> None:
            robot.move_forward(8.0)

    walk = mm.follow("Go.", Ahead(), site=corridor_site, isolate=True)
    assert walk.stopped_by == "agent"
    assert walk.result.path_length > 7


def test_what_needs_the_answers_cannot_be_isolated(corridor_site: mm.Site) -> None:
    with pytest.raises(SettingsError, match="needs the answers"):
        mm.follow("Go.", "oracle", site=corridor_site, isolate=True)


ASKER = """
from memorymaze.language.models.model import CompletionRequest, Message, ModelQuestion

class Asker:
    name = "asker"
    needs = {"language_model"}

    def __init__(self, model):
        self.model = model

    def follow(self, instruction, robot, journal, rng):
        said = CompletionRequest((Message("user", instruction),), question=QUESTION)
        robot.move_forward(float(journal.ask(self.model, said, "metres")))

QUESTION = ModelQuestion("metres", "1")
"""


def test_an_isolated_agent_asks_the_model_of_the_run(
    tmp_path: Path, corridor_site: mm.Site
) -> None:
    path, answers = tmp_path / "asker.py", tmp_path / "answers.jsonl"
    path.write_text(ASKER, encoding="utf-8")
    told = {"stage": "metres", "reply": "6", "model": "m", "prompt_tokens": 100}

    def walk(name: str, *, isolate: bool) -> mm.Walk:
        answers.write_text(json.dumps({"instruction_id": name, **told}))
        model = mm.ModelSettings(replay=str(answers), price=TokenPrice(1000, 0))
        return mm.follow(
            "Six metres.",
            f"{path}:Asker",
            site=corridor_site,
            isolate=isolate,
            language_model=model,
        )

    way = corridor_site.routes[0].id
    here, apart = (walk(f"corridor-{way}", isolate=each) for each in (False, True))
    assert apart.trace == here.trace
    assert apart.result.path_length == pytest.approx(6.0, abs=0.1)
    assert (apart.result.model_calls, apart.result.cost_usd) == (1, 0.1)
    lost = walk("another", isolate=True)
    assert lost.stopped_by == "model_error"
    assert f"is recorded for metres of 'corridor-{way}'" in str(lost.result.error)
