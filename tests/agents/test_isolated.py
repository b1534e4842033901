from pathlib import Path

import pytest

import memorymaze as mm
from memorymaze.errors import SettingsError

AGENT = """
from pathlib import Path

class Mine:
    name = "mine"

    def follow(self, instruction, robot, journal, rng):
        {line}
        journal.note("seen", words=len(instruction.split()))
        robot.move_forward(8.0)
"""


def _walk(tmp_path: Path, site: Path, line: str, **choices: object) -> mm.Walk:
    path = tmp_path / "own.py"
    path.write_text(AGENT.format(line=line), encoding="utf-8")
    return mm.follow("Eight metres ahead.", f"{path}:Mine", site=site, **choices)


@pytest.fixture
def corridor(tiny_sites_folder: Path) -> Path:
    return tiny_sites_folder / "corridor.geojson"


def test_an_isolated_agent_walks_as_it_would_otherwise(
    tmp_path: Path, corridor: Path
) -> None:
    line = "robot.turn_by(-90); robot.turn_by(90); rng.random()"
    here = _walk(tmp_path, corridor, line)
    apart = _walk(tmp_path, corridor, line, isolate=True)
    assert apart.trace == here.trace
    assert apart.success == here.success
    assert any(entry.get("words") == 3 for entry in apart.trace)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        pytest.param("import memorymaze.sites", "cannot load the rooms", id="rooms"),
        pytest.param(
            "import memorymaze; memorymaze.load_site", "cannot load", id="front door"
        ),
        pytest.param("open({plan!r})", "cannot read plans", id="plan"),
        pytest.param("robot.scene", "has no 'scene': agents get", id="scene"),
        pytest.param("1 / 0", "ZeroDivisionError: division by zero", id="fault"),
        pytest.param("raise SystemExit(3)", "the agent's process ended", id="exit"),
    ],
)
def test_an_isolated_agent_gets_no_answers_and_its_faults_are_told(
    tmp_path: Path, corridor: Path, line: str, said: str
) -> None:
    walk = _walk(tmp_path, corridor, line.format(plan=str(corridor)), isolate=True)
    assert walk.stopped_by == "crash"
    assert said in str(walk.result.error)


def test_a_budget_that_runs_out_ends_an_isolated_agent(
    tmp_path: Path, corridor: Path
) -> None:
    line = "[robot.move_forward(0.1) for _ in range(9)]"
    walk = _walk(tmp_path, corridor, line, isolate=True, call_budget=5)
    assert walk.stopped_by == "budget"


def test_an_agent_of_a_script_can_be_isolated_too(corridor: Path) -> None:
    class Ahead:
        name = "ahead"

        def follow(self, instruction, robot, journal, rng) -> None:
            robot.move_forward(8.0)

    walk = mm.follow("Go.", Ahead(), site=corridor, isolate=True)
    assert walk.stopped_by == "agent"
    assert walk.result.path_length > 7


def test_what_needs_the_answers_cannot_be_isolated(corridor: Path) -> None:
    with pytest.raises(SettingsError, match="needs the answers"):
        mm.follow("Go.", "oracle", site=corridor, isolate=True)
