"""Looking on while a robot drives: in the terminal, as plain lines, or in a view of one's own."""

from memorymaze.results.watching.keyboard import check_keyboard, type_answer
from memorymaze.results.watching.onlooker import Onlooker, Present, View, watching

__all__ = [
    "Onlooker",
    "Present",
    "View",
    "check_keyboard",
    "type_answer",
    "watching",
]
