"""Looking on while a robot drives: in the terminal, as plain lines, or in a browser."""

from memorymaze.results.watching.onlooker import Onlooker, View
from memorymaze.results.watching.present import Present

__all__ = ["Onlooker", "Present", "View"]
