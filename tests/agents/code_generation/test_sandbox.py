"""Programs drive the robot, and what happens in them comes out in order."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from memorymaze.agents.code_generation.sandbox import ProgramLimits, run_program
from memorymaze.basics.errors import (
    EpisodeOver,
    InterpreterLostError,
    ProgramError,
    SettingsError,
)
from memorymaze.basics.failures import LINE_LENGTH


def test_a_program_drives_the_robot(robot):
    program = """
def walk_until(seen, limit=30):
    start = distance_travelled()
    while not seen() and distance_travelled() - start < limit:
        result = move_forward(0.5)
        if result.reason == "wall":
            return False
    return True

found = walk_until(lambda: turning_point_id() is not None)
if found and "left" in detect_turning_point():
    result = turn("left")
    say(f"{result.message}, {result.angle_deg:.0f} degrees")
stop()
"""

    with pytest.raises(EpisodeOver) as over:
        run_program(program, robot)

    assert over.value.stopped_by == "agent"
    assert robot.names.count("move_forward") == 10
    assert ("say", "turned left, 90 degrees") in robot.calls
    assert robot.names[-1] == "stop"


def test_results_have_the_records_attributes(robot):
    run_program(
        """
first, second = detect_from_RGB_image("door")
say(f"{first.label} {first.box} {first.score} {first.distance} {first.bearing_deg}")
say(str(len({first, second, first})) + str({first.track_id, second.track_id}))
say(str(first == detect_from_RGB_image("door")[0]))
moved = move_forward(25)
say(f"{moved.distance} {moved.reason} {moved.reason == 'wall'}")
say(str(turn("right").turned) + str(turning_point_id()) + str(say("x")))
""",
        robot,
    )

    said = [text for name, text in robot.calls if name == "say"]
    assert said == [
        "door (0.0, 1.0, 2.0, 3.0) 0.9 2.0 10.0",
        "2{1, 2}",
        "True",
        "20.0 wall True",
        "x",
        "False1None",
    ]


def test_results_cannot_be_changed(robot):
    with pytest.raises(ProgramError, match="line 2"):
        run_program("r = move_forward(1)\nr.distance = 5.0", robot)


def test_a_program_may_end_without_a_stop(robot):
    run_program("move_forward(1)", robot)

    assert robot.names == ["move_forward"]


def test_a_stop_ends_the_program_even_if_the_robot_lets_it_pass(robot, monkeypatch):
    monkeypatch.setattr(robot, "stop", lambda: None)

    with pytest.raises(EpisodeOver, match="agent"):
        run_program("stop()\nmove_forward(1)", robot)

    assert robot.calls == []


def test_why_the_robot_ends_the_episode_passes_through(robot, monkeypatch):
    def get_stuck(distance: float):
        raise EpisodeOver("stuck")

    monkeypatch.setattr(robot, "move_forward", get_stuck)

    with pytest.raises(EpisodeOver, match="stuck"):
        run_program("try:\n    move_forward(1)\nexcept Exception:\n    pass", robot)


def test_a_mistake_of_the_robots_is_not_blamed_on_the_program(robot, monkeypatch):
    def break_down(distance: float):
        raise KeyError("a bug")

    monkeypatch.setattr(robot, "move_forward", break_down)

    with pytest.raises(KeyError, match="a bug"):
        run_program("try:\n    move_forward(1)\nexcept Exception:\n    pass", robot)


def test_a_result_outside_the_api_is_the_robots_mistake(robot, monkeypatch):
    monkeypatch.setattr(robot, "say", lambda text: object())

    with pytest.raises(TypeError, match="a robot returned object"):
        run_program("say('x')", robot)


def test_printing_is_told_before_the_call_that_follows_it(robot, monkeypatch):
    told: list[object] = []
    monkeypatch.setattr(robot, "say", lambda text: told.append(text))

    run_program(
        "print('a', 1)\nprint('b')\nsay('c')\nprint('d')", robot, on_event=told.append
    )

    assert told == [
        {"kind": "print", "text": "a 1\nb\n"},
        "c",
        {"kind": "print", "text": "d\n"},
    ]


def test_printing_survives_a_crash_and_is_cut_at_its_limit(robot):
    told: list[dict[str, object]] = []

    with pytest.raises(ProgramError):
        run_program(
            "print('x' * 90)\nprint('y' * 90)\nprint('z')\n1 / 0",
            robot,
            ProgramLimits(printed_characters=100),
            told.append,
        )

    assert told == [
        {
            "kind": "print",
            "text": "x" * 90
            + "\n"
            + "y" * 9
            + "\n[printing beyond 100 characters is dropped]\n",
        }
    ]


def test_refused_arguments_are_told_and_raised_in_the_program(robot):
    told: list[dict[str, object]] = []
    program = """
