"""Runs of agents over corpora, read back, shown and compared."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.options import check_kind
from memorymaze.basics.tables import Table
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.agent_catalogue import AgentChoice
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.plan import RunPlan, plan_run, settings_for
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.runs.episodes.shards import part_folder
from memorymaze.runs.tables import (
    COMPARISON,
    EQUAL_METRES,
    MeasuredRun,
    load_runs,
    paired_table,
    run_tables,
)
from memorymaze.runs.tables.figures import success_figure
from memorymaze.runs.work.driver import run_plan
from memorymaze.runs.work.run_folder import read_run
from memorymaze.runs.work.worker_pool import Workforce
from memorymaze.texts.corpus import Corpus, load_corpus

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure


@dataclass(frozen=True, slots=True, repr=False)
class Run(MeasuredRun):
    """A run folder, read, with its tables and figures as methods."""

    def table(self, choice: str = "II") -> Table:
        """Return the run as one of the paper's tables, beside the published figures.

        Args:
            choice: `II` (methods), `III` (iterations), `errors` (kinds of errors), `reach`
                (by distance and by metres walked) or `confidence`. What a second telling
                is worth takes two runs: `Comparison.paper_table("second_tellings")`.

        Raises:
            SettingsError: There is no such table.
        """
        return run_tables([self], choice)[0]

    def frame(self) -> "pandas.DataFrame":
        """Return the results, a row an episode; needs the extra `tables`."""
        require_extra("tables", "pandas", purpose="data frames")
        import pandas

        rows = [{"run": self.name, **asdict(each)} for each in self.results]
        return pandas.DataFrame(rows)

    def plot(self) -> "Figure":
        """Draw the success rate of every route, with intervals."""
        return success_figure([self])

    def __len__(self) -> int:
        """Return the number of episodes that have a result."""
        return len(self.results)

    def __repr__(self) -> str:
        """Say who followed how much, and how well."""
        successes = sum(each.success for each in self.results)
        rate = f", success {successes / len(self):.2f}" if self.results else ""
        missing = f", {self.missing} to come" if self.missing else ""
        ends = Counter(each.stopped_by for each in self.results if each.error)
        failed = "".join(f", {count} {end}" for end, count in ends.items())
        return (
            f"Run({str(self.folder)!r}: {self.label}, {len(self)} episodes"
            f"{missing}{rate}{failed})"
        )


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two runs or more on the same episodes, each beside the first."""

    runs: tuple[Run, ...]

    def table(self) -> Table:
        """Return the paired differences, with intervals and tests.

        Raises:
            SettingsError: There are more than two runs, which one table cannot pair.
        """
        return paired_table(self._pair(), COMPARISON)

    def equal_metres(self) -> Table:
        """Return the success on texts with errors within so many times the way, by kind.

        Raises:
            SettingsError: There are more than two runs.
            RunFolderError: No text with an error is in both.
        """
        return paired_table(self._pair(), EQUAL_METRES)

    def paper_table(self, choice: str = "II") -> Table:
        """Return all runs in one table; see `run_tables`."""
        return run_tables(self.runs, choice)[0]

    def frame(self) -> "pandas.DataFrame":
        """Return the paired differences as a frame; needs the extra `tables`."""
        return self.table().frame()

    def plot(self) -> "Figure":
        """Draw the success rates of all runs side by side."""
        return success_figure(self.runs)

    def _pair(self) -> tuple[Run, ...]:
        if len(self.runs) != 2:
            raise SettingsError(
                f"paired table: expected two runs, got {len(self.runs)}; compare two at "
                "a time, or take paper_table()"
            )
        return self.runs

    def __repr__(self) -> str:
        """Name the runs."""
        return f"Comparison({' with '.join(run.label for run in self.runs)})"


def evaluate(
    agent: AgentChoice,
    corpus: Corpus | str | Path | Sequence[str | Path] | None = None,
    *,
    out: str | Path | None = None,
    settings: RunSettings | None = None,
    language_model: ModelSettings | None = None,
    workers: int | Workforce = 0,
    resume: bool = False,
    on_plan: Callable[[RunPlan, Path], None] | None = None,
    **choices: Any,
) -> Run:
    """Run an agent over a corpus, into a folder.

    The same as `memorymaze evaluate`: the results do not depend on how it was called.

    Args:
        agent: A name, your own as `module:Class` or `file.py:Class`, a class, an object,
            or `AgentSettings` where it is given options.
        corpus: What is followed, and where: loaded, or what `load_corpus` takes; None
            for the shipped texts.
        out: Run folder; None for `runs/AGENT-TIME`. A shard writes its part inside, and
            the folder is read as one run when all parts are there. One to which no
            episode falls, of more shards than episodes, gives a run without results.
        settings: How; those that belong to the corpus when None.
        language_model: Which one the agent asks, and how, where it needs one.
        workers: Processes, 0 for one per core; or workers elsewhere.
        resume: Whether to finish a run that is in the folder. Of an agent that is an object
            its file and its `options` are compared with it, not what else it holds.
        on_plan: Called with the plan and the folder, before anything is run.
        **choices: Settings to change, such as `limit=60`, `seed=1` or
            `obstacles="light"`; see `RunSettings` and `SimulationSettings`.

    Raises:
        MemoryMazeError: Something that was given cannot be used; what agents do wrong
            is part of the results.
    """
    check_kind("out", out, str | Path | None, "a folder to make")
    followed = corpus if isinstance(corpus, Corpus) else load_corpus(corpus)
    base = settings_for(followed) if settings is None else settings
    plan = plan_run(agent, followed, with_choices(base, choices), language_model)
    shard = plan.settings.shard
    if shard is not None and out is None:
        raise SettingsError(
            f"shard {shard}: name the folder of the whole run (out), which all parts share"
        )
    whole = Path(out) if out is not None else default_folder(plan.settings.agent.name)
    folder = part_folder(whole, shard)
    if on_plan is not None:
        on_plan(plan, folder)
    run_plan(plan, folder, workers=workers, resume=resume)
    if not plan.episodes:
        record, _ = read_run(folder)
        return Run(folder, folder.name, plan.settings.agent.name, record, (), 0)
    return load_run(folder)


def load_run(folder: str | Path, *, exclude_dev: bool = False) -> Run:
    """Read a run folder, also one that is still being written.

    Raises:
        RunFolderError: It is no run folder, is damaged, or has no result yet.
        SettingsError: It is no folder's name.
    """
    return load_runs([folder], Run, exclude_dev=exclude_dev)[0]


def compare(*runs: Run | str | Path, exclude_dev: bool = False) -> Comparison:
    """Compare runs on the episodes that they share; the first is the baseline.

    Raises:
        SettingsError: There are fewer than two, one is neither a run nor a folder, or one
            is named twice.
        RunFolderError: One is no run folder.
    """
    if len(runs) < 2:
        raise SettingsError(f"compare: expected two runs or more, got {len(runs)}")
    for run in runs:
        check_kind("compare", run, Run | str | Path, "runs or run folders")
    folders = [run.folder if isinstance(run, Run) else run for run in runs]
    return Comparison(tuple(load_runs(folders, Run, exclude_dev=exclude_dev)))


def default_folder(agent: str) -> Path:
    """Return the folder of a run that none was named for: `runs/AGENT-TIME`."""
    name = Path(agent.replace(":", "-")).name.replace(".py", "")
    return Path("runs") / f"{name}-{datetime.now().strftime('%Y%m%d-%H%M%S')}"
