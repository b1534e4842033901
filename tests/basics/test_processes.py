"""Processes that are started from whatever program is running."""

import subprocess
import sys
from pathlib import Path

PARENT = """
import multiprocessing, os, signal, sys, time
from memorymaze.basics.processes import die_with_parent, main_left_out

def work(connection):
    die_with_parent()
    connection.send("up")
    time.sleep(600)

if __name__ == "__main__":
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    context.Process(target=work, args=(theirs,)).start()
    ours.recv()
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_process_ends_with_the_one_that_started_it(tmp_path: Path) -> None:
    script = tmp_path / "parent.py"
    script.write_text(PARENT)
    # Its output ends when the last process that could write to it has ended.
    done = subprocess.run(
        [sys.executable, str(script)], stdout=subprocess.PIPE, timeout=120, check=False
    )
    assert done.returncode == -9
    assert done.stdout == b""
