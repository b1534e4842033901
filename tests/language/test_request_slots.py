"""Never more requests under way than a server is to get."""

import subprocess
import sys
from pathlib import Path

SCRIPT = """
import os, sys
from pathlib import Path
from memorymaze.language.model import CompletionRequest, Message
from memorymaze.language.request_slots import QueuedModel
from memorymaze.language.scripted_model import ScriptedLanguageModel

me, folder, places = sys.argv[1], Path(sys.argv[2]), int(sys.argv[3])

def answer(request):
    mine = folder / f"asking-{me}"
    mine.touch()
    under_way = len(list(folder.glob("asking-*")))
    mine.unlink()
    if me == "dies" :
        os._exit(7)
    return str(under_way)

model = QueuedModel(ScriptedLanguageModel(answer), folder / "requests.lock", places)
for number in range(40):
    print(model.complete(CompletionRequest((Message("user", "?"),))).text)
"""


def ask(names: list[str], folder: Path, places: int) -> list[list[str]]:
    running = [
        subprocess.Popen(
            [sys.executable, "-c", SCRIPT, name, str(folder), str(places)],
            stdout=subprocess.PIPE,
            text=True,
        )
        for name in names
    ]
    return [process.communicate(timeout=60)[0].split() for process in running]


def test_processes_take_turns(tmp_path: Path) -> None:
    said = ask(["a", "b", "c"], tmp_path, places=1)
    assert said == [["1"] * 40] * 3


def test_a_process_that_dies_gives_its_place_back(tmp_path: Path) -> None:
    assert ask(["dies"], tmp_path, places=1) == [[]]
    assert ask(["lives"], tmp_path, places=1) == [["1"] * 40]
