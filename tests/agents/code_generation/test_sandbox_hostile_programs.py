"""Broken and hostile programs: each ends its episode as it should, reaching nothing."""

import os
import time
from dataclasses import replace
from pathlib import Path

import pytest

from memorymaze.agents.code_generation.sandbox import ProgramLimits, run_program
from memorymaze.basics.errors import EpisodeOver, ProgramError
from memorymaze.basics.failures import LINE_LENGTH

LIMITS = ProgramLimits(memory=32 * 2**20)
IMPATIENT = ProgramLimits(computing_time=0.25, memory=32 * 2**20)


def ending(program: str, robot, limits: ProgramLimits = LIMITS):
    """Run a program: why the episode ended, and the line where a program is at fault."""
    try:
        run_program(program, robot, limits)
    except EpisodeOver as over:
        return over.stopped_by
    except ProgramError as error:
        return ("unsafe" if error.unsafe else "crash", error.line)
    return "agent"


UNSAFE = {
    "reads a file": ("say(open('/etc/hostname').read())", 1),
    "opens a file in a with": ("with open('x') as f:\n    say(f.read())", 1),
    "hides the opening in a try": (
        "try:\n    open('x', 'w')\nexcept BaseException:\n    pass",
        2,
    ),
    "reads a path": (
        "from pathlib import Path\nsay(Path('/etc/hostname').read_text())",
        2,
    ),
    "asks whether a path exists": ("import os.path\nos.path.exists('/etc')", 2),
    "lists a folder": ("import os\nsay(str(os.listdir('/')))", 2),
    "reads the environment": ("import os\nsay(str(os.environ))", 2),
    "reads one variable": ("import os\nsay(str(os.getenv('HOME')))", 2),
    "starts a command": ("import os\nos.system('true')", 2),
    "imports a function of os": ("from os import system\nsystem('true')", 1),
    "imports subprocess": ("import subprocess", 1),
    "imports a socket": ("move_forward(1)\nimport socket", 2),
    "imports behind a try": (
        "try:\n    import ctypes\nexcept ImportError:\n    pass",
        2,
    ),
    "imports the real builtins": ("import builtins\nbuiltins.open('x')", 2),
    "imports a library": ("import numpy as np\nmove_forward(np.pi)", 1),
    "imports by name": ("__import__('os').system('true')", 1),
    "looks for loaded modules": ("import sys\nsys.modules['os']", 2),
    "evaluates text": ("eval('move_forward(1)')", 1),
    "executes text behind a try": (
        "try:\n    exec('import os')\nexcept BaseException:\n    pass\nmove_forward(1)",
        2,
    ),
    "evaluates with the checker silenced": ("[eval][0]('1')  # type: ignore", 1),
    "evaluates by another spelling": ("\uff45\uff56\uff41\uff4c('1')", 1),
    "evaluates through sorted": ("sorted(['1'], key=eval)", 1),
    "compiles text": ("compile('1', 'x', 'eval')", 1),
    "takes the globals": ("say(str(globals()))", 1),
    "takes the builtins": ("__builtins__['open']('x')", 1),
    "climbs to all classes": ("().__class__.__bases__[0].__subclasses__()", 1),
    "spells a class out": ("\nx = getattr((), '__cl' + 'ass__')", 2),
    "formats its way to a class": ("say('{0.__class__.__mro__}'.format(1))", 1),
    "climbs from a result": ("move_forward(1).__class__.__init__.__globals__", 1),
    "climbs from an API function": ("say.__globals__['robot']", 1),
    "looks behind an API function": ("move_forward.__self__", 1),
}


@pytest.mark.parametrize(("program", "line"), UNSAFE.values(), ids=UNSAFE)
def test_reaching_outside_the_api_is_unsafe(program, line, robot):
    assert ending(program, robot) == ("unsafe", line)


