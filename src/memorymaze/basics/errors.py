"""All exceptions a user can meet; each message says what, where and what to do."""

from collections.abc import Iterable
from difflib import get_close_matches


def did_you_mean(name: object, known: Iterable[str], *, cutoff: float = 0.6) -> str:
    """Return the end of a message about an unknown name: the known one most like it.

    >>> did_you_mean("universty", ("university", "museum_5f"))
    "; did you mean 'university'?"

    Args:
        name: What came.
        known: What there is.
        cutoff: How alike the two must be at least, from 0 to 1.

    Returns:
        Empty where nothing is like it.
    """
    near = get_close_matches(str(name), list(known), n=1, cutoff=cutoff)
    return f"; did you mean {near[0]!r}?" if near else ""


class MemoryMazeError(Exception):
    """Base of every error that is the input's fault and not the program's.

    Attributes:
        is_missing: True when a file or folder that was named is not there.
    """

    def __init__(self, message: str = "", *, is_missing: bool = False) -> None:
        """Keep the message, and whether it is about something that is not there."""
        super().__init__(message)
        self.is_missing = is_missing


class SitePlanError(MemoryMazeError):
    """A site plan breaks the format; names file, feature and rule."""


class ImportFileError(MemoryMazeError):
    """A building's file in another format is unusable; names file and feature or line."""


class InstructionFileError(MemoryMazeError):
    """An instruction file or record is unusable; names file and line."""


class InstructionFileWarning(UserWarning):
    """An instruction file has something that is not used; names file and line."""


class PlanFileError(MemoryMazeError):
    """A route plan is unusable; names file and line, and the field."""


class LabelFileError(MemoryMazeError):
    """A file or sheet of labels is unusable; names file and line."""


class LabelFileWarning(UserWarning):
    """A file of labels has something that is not used; names file and line."""


class StudyError(MemoryMazeError):
    """A study file or a study's data are unusable; names file and line, or what to do."""


class SettingsError(MemoryMazeError):
    """A setting or argument has no meaning here; names it and what is allowed."""


class CommandError(MemoryMazeError, ValueError):
    """A command to the robot has an argument without meaning; says what is allowed."""


class AnswerFileError(MemoryMazeError):
    """A file of requests or answers is unusable; names file and line."""


class RunFolderError(MemoryMazeError):
    """A run folder is missing, damaged, or belongs to other settings."""


class RunFolderWarning(UserWarning):
    """A run folder lacks what it should hold; names it and what to do."""


class RenderingError(MemoryMazeError):
    """No picture can be drawn on this machine; says what to install or to set."""


class CaseFileError(MemoryMazeError):
    """A file of metric cases cannot be read; names file and place."""


class UndefinedMetricError(MemoryMazeError):
    """A metric is undefined on this input (empty or disconnected paths)."""


class RobotBodyError(MemoryMazeError):
    """A robot's body cannot be had, or does not do what it is told."""


class DetectorError(MemoryMazeError):
    """A detector or reader of signs did not answer, or its answer cannot be used."""


class LanguageModelError(MemoryMazeError):
    """A language model did not answer, or its answer cannot be used."""


class RecordedAnswersWarning(UserWarning):
    """An answer is not quite what was recorded: to other pictures, or broken off."""


class SpendingLimitReached(MemoryMazeError):
    """A run has spent what it may; what is finished is kept, and it can be resumed."""


class ProgramError(MemoryMazeError):
    """A generated program is wrong or failed.

    Attributes:
        line: 1-based line of the program, or None when no line is to blame.
        unsafe: True when the program reached for something outside the API.
    """

    def __init__(
        self, message: str, *, line: int | None = None, unsafe: bool = False
    ) -> None:
        """Keep the message and what is known beside it."""
        super().__init__(message)
        self.line = line
        self.unsafe = unsafe


class InterpreterLostError(ProgramError):
    """The process that ran a program died, by the program's doing or from outside."""


class EpisodeOver(MemoryMazeError):
    """The episode has ended and the robot takes no more commands.

    Raised by a robot's control API; agents let it pass through.

    Attributes:
        stopped_by: why the episode ended: `agent`, `budget` or `stuck`.
    """

    def __init__(self, stopped_by: str) -> None:
        """Keep why the episode ended."""
        super().__init__(f"the episode is over (stopped by {stopped_by})")
        self.stopped_by = stopped_by
