"""`memorymaze`: reads the arguments, calls a verb, and turns errors into messages.

Results go to stdout, progress and messages to stderr. Exit codes: 0 done, which is
what a verb means that returns nothing, 1 failed, 2 wrong usage, as where something is named
that there is not. Verbs import what they need when they run, so that help comes at once.
"""

import argparse
import io
import os
import sys
import traceback
import warnings
from collections.abc import Sequence

from memorymaze import __version__
from memorymaze.basics.errors import (
    InstructionFileWarning,
    MemoryMazeError,
    SettingsError,
)
from memorymaze.front.cli import (
    agents,
    answers,
    benchmark,
    compare,
    dataset,
    doctor,
    evaluate,
    instructions,
    navigate,
    replay,
    report,
    runs,
    score,
    settings,
    sites,
    study,
    table,
    try_page,
)
from memorymaze.front.cli.verbs import VerbParser

DONE, FAILED, WRONG_USAGE = 0, 1, 2


def run_command_line(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Arguments are without the program's name; those of this process when None.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    options = command_line().parse_args(arguments)
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("always", category=InstructionFileWarning)
            warnings.showwarning = _show_warning
            return options.run(options) or DONE
    except MemoryMazeError as error:
        _explain(error, options.debug)
        wrong = isinstance(error, SettingsError) or error.is_missing
        return WRONG_USAGE if wrong else FAILED
    except KeyboardInterrupt:
        _say("interrupted")
        return FAILED
    except BrokenPipeError:
        # The reader (such as `head`) has seen enough; spare Python's own complaint.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except (FileNotFoundError, NotADirectoryError) as error:
        _explain(error, options.debug)
        return WRONG_USAGE
    except (OSError, MemoryError) as error:
        _explain(error, options.debug)
        return FAILED
    except Exception as error:
        _explain(error, options.debug)
        _say("this is a fault of memorymaze; with --debug it shows where it happened")
        return FAILED


def command_line() -> argparse.ArgumentParser:
    """Return what reads the arguments."""
    parser = argparse.ArgumentParser(
        prog="memorymaze",
        description="Test guide robots that follow route instructions given from "
        "memory, in simulated public buildings.",
        epilog="example: memorymaze evaluate --agent guide --out runs/guide && "
        "memorymaze table runs/guide",
    )
    parser.add_argument(
        "--version", action="version", version=f"memorymaze {__version__}"
    )
    parser.add_argument(
        "--debug", action="store_true", help="show where in the code an error arose"
    )
    verbs = parser.add_subparsers(
        title="verbs", metavar="VERB", required=True, parser_class=VerbParser
    )
    for verb in (
        navigate,
        try_page,
        benchmark,
        evaluate,
        table,
        compare,
        report,
        runs,
        score,
        instructions,
        sites,
        dataset,
        agents,
        settings,
        answers,
        replay,
        study,
        doctor,
    ):
        verb.add_parser(verbs)
    return parser


def _explain(error: BaseException, debug: bool) -> None:
    if debug:
        traceback.print_exception(error)
    match error:
        case MemoryMazeError():
            _say(str(error))
        case OSError(filename=file, strerror=reason) if file and reason:
            _say(f"{file}: cannot be read or written ({reason})")
        case MemoryError():
            _say(f"not enough memory: {str(error) or 'no more could be had'}")
        case _:
            _say(f"{type(error).__name__}: {error}")


def _say(text: str) -> None:
    print(f"memorymaze: {text}", file=sys.stderr)


def _show_warning(message: Warning | str, *_: object) -> None:
    _say(f"note: {message}")