CRASHES = {
    "is prose": ("Go straight, then turn left.", 1),
    "is cut off": ("while True:\n    move_forward(", 2),
    "is badly indented": ("if True:\nmove_forward(1)", 2),
    "returns outside a function": ("move_forward(1)\nreturn", 2),
    "has a null character": ("x = 1\x00", 1),
    "has half a character": ("x = 1\ny = '\ud800'", 2),
    "nests too deeply": ("x = " + "(" * 9_000 + ")" * 9_000, None),
    "has a million characters": ("x = 1\n" * 170_000, None),
    "uses an unknown name": ("move_forward(1)\ngo_to('library')", 2),
    "uses an unknown attribute": ("r = move_forward(1)\nsay(r.why)", 2),
    "takes a result for a dict": ("say(detect_from_RGB_image('door')[0]['label'])", 1),
    "takes a result for a number": ("if move_forward(1) < 1:\n    stop()", 1),
    "gives no argument": ("move_forward()", 1),
    "gives too many arguments": ("turn('left', 90)", 1),
    "names an unknown parameter": ("turn(angle=90)", 1),
    "moves a text": ("move_forward('5 m')", 1),
    "moves nothing": ("move_forward(None)", 1),
    "moves what is nothing at run time": ("move_forward(turning_point_id())", 1),
    "moves a truth": ("move_forward(True)", 1),
    "moves not a number": ("move_forward(float('nan'))", 1),
    "moves infinitely": ("move_forward(float('inf'))", 1),
    "moves too large an integer": ("move_forward(10**400)", 1),
    "moves backwards": ("\nmove_forward(-1)", 2),
    "turns by a number": ("turn(90)", 1),
    "turns to a list": ("turn(detect_turning_point())", 1),
    "says a huge text": ("say('x' * 100_000)", 1),
    "says a list in itself": ("x = []\nx.append(x)\nsay(*x)", 3),
    "waits for a call": ("await move_forward(1)", 1),
    "makes a generator": (
        "def f():\n    yield 1\nfor x in f():\n    move_forward(x)",
        2,
    ),
    "calls the API back": ("max([1, 2], key=lambda d: move_forward(d).distance)", 1),
    "divides by zero": ("x = 0\nmove_forward(1 / x)", 2),
    "looks at what is not there": ("say(detect_from_RGB_image('door')[5].label)", 1),
    "recurses for ever": ("def f(n):\n    return f(n + 1)\nf(0)", 2),
    "recurses in a lambda": ("f = lambda: f()\nf()", 1),
    "fills the memory with a list": ("x = [0]\nwhile True:\n    x += x", 3),
    "asks for a huge text": ("x = 'a' * 10**12", 1),
    "asks for a huge number": ("x = 9**9**9", 1),
    "fills the memory and goes on": (
        "x = []\nwhile True:\n    try:\n        x.append('a' * 10**6)\n"
        "    except MemoryError:\n        pass",
        4,
    ),
    "asks for a huge padding": ("say(f'{1:>999999999}')", 1),
    "fails an assertion": ("assert move_forward(50).reason == 'done'", 1),
    "raises a time-out of its own": (
        "raise TimeoutError('feed time limit exceeded')",
        1,
    ),
    "raises a key press": ("move_forward(1)\nraise KeyboardInterrupt", 2),
    "asks the user": ("x = input('which way?')", 1),
    "breaks the interpreter": ("class A:\n    pass\nsay(*[A, A()])", None),
}


@pytest.mark.parametrize(("program", "line"), CRASHES.values(), ids=CRASHES)
def test_a_wrong_or_failing_program_crashes_with_its_line(program, line, robot):
    assert ending(program, robot) == ("crash", line)


ENDLESS = {
    "computes": "while True:\n    pass",
    "catches everything": (
        "while True:\n    try:\n        while True:\n            pass\n"
        "    except BaseException:\n        pass"
    ),
    "recurses without end": (
        "def f():\n    try:\n        f()\n    finally:\n        f()\nf()"
    ),
    "prints": "while True:\n    print('spam' * 1000)",
    "waits for the clock": "import time\nwhile time.time() < 10**10:\n    pass",
    "sleeps": "import time\nwhile True:\n    time.sleep(1000)",
    "counts in one step": "sum(range(10**12))",
    "confuses the type checker": (
        "x = None\nwhile turning_point_id():\n"
        + "".join(f"    if turning_point_id(): x = (x, {n})\n" for n in range(300))
    ),
}


@pytest.mark.parametrize("program", ENDLESS.values(), ids=ENDLESS)
def test_endless_computing_ends_as_budget(program, robot):
    assert ending(program, robot, IMPATIENT) == "budget"


ENDLESS_CALLS = {
    "moves": "while True:\n    move_forward(0.5)",
    "looks": "while not detect_from_RGB_image('door')[0].distance < 1:\n    pass",
    "talks": "while True:\n    say('hello')",
    "catches the end": (
        "while True:\n    try:\n        move_forward(1)\n"
        "    except BaseException:\n        pass\n    finally:\n        turn('left')"
    ),
    "goes on after refusals": (
        "while True:\n    try:\n        say('a', 'b')  # type: ignore\n"
        "    except TypeError:\n        move_forward(1)"
    ),
}


@pytest.mark.parametrize("program", ENDLESS_CALLS.values(), ids=ENDLESS_CALLS)
def test_endless_calls_end_with_the_robots_budget(program, robot):
    assert ending(program, robot) == "budget"
    assert len(robot.calls) == 200


def test_endless_calls_end_even_where_the_robot_has_no_budget(make_robot):
    robot = make_robot(call_budget=10**9)

    assert (
        ending("while True:\n    say('x')", robot, ProgramLimits(calls=50)) == "budget"
    )
    assert len(robot.calls) == 50


def test_endless_refused_calls_end_as_budget_too(robot):
    program = "while True:\n    try:\n        say(1)  # type: ignore\n    except TypeError:\n        pass"

    assert ending(program, robot, ProgramLimits(calls=50)) == "budget"
    assert robot.calls == []


HANDED_OVER = {
    "texts": "say(s)",
    "names of arguments": "move_forward(1, **{s: 1})  # type: ignore",
}