for bad in (-1, float("nan")):
    try:
        move_forward(bad)
    except ValueError as error:
        say(str(error))
"""

    run_program(program, robot, on_event=told.append)

    messages = [
        "expected a distance greater than 0, got -1.0",
        "move_forward(): distance must be a finite number, not nan",
    ]
    assert [text for name, text in robot.calls if name == "say"] == messages
    assert told == [
        {"kind": "refused_call", "line": 4, "call": "move_forward", "message": message}
        for message in messages
    ]


def test_careless_but_working_programs_run_with_their_doubts_told(robot):
    told: list[dict[str, object]] = []
    program = """
nearest: Detection = None
steps: int = 5.5
move_forward(steps)
for door in detect_from_RGB_image("door"):
    if nearest is None or door.distance < nearest.distance:
        nearest = door
say(nearest.label)
direction = detect_turning_point()[0] if detect_turning_point() else None
turn(direction)
if turning_point_id() != 3:
    say(str(getattr(nearest, "score", 0)))
def count(number: int) -> bool:
    move_forward(number)
count(0.5)
"""

    run_program(program, robot, on_event=told.append)

    assert robot.calls[-1] == ("move_forward", 0.5)
    (doubts,) = told
    assert doubts["kind"] == "doubts"
    assert "line 3" in str(doubts["doubts"])
    assert ("turn", "left") in robot.calls


def test_a_crash_names_the_line_of_the_call_inside_a_function(robot):
    program = "def go(d):\n    move_forward(1)\n    move_forward(d)\n\ngo(1)\ngo(-1)"

    with pytest.raises(ProgramError, match=r"^line 3: ValueError: expected") as e:
        run_program(program, robot)

    assert e.value.line == 3
    assert len(robot.calls) == 4


def test_messages_are_one_line(robot):
    with pytest.raises(ProgramError) as caught:
        run_program("x = 3\nassert x == 4, 'first\\nsecond'", robot)

    assert str(caught.value) == "line 2: AssertionError: first"


@pytest.mark.parametrize(
    "failing", ["raise ValueError('lost ' + s)", "getattr((), f'__{s}__')"]
)
def test_of_a_long_message_the_beginning_is_told(robot, failing):
    with pytest.raises(ProgramError) as caught:
        run_program(f"s = 'x' * 400_000\n{failing}", robot)

    assert "xxx" in str(caught.value)
    assert len(str(caught.value)) < LINE_LENGTH + 100


def workers() -> set[int]:
    """Process ids of this process's interpreters."""
    found: set[int] = set()
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            pid, is_monty, rest = stat.read_text(encoding="utf-8").partition(
                " (monty) "
            )
            if is_monty and int(rest.split()[1]) == os.getpid():
                found.add(int(pid))
    return found


def state_of(pid: int) -> str:
    """Running, sleeping, sTopped, Zombie as the system says it; "" when gone."""
    with contextlib.suppress(FileNotFoundError, ProcessLookupError):
        stat = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8")
        return stat.rpartition(") ")[2][0]
    return ""


@pytest.mark.parametrize(
    ("how", "outcome", "limits"),
    [
        (signal.SIGKILL, InterpreterLostError, ProgramLimits()),
        (signal.SIGSTOP, EpisodeOver, ProgramLimits(computing_time=0.2)),
        (signal.SIGTERM, KeyboardInterrupt, ProgramLimits()),
    ],
    ids=["killed", "hanging", "ended from outside"],
)
def test_a_worker_that_dies_or_hangs_ends_only_its_own_program(
    how, outcome, limits, robot, monkeypatch
):
    def harm(text: str) -> None:
        for pid in workers():
            os.kill(pid, how)
            while state_of(pid) in {"R", "S"}:
                time.sleep(0.001)

    monkeypatch.setattr(robot, "say", harm)

    with pytest.raises(outcome):
        run_program("say('x')\nmove_forward(1)", robot, limits)
    run_program("move_forward(1)", robot)

    assert robot.names == ["move_forward"]


