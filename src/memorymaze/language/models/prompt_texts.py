"""The prompts: text files in `prompts/`, with slots in braces and capitals."""

import hashlib
import re
from collections.abc import Iterable
from importlib.resources import files

_SLOT = re.compile(r"\{([A-Z_]+)\}")


def load_prompt(name: str, **slots: str) -> str:
    """Return a prompt with its slots filled.

    A slot that is left unfilled raises `KeyError`.
    """
    text = (
        (files("memorymaze.language.models") / "prompts" / f"{name}.txt")
        .read_text(encoding="utf-8")
        .strip()
    )
    return _SLOT.sub(lambda slot: slots[slot[1].lower()], text)


def prompt_version(*texts: str) -> str:
    """Return the version of a prompt: a digest of what it says whatever is asked."""
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:12]


def numbered(steps: Iterable[str]) -> str:
    """Return steps as models write them and are given them, one a line."""
    return "\n".join(f"{number}. {step}" for number, step in enumerate(steps, 1))
