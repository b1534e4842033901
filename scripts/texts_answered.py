"""Write the shipped instructions that a file of answers is about.

usage: texts_answered.py ANSWERS.jsonl OUT.jsonl
"""

import json
import sys
from pathlib import Path

import memorymaze as mm


def main(answers: str, out: str) -> None:
    """Copy the lines of the shipped file whose ids are answered, in their order."""
    lines = Path(answers).read_text(encoding="utf-8").splitlines()
    wanted = {json.loads(line)["instruction_id"] for line in lines}
    shipped = [
        line
        for path in mm.load_corpus().files
        for line in Path(path).read_text(encoding="utf-8").splitlines()
        if json.loads(line)["id"] in wanted
    ]
    Path(out).write_text("\n".join(shipped) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
