"""Options of `evaluate` that have its instructions made, with known errors."""

import argparse
from pathlib import Path

from memorymaze.cli.agent_options import episode_settings

PER_CELL = 5


def add_error_options(parser: argparse.ArgumentParser) -> None:
    """Add the options as a group of their own."""
    group = parser.add_argument_group("instructions made with known errors")
    group.add_argument(
        "--errors",
        metavar="RATES",
        help="make the instructions for all routes and keep them in the run folder: "
        "published, none, failure=SHARE or KIND=SHARE,… (docs/generation.md); with "
        "--instructions, put errors into their right texts",
    )
    group.add_argument(
        "--per-cell",
        metavar="N",
        type=int,
        help="texts to make per route, study and iteration (default: 5)",
    )
    group.add_argument(
        "--paired",
        action="store_true",
        help="run every text with errors also without them",
    )


def generated_instructions(
    options: argparse.Namespace, folder: Path
) -> list[str] | None:
    """Make the instructions of a run where `--errors` asks for it.

    None stands for the shipped texts.
    """
    from memorymaze.errors import SettingsError

    if options.errors is None:
        for name in ("per_cell", "paired"):
            if getattr(options, name):
                raise SettingsError(
                    f"--{name.replace('_', '-')}: says how instructions are made; add "
                    "--errors RATES, or leave it out"
                )
        return options.instructions
    from memorymaze.evaluation.settings import RunSettings
    from memorymaze.writing import GenerationRequest, parse_rates
    from memorymaze.writing.making import instructions_for_run

    if options.sail is not None:
        raise SettingsError("--errors: SAIL has its own texts; leave out --sail")
    if options.split is not None:
        raise SettingsError("--errors: made texts have no splits; leave out --split")
    if options.paired and options.limit is not None:
        raise SettingsError(
            "--limit: would part pairs; make fewer texts with --per-cell instead"
        )
    request = GenerationRequest(
        sites_folder=options.sites,
        per_cell=PER_CELL if options.per_cell is None else options.per_cell,
        rates=parse_rates(options.errors),
        paired=options.paired,
        seed=episode_settings(options, RunSettings()).seed,
        instruction_files=tuple(options.instructions or ()),
    )
    return [str(instructions_for_run(folder, request))]
