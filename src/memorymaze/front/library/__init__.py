"""What `import memorymaze` gives: buildings, corpora, walks and runs in a few calls.

Holds thin functions over the rooms below, and the results they return. Does not hold
anything that the command line could not do too: it calls the same functions.
"""

from memorymaze.front.library.runs import Comparison, Run, compare, evaluate, load_run
from memorymaze.front.library.walks import Walk, follow, make_robot

__all__ = [
    "Comparison",
    "Run",
    "Walk",
    "compare",
    "evaluate",
    "follow",
    "load_run",
    "make_robot",
]
