"""`memorymaze evaluate`: run an agent on instructions, into a run folder."""

import argparse
import contextlib
import functools
import shlex
import sys
from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from memorymaze.basics.extras import command_here
from memorymaze.basics.wording import counted
from memorymaze.front.cli.agent_options import (
    add_agent_name,
    add_agent_options,
    add_episode_options,
    agent_settings,
    episode_settings,
    given_settings,
)
from memorymaze.front.cli.flags import add_flags
from memorymaze.front.cli.verbs import Verbs, add_corpus_options, given_path

if TYPE_CHECKING:
    from memorymaze.runs.episodes.plan import RunPlan
    from memorymaze.runs.work.worker_pool import Workforce


def add_parser(verbs: Verbs) -> None:
    """Add the verb to the command line."""
    verbs.add_parser(
        "evaluate",
        help="run an agent on many instructions",
        description="Run an agent on instructions and keep every result in a folder. "
        "A run that was broken off, however that came, goes on with --resume.",
        epilog="example: memorymaze evaluate --agent guide --limit 24 --out runs/look",
        options=_add_options,
    )


def _add_options(parser: argparse.ArgumentParser) -> None:
    from memorymaze.runs.episodes.settings import RunSettings

    parser.usage = "%(prog)s (--agent NAME | --suite FILE) [OPTION …]"
    what = parser.add_mutually_exclusive_group(required=True)
    add_agent_name(what.add_argument, default=None)
    add_flags(parser.add_argument, RunSettings, ["limit"])
    parser.add_argument(
        "--out",
        metavar="DIR",
        type=given_path,
        help="run folder (default: runs/AGENT-TIME)",
    )
    parser.add_argument(
        "--resume",
        action="store_true",
        help="finish the run in --out, or begin it",
    )
    parser.add_argument(
        "--workers",
        metavar="N",
        type=int,
        default=0,
        help="processes (default: 0, one per core)",
    )
    parser.add_argument(
        "--ray",
        metavar="ADDRESS",
        help="workers on a Ray cluster (docs/runs.md)",
    )
    what.add_argument(
        "--suite",
        metavar="FILE",
        type=given_path,
        help="several runs and their tables, as a file says (docs/command_line.md)",
    )
    followed = parser.add_argument_group("what is followed")
    add_corpus_options(followed)
    add_flags(followed.add_argument, RunSettings, ["split"])
    add_agent_options(parser)
    add_episode_options(parser)
    parser.set_defaults(run=_run)


def _run(options: argparse.Namespace) -> int | None:
    from memorymaze.basics.errors import SettingsError
    from memorymaze.basics.processes import start_server

    if options.workers < 0:
        raise SettingsError(
            f"--workers: expected 0 (one per core) or more, got {options.workers}"
        )
    if options.resume and options.out is None:
        raise SettingsError("--resume: name the run's folder with --out")
    if options.ray is None:
        # It imports all that episodes need, while the texts are read here.
        start_server("memorymaze.runs.work.episode_worker")
    return (
        _evaluate_agent(options) if options.suite is None else _evaluate_suite(options)
    )


def _evaluate_agent(options: argparse.Namespace) -> None:
    from memorymaze.front.library.runs import default_folder, evaluate
    from memorymaze.runs.episodes.in_words import crash_lines, result_lines
    from memorymaze.runs.episodes.plan import settings_for
    from memorymaze.texts.corpus import load_corpus

    out: Path = options.out or default_folder(options.agent)
    agent = agent_settings(options)
    corpus = load_corpus(options.instructions, sites=options.sites)
    settings = episode_settings(options, settings_for(corpus))
    with _working(options, out) as how:
        run = evaluate(agent, corpus, out=out, settings=settings, **how)
    print(f"run {run.folder}")
    if run.results:
        print("\n".join(result_lines(run.record.settings, run.results)))
    else:
        print("no episode falls to this shard")
    for line in crash_lines(run.folder, run.results, whole=options.debug):
        print(line, file=sys.stderr)
    shard = run.record.settings.shard
    when = "" if shard is None else f", when all {shard.of} parts are there"
    print(f"tables{when}: {command_here()} table {shlex.quote(str(out))}")


