import subprocess
import sys

import gymnasium
import pytest

from memorymaze.gym import ENVIRONMENTS, register_environments


def run(program: str) -> str:
    """Run a program in a fresh interpreter; return what it printed."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "program",
    [
        pytest.param(
            "import gymnasium\n"
            "gymnasium.make('memorymaze:MemoryMaze/University-v0', sensors=())",
            id="by the name of the package",
        ),
        pytest.param(
            "import gymnasium, memorymaze.gym\n"
            "gymnasium.make('MemoryMaze/Museum5F-v0', sensors=())",
            id="after an import",
        ),
        pytest.param(
            "import memorymaze.sites, gymnasium\n"
            "gymnasium.make('memorymaze.gym:MemoryMaze/Museum7F-v0', sensors=())",
            id="by the name of the room",
        ),
    ],
)
def test_gymnasium_finds_the_environments(program: str) -> None:
    run(program)


def test_the_package_alone_does_not_load_gymnasium() -> None:
    said = run("import memorymaze.cli.main, sys\nprint('gymnasium' in sys.modules)")
    assert said == "False\n"


def test_registering_twice_changes_nothing() -> None:
    before = {name: gymnasium.registry[name] for name in ENVIRONMENTS}
    register_environments()
    assert all(gymnasium.registry[name] is spec for name, spec in before.items())


def test_without_gymnasium_it_says_what_to_install() -> None:
    said = run(
        "import sys\nsys.modules['gymnasium'] = None\n"
        "try:\n    import memorymaze.gym\nexcept ImportError as error:\n"
        "    print(error)"
    )
    assert "pip install 'memorymaze[gym]'" in said
