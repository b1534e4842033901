"""What the parts of the guide bring: the guide, the guide without each part, and others.

`python -m benchmarks.ablation [--limit N] [--instructions FILE …] [--out DIR]` runs them on
the same texts, prints first the primary comparison, then the success of each beside that
of the guide, by halves of the participants: first those whose texts were not read while
the agents were developed (docs/guide.md).
"""

import argparse
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from memorymaze.evaluation.driver import run_plan
from memorymaze.evaluation.plan import plan_run
from memorymaze.evaluation.settings import AgentSettings, RunSettings
from memorymaze.instructions import Corpus, load_corpus
from memorymaze.language.model_settings import ModelSettings
from memorymaze.results.tables import MeasuredRun, comparison_overview, load_runs
from memorymaze.tables import Table

PLANS = Path(__file__).parents[1] / "examples/recorded/plans.jsonl"
RECORDED = ModelSettings(replay=str(PLANS))
AGENTS: Mapping[str, AgentSettings] = {
    "guide": AgentSettings("guide"),
    "rules": AgentSettings("rules"),
    "explorer": AgentSettings("explorer"),
    "guide_without_things": AgentSettings("guide", options=(("things", "false"),)),
    "guide_without_signs": AgentSettings("guide", options=(("signs", "false"),)),
    "guide_without_repair": AgentSettings("guide", options=(("repair", "false"),)),
    "guide_plans": AgentSettings(
        "guide", options=(("reader", "model"),), language_model=RECORDED
    ),
    "rules_plans": AgentSettings(
        "rules", options=(("reader", "model"),), language_model=RECORDED
    ),
}
"""By the names of their run folders. Those with `plans` walk what a large language model
read in the shipped texts (recorded)."""
PRIMARY = ("rules", "guide", "held_out", "onsite")
"""Named before anything was run: baseline, agent, half, study."""
HALVES = {
    "held_out": "participants whose texts were not read while developing",
    "developed": "participants whose texts were read while developing",
}


def walked(
    names: Sequence[str], corpus: Corpus, options: argparse.Namespace
) -> dict[str, MeasuredRun]:
    """Run agents, as far as they were not run, and read what came of it."""
    settings = RunSettings(limit=options.limit, seed=options.seed)
    for name in names:
        print(f"running {name} ...", file=sys.stderr)
        plan = plan_run(AGENTS[name], corpus, settings)
        run_plan(plan, options.out / name, workers=options.workers, resume=True)
    runs = load_runs([options.out / name for name in names])
    return {run.name: replace(run, label=run.name) for run in runs}


def of_part(
    runs: Mapping[str, MeasuredRun], corpus: Corpus, half: str, study: str | None = None
) -> dict[str, MeasuredRun]:
    """Return the runs with the results of a half, and of a study, alone."""
    kept = {
        each.id
        for each in corpus.of_split(half)
        if study in {None, each.instruction.study}
    }
    parts = {
        name: replace(
            run, results=tuple(r for r in run.results if r.episode_id in kept)
        )
        for name, run in runs.items()
    }
    return {name: run for name, run in parts.items() if run.results}


def tables(runs: Mapping[str, MeasuredRun], corpus: Corpus) -> Iterator[Table]:
    """Yield the primary comparison, then all beside the guide, the unread half first."""
    if not corpus.was_half_read:
        yield _beside_guide(runs, "all texts")
        return
    baseline, agent, half, study = PRIMARY
    chosen = of_part(runs, corpus, half, study)
    if baseline in chosen and agent in chosen:
        table = comparison_overview(chosen[baseline], [chosen[agent]])
        about = f"{agent} against {baseline}, {study}, {HALVES[half]}"
        yield replace(table, title=f"Primary comparison: {about}")
    for half, about in HALVES.items():
        part = of_part(runs, corpus, half)
        if "guide" in part and len(part) > 1:
            yield _beside_guide(part, about)


def _beside_guide(runs: Mapping[str, MeasuredRun], about: str) -> Table:
    others = [run for name, run in runs.items() if name != "guide"]
    table = comparison_overview(runs["guide"], others)
    return replace(table, title=f"Success of each (B) beside the guide (A): {about}")


def main() -> int:
    """Run what is asked for and print the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.ablation")
    parser.add_argument("--limit", type=int, metavar="N", help="only N episodes")
    parser.add_argument("--seed", type=int, metavar="N", default=0)
    parser.add_argument("--workers", type=int, metavar="N", default=0)
    parser.add_argument(
        "--instructions",
        nargs="+",
        metavar="FILE",
        help="other texts, without the rows of recorded plans (default: the shipped)",
    )
    parser.add_argument(
        "--only",
        nargs="+",
        choices=AGENTS,
        metavar="NAME",
        help=f"beside guide, only these: {', '.join(AGENTS)}",
    )
    parser.add_argument(
        "--out", type=Path, metavar="DIR", default=Path("runs/ablation")
    )
    options = parser.parse_args()
    names = list(dict.fromkeys(["guide", *(options.only or AGENTS)]))
    if options.instructions:
        names = [name for name in names if AGENTS[name].language_model is not RECORDED]
    if len(names) < 2:
        parser.error("--only: expected an agent to compare with guide, got none")
    corpus = load_corpus(options.instructions)
    for table in tables(walked(names, corpus, options), corpus):
        print(table.text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
