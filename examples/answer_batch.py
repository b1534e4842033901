"""Answers a batch file of requests with a stand-in for a language model.

    python examples/answer_batch.py requests.jsonl replies.jsonl

It shows what a script that runs a model of your own has to do: for each request take the
messages, have them answered, and write `custom_id` and `reply`. Put your model in the
place of `answer`; this one only picks out the words "left" and "right".
"""

import json
import re
import sys
from pathlib import Path

NAME = "left-and-right"

PROGRAM = """Refined program:
```python
def leave_turning_point():
    here = turning_point_id()
    while here is not None and turning_point_id() == here:
        if move_forward(0.5).reason != "done":
            break


for direction in DIRECTIONS:
    leave_turning_point()
    start = distance_travelled()
    while distance_travelled() - start < 60:
        if direction in detect_turning_point():
            break
        if move_forward(0.5).reason != "done":
            break
    turn(direction)
move_forward(10)
stop()
```
"""


def answer(messages: list[dict[str, str]]) -> str:
    """Return the reply to a conversation."""
    task = messages[-1]["content"]
    if task.startswith("Description:"):
        text = task.split('"""')[1].strip()
        steps = [part.strip() for part in re.split(r"[.!?]\s", text) if part.strip()]
        return "Refined steps:\n" + "\n".join(
            f"{number}. {' '.join(step.split())}"
            for number, step in enumerate(steps, 1)
        )
    directions = re.findall(r"\b(left|right)\b", task.lower())
    return PROGRAM.replace("DIRECTIONS", repr(directions))


def main(requests: Path, replies: Path) -> None:
    """Answer every request of a file."""
    with (
        requests.open(encoding="utf-8") as lines,
        replies.open("w", encoding="utf-8") as file,
    ):
        for line in lines:
            request = json.loads(line)
            messages = request["body"]["messages"]
            said = answer(messages)
            # Count tokens as your model does; words stand in for them here.
            reply = {
                "custom_id": request["custom_id"],
                "model": NAME,
                "reply": said,
                "prompt_tokens": sum(len(each["content"].split()) for each in messages),
                "completion_tokens": len(said.split()),
            }
            file.write(json.dumps(reply) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