@pytest.mark.parametrize("call", HANDED_OVER.values(), ids=HANDED_OVER)
def test_handing_over_without_end_what_is_refused_ends_as_budget(call, robot):
    program = (
        "s = 'x' * 4_000_000\nwhile True:\n    try:\n"
        f"        {call}\n    except (TypeError, ValueError):\n        pass"
    )
    limits = replace(IMPATIENT, calls=2_000)
    told: list[dict[str, object]] = []

    with pytest.raises(EpisodeOver) as over:
        run_program(program, robot, limits, told.append)

    refused = [each for each in told if each["kind"] == "refused_call"]
    assert over.value.stopped_by == "budget"
    assert 0 < len(refused) < limits.calls
    assert max(len(str(each["message"])) for each in refused) <= LINE_LENGTH
    assert robot.calls == []


AFTER_THE_STOP = {
    "simply goes on": "stop()\nmove_forward(1)",
    "catches everything": "try:\n    stop()\nexcept BaseException:\n    move_forward(1)",
    "has a finally": "try:\n    stop()\nfinally:\n    move_forward(1)",
    "returns in the finally": (
        "def f():\n    try:\n        stop()\n    finally:\n        return move_forward(1)\nf()"
    ),
    "has a context": (
        "class C:\n    def __enter__(self):\n        pass\n"
        "    def __exit__(self, *a):\n        move_forward(1)\n        return True\n"
        "with C():\n    stop()\nmove_forward(1)"
    ),
}


@pytest.mark.parametrize("program", AFTER_THE_STOP.values(), ids=AFTER_THE_STOP)
def test_nothing_follows_a_stop(program, robot):
    assert ending(program, robot) == "agent"
    assert robot.names == ["stop"]


HARMLESS = {
    "is empty": ("", []),
    "is only comments": ("# go left\n\n# stop", []),
    "is only a docstring": ('"""Walk."""', []),
    "exits": ("move_forward(1)\nexit()\nmove_forward(1)", ["move_forward"]),
    "exits by raising": ("say('bye')\nraise SystemExit('lost')", ["say"]),
    "redefines a function": (
        "def move_forward(d):\n    say(str(d))\nmove_forward(1)",
        ["say"],
    ),
    "redefines the stop": ("def stop():\n    pass\nstop()\nsay('on')", ["say"]),
    "hides a function": ("move_forward = lambda d: d\nmove_forward(1)", []),
    "uses names of other alphabets": (
        "лево, 左 = 'left', 2\nturn(лево)\nmove_forward(左)",
        ["turn", "move_forward"],
    ),
    "is asynchronous": (
        "import asyncio\nasync def go():\n    move_forward(1)\n"
        "    await asyncio.sleep(60)\nasyncio.run(go())",
        ["move_forward"],
    ),
    "recovers from a refusal": (
        "try:\n    move_forward(-1)\nexcept ValueError:\n    move_forward(1)",
        ["move_forward", "move_forward"],
    ),
    "prints much": ("print('x' * 10**6)\nsay('done')", ["say"]),
    "backtracks in a pattern": (
        "import re\nre.match(r'(a|aa)+$', 'a' * 60 + 'b')\nsay('done')",
        ["say"],
    ),
    "is nested in data": ("x = ()\nfor i in range(50_000):\n    x = (x,)\nx", []),
}


@pytest.mark.parametrize(("program", "calls"), HARMLESS.values(), ids=HARMLESS)
def test_odd_but_harmless_programs_end_normally(program, calls, robot):
    assert ending(program, robot) == "agent"
    assert robot.names == calls


def test_files_and_secrets_stay_where_they_are(robot, tmp_path: Path, monkeypatch):
    canary = tmp_path / "canary.txt"
    canary.write_text("alive", encoding="utf-8")
    monkeypatch.setenv("CANARY", "secret")
    for attack in (
        f"open({str(canary)!r}, 'w').write('dead')",
        f"from pathlib import Path\nPath({str(canary)!r}).write_text('dead')",
        f"from pathlib import Path\nPath({str(canary)!r}).unlink()",
        f"import os\nos.rename({str(canary)!r}, {str(tmp_path / 'gone')!r})",
        f"from pathlib import Path\nsay(Path({str(canary)!r}).read_text())",
        "import os\nsay(os.environ['CANARY'])",
        "import os\nsay(os.getenv('CANARY', ''))",
    ):
        assert ending(attack, robot)[0] == "unsafe"

    assert [path.name for path in tmp_path.iterdir()] == ["canary.txt"]
    assert canary.read_text(encoding="utf-8") == "alive"
    assert os.environ["CANARY"] == "secret"
    assert robot.calls == []


def test_shared_structure_is_not_unfolded_on_the_way_out(robot):
    program = (
        "x = [0] * 1000\ny = [x] * 1000\nz = [y] * 1000\n"
        "try:\n    say(z)  # type: ignore\nexcept TypeError as error:\n    say(str(error))"
    )

    assert ending(program, robot) == "agent"
    assert robot.calls == [("say", "say(): text must be text, not list")]


def test_the_clock_stands_still_and_chance_is_the_same_each_time(make_robot):
    program = "import random, time\nsay(f'{time.time()} {random.random()}')"
    robots = [make_robot(), make_robot()]
    for robot in robots:
        run_program(program, robot)
        time.sleep(0.002)

    assert robots[0].calls == robots[1].calls
