"""What people said: instructions, their files, and the corpora made of them.

Holds records, files and their checks, another corpus (`sail`), and counts of words. Other
benchmarks' formats are in `exchange`, who runs on a corpus is in `runs`, how texts are read
and made up in `reading` and `writing`.
"""

from memorymaze.texts.corpus.corpus import episodes, load_corpus
from memorymaze.texts.corpus.files import (
    BUILTIN_CORPUS,
    load_instructions,
    write_instructions,
)
from memorymaze.texts.corpus.records import (
    Corpus,
    Episode,
    Failure,
    Followers,
    Instruction,
    Span,
)

__all__ = [
    "BUILTIN_CORPUS",
    "Corpus",
    "Episode",
    "Failure",
    "Followers",
    "Instruction",
    "Span",
    "episodes",
    "load_corpus",
    "load_instructions",
    "write_instructions",
]
