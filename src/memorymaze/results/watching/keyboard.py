"""A question to a passer-by in the terminal, where somebody types the answer."""

import sys
import termios

from memorymaze.errors import SettingsError
from memorymaze.passers_by import Briefing
from memorymaze.wording import printable


def check_keyboard() -> None:
    """Refuse to ask where nobody could type.

    Raises:
        SettingsError: Input or messages of this process are no terminal.
    """
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        raise SettingsError(
            "passers_by=keyboard: expected a terminal in which you are asked and type "
            "your answers, got none; leave the option out, or run it in a terminal"
        )


def type_answer(briefing: Briefing) -> str:
    """Show a question and what is true of it; return what is typed.

    An empty line, or the end of the input, is no answer.
    """
    if sys.stdin.isatty():
        # What was typed while the robot drove is no answer.
        termios.tcflush(sys.stdin, termios.TCIFLUSH)
    lines = [
        "",
        "The robot asks you, a passer-by:",
        f"  “{briefing.question}”",
        "What is true, which the robot does not see:",
        *(f"  {fact}" for fact in briefing.facts),
    ]
    print(printable("\n".join(lines)), file=sys.stderr)
    prompt = "Your answer (an empty line: I don't know): "
    print(prompt, end="", file=sys.stderr, flush=True)
    return sys.stdin.readline()