def test_an_interrupt_of_all_processes_is_for_the_host_to_handle():
    done = run_script(
        """
import os, signal
from memorymaze.agents.code_generation.sandbox import run_program

class Walker:
    def say(self, text):
        os.killpg(0, signal.SIGINT)
    def stop(self):
        print("stopped")

os.setpgid(0, 0)
signal.signal(signal.SIGINT, lambda *_: print("interrupted"))
try:
    run_program("say('x'); stop()", Walker())
except Exception as error:
    print(error)
"""
    )

    assert done.stderr == ""
    assert done.stdout.splitlines() == [
        "interrupted",
        "stopped",
        "the episode is over (stopped by agent)",
    ]


def run_script(script: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-W", "ignore", "-c", script],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


TALK_IN_A_FORK = """
import multiprocessing
from memorymaze.basics.errors import SettingsError
from memorymaze.agents.code_generation.sandbox import run_program

class Talker:
    def say(self, text):
        print(text, flush=True)

def talk(text):
    try:
        run_program(f"say('{text}')", Talker())
    except SettingsError as error:
        print(error, flush=True)

def talk_in_child(text):
    child = multiprocessing.get_context("fork").Process(target=talk, args=(text,))
    child.start()
    child.join(20)
    assert child.exitcode == 0, child.exitcode
"""


def test_forked_processes_have_workers_of_their_own():
    done = run_script(
        TALK_IN_A_FORK + "talk_in_child('one')\ntalk_in_child('two')\ntalk('parent')"
    )

    assert done.stderr == ""
    assert done.stdout.split() == ["one", "two", "parent"]


def test_a_process_forked_after_its_parent_used_the_sandbox_is_told_so():
    done = run_script(
        TALK_IN_A_FORK + "talk('parent')\ntalk_in_child('child')\ntalk('again')"
    )

    assert done.stderr == ""
    parent, child, again = done.stdout.splitlines()
    assert (parent, again) == ("parent", "again")
    assert "start worker processes with multiprocessing's spawn method" in child


def test_a_killed_process_leaves_no_worker_behind():
    script = """
import os, signal
from memorymaze.agents.code_generation.sandbox import run_program

class Dying:
    def say(self, text):
        for stat in os.listdir("/proc"):
            try:
                text = open(f"/proc/{stat}/stat").read()
            except OSError:
                continue
            if "(monty)" in text and text.split()[3] == str(os.getpid()):
                print(stat, flush=True)
        os.kill(os.getpid(), signal.SIGKILL)

run_program("say('x')", Dying())
"""
    done = run_script(script)

    assert done.returncode == -signal.SIGKILL
    (worker,) = done.stdout.split()
    deadline = time.monotonic() + 10
    while Path(f"/proc/{worker}/exe").exists() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not Path(f"/proc/{worker}/exe").exists()


def test_limits_must_be_positive():
    with pytest.raises(SettingsError, match="memory must be greater than 0, not 0"):
        ProgramLimits(memory=0)
    with pytest.raises(SettingsError, match="computing_time must be at most 60 s"):
        ProgramLimits(computing_time=1e9)


@pytest.mark.parametrize(
    ("program", "line", "unsafe", "said"),
    [
        ("say('a')\nmove_forward('2 m')", 2, False, "line 2: Argument to function"),
        ("  x = 1", 1, False, "Unexpected indentation"),
        ("turn('left'", 1, False, "invalid-syntax"),
        ("say('a')\n\nimport numpy", 3, True, "line 3: Cannot resolve"),
        ("open('/etc/passwd')", 1, True, "`open`"),
        ("walk()", 1, False, "`walk` used when not defined"),
        ("a" * 11, None, False, "has 11 characters; at most 10"),
    ],
)
def test_what_is_wrong_to_begin_with_is_refused_before_the_robot_moves(
    program: str, line: int | None, unsafe: bool, said: str, robot
) -> None:
    limits = ProgramLimits(program_characters=max(10, 0 if line is None else 100))
    with pytest.raises(ProgramError, match=said) as caught:
        run_program(program, robot, limits)
    assert (caught.value.line, caught.value.unsafe) == (line, unsafe)
    assert robot.calls == []


def test_doubts_are_told_with_their_line(robot) -> None:
    told: list[dict[str, object]] = []
    run_program("say('a')\nx: int = 'a'", robot, on_event=told.append)
    assert [each["doubts"] for each in told] == [
        ['line 2: Object of type `Literal["a"]` is not assignable to `int`']
    ]
