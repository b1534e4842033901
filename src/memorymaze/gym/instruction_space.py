"""The space of instructions, which also survives Gymnasium's shared memory.

`AsyncVectorEnv` takes what `read_from_shared_memory` returns once, when it starts, and
hands out copies of it after every step. That is right for arrays, which are views, but
texts would stay what they were at the start; so texts are looked up anew in each copy.
"""

from collections.abc import Sequence
from typing import Any, overload

from gymnasium.spaces import Text
from gymnasium.vector.utils import read_from_shared_memory


class InstructionSpace(Text):
    """Texts of some characters and up to some length."""


class _LiveTexts(Sequence[str]):
    """The texts that are in the shared memory now; a copy is a tuple of them."""

    def __init__(self, space: InstructionSpace, memory: Any, count: int) -> None:
        """Look at the memory of so many environments."""
        self._space, self._memory, self._count = space, memory, count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[str]: ...
    def __getitem__(self, index: int | slice) -> str | Sequence[str]:
        return self._now()[index]

    def __deepcopy__(self, memo: dict[int, Any]) -> tuple[str, ...]:
        return self._now()

    def _now(self) -> tuple[str, ...]:
        read: Any = read_from_shared_memory.dispatch(Text)
        return read(self._space, self._memory, self._count)


def _read_live(space: InstructionSpace, shared_memory: Any, n: int = 1) -> Any:
    return _LiveTexts(space, shared_memory, n)


read_from_shared_memory.register(InstructionSpace, _read_live)
