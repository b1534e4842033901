import subprocess
import sys

INTERRUPTED_WHILE_LOADING = """
import sys

class CtrlC:
    def find_spec(self, name, *_):
        if name == "memorymaze.front.cli.main":
            raise KeyboardInterrupt

sys.meta_path.insert(0, CtrlC())
from memorymaze.__main__ import main
sys.exit(main())
"""


def test_ctrl_c_while_the_command_is_loaded_is_said_in_one_line() -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED_WHILE_LOADING],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "memorymaze: interrupted\n")