def _evaluate_suite(options: argparse.Namespace) -> int:
    from memorymaze.basics.durable_files import write_whole
    from memorymaze.basics.errors import MemoryMazeError, SettingsError
    from memorymaze.basics.tables import write_tables
    from memorymaze.front.library.runs import default_folder
    from memorymaze.front.library.suites import read_suite, run_suite
    from memorymaze.runs.tables import load_runs

    for option in ("set", "instructions", "sites"):
        if getattr(options, option):
            raise SettingsError(
                f"--{option}: stands in the file of a suite; leave it out"
            )
    suite = read_suite(options.suite)
    out: Path = options.out or default_folder(options.suite.stem)
    with _working(options, out) as how:
        failed = run_suite(suite, out, given=given_settings(options), **how)
    failures = [f"run {name}: {error}" for name, error in failed.items()]
    finished = [out / run.name for run in suite.runs if run.name not in failed]
    runs = load_runs(finished) if finished else []
    for name in suite.tables if finished else ():
        try:
            tables = suite.tables_of(runs, name)
        except MemoryMazeError as error:
            failures.append(f"table {name}: {error}")
            continue
        print(write_tables(tables, "text").decode())
        write_whole(out / f"{name}.csv", write_tables(tables, "csv"))
    for failure in failures:
        print(f"memorymaze: {failure}", file=sys.stderr)
    return 1 if failures else 0


@contextlib.contextmanager
def _working(options: argparse.Namespace, out: Path) -> Generator[dict[str, Any]]:
    """Give how runs are worked on; end the program where that is interrupted."""
    with _workforce(options) as workforce:
        try:
            # What a user's agent prints while it is made is no result.
            with contextlib.redirect_stdout(sys.stderr):
                yield {
                    "workers": workforce,
                    "resume": options.resume,
                    "on_plan": functools.partial(_announce, workforce),
                }
        except KeyboardInterrupt:
            print(
                "\nmemorymaze: interrupted; what is finished is kept. To go on:\n  "
                + _resuming(sys.argv[1:], out),
                file=sys.stderr,
            )
            raise SystemExit(1) from None


def _announce(workforce: "Workforce", plan: "RunPlan", out: Path) -> None:
    """Say what is to be run, and what that will ask and cost."""
    from memorymaze.runs.episodes.estimates import said_beforehand
    from memorymaze.runs.episodes.in_words import budget_words
    from memorymaze.runs.work.local_workers import LocalWorkforce

    if isinstance(workforce, LocalWorkforce):
        workforce = LocalWorkforce(workforce.number(plan.settings))
    print(
        f"{counted(len(plan.episodes), 'episode')} on {', '.join(plan.sites)}; "
        f"{workforce}; {budget_words(plan.settings)}; into {out}",
        file=sys.stderr,
    )
    for line in said_beforehand(plan):
        print(line, file=sys.stderr)


@contextlib.contextmanager
def _workforce(options: argparse.Namespace) -> Generator["Workforce"]:
    from memorymaze.runs.work.local_workers import LocalWorkforce

    if options.ray is None:
        yield LocalWorkforce(options.workers)
        return
    from memorymaze.basics.extras import require_extra

    require_extra("ray", "ray", purpose="--ray")
    from memorymaze.runs.work.ray_workers import open_ray_cluster

    # Ray prints what it has to say of lost workers where results belong.
    with (
        contextlib.redirect_stdout(sys.stderr),
        open_ray_cluster(options.ray, options.workers) as cluster,
    ):
        yield cluster


def _resuming(arguments: list[str], out: Path) -> str:
    """Return the command that takes up this run."""
    again = list(arguments)
    if not any(part == "--out" or part.startswith("--out=") for part in arguments):
        again += ["--out", str(out)]
    # `memorymaze benchmark` goes on with whatever is there.
    if "--resume" not in arguments and "benchmark" not in arguments[:2]:
        again.append("--resume")
    return f"{command_here()} {shlex.join(again)}"
