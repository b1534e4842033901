"""Instructions that are made for one run and kept in its folder."""

from pathlib import Path

from memorymaze.durable_files import write_whole
from memorymaze.errors import RunFolderError
from memorymaze.instructions.files import lines
from memorymaze.instructions.line_format import instruction_record
from memorymaze.writing.making import make_instructions
from memorymaze.writing.request import GenerationRequest

GENERATED = "generated.jsonl"
"""In the run folder."""


def instructions_for_run(folder: Path, request: GenerationRequest) -> Path:
    """Make a run's instructions, unless they lie in its folder already.

    Raises:
        RunFolderError: The folder holds a run, or other instructions.
        MemoryMazeError: The request cannot be met.
    """
    made = make_instructions(request)
    content = lines(instruction_record(each) for each in made.instructions)
    path = folder / GENERATED
    try:
        if path.exists():
            if path.read_bytes() != content:
                raise RunFolderError(
                    f"{path}: expected the instructions that these options make, got "
                    "others; use the same options, or choose another folder with --out"
                )
        elif (folder / "run.json").exists():
            raise RunFolderError(
                f"{folder}: holds a run with other instructions; choose another folder "
                "with --out"
            )
        else:
            folder.mkdir(parents=True, exist_ok=True)
            write_whole(path, content)
    except OSError as error:
        reason = error.strerror or error
        raise RunFolderError(f"{path}: cannot be written ({reason})") from None
    return path
