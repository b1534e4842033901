"""Runs in words: how one is made, and what came of it.

Each fact has its sentence here, which all take: the command line, the notes of tables, and
reports. How episodes ended has marks as well, which need no colour.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from memorymaze.basics.wording import counted
from memorymaze.robot.perception.eyes import TRUTH
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import RunDefinition, RunSettings
from memorymaze.runs.episodes.summary import collision_rates, summarise
from memorymaze.runs.episodes.trace import read_trace, trace_path
from memorymaze.runs.episodes.trace_entries import kept_traceback
from memorymaze.texts.corpus.records import WRITTEN_BY

Key = Literal["arrived", "elsewhere", "broken"]

ENDINGS = {
    "agent": "stopped by itself",
    "budget": "budget spent",
    "stuck": "stuck",
    "crash": "crashed",
    "unsafe": "program refused as unsafe",
    "model_error": "no usable reply of a model",
}
"""By `EpisodeResult.stopped_by`."""
GAVE_UP = "gave up"
"""Of an agent that stopped by itself and says that it is not there."""
REASONS = {
    "agent": "the agent said “we are there”",
    "budget": "the time or call budget ran out",
    "stuck": "stuck: too many calls in a row changed nothing",
    "crash": "the agent failed",
    "unsafe": "the program was refused as unsafe",
    "model_error": "the language model or detector failed",
}
"""The same where there is room for a sentence."""
SOURCES = {
    "human": "said by a person",
    "llm": "written by a language model",
    "synthetic": "made by a program",
}


LOOKS = {
    "own": "things as memorymaze makes them itself",
    "mesh": "meshes beside the plans (docs/importing.md)",
}
CRASHES = 3
"""Kinds of crash that are told of at the end of a run."""


def method_label(settings: RunDefinition, results: Iterable[EpisodeResult]) -> str:
    """Name the method of a run: its agent, and in what it was unlike the usual."""
    names = {result.agent for result in results}
    name = ", ".join(sorted(names)) or settings.agent.name
    if settings.simulation.turning_points == "lidar":
        name += ", turning points by LiDAR"
    if settings.simulation.motion == "kinematic":
        name += ", kinematic"
    if settings.noise is not None:
        name += f", {settings.noise.called}"
    if settings.robot is not None:
        name += f", on {settings.robot.label}"
    if settings.detector != TRUTH:
        name += f", {settings.detector.short_name}"
    if settings.signs != "truth":
        name += f", signs by {settings.signs.upper()}"
    if settings.second_telling:
        name += ", told twice"
    if settings.ask is not None:
        name += f", up to {counted(settings.ask, 'question')}"
        if settings.passers_by != "memory":
            name += f" ({settings.passers_by} answers)"
        return name
    return name if settings.obstacles is None else f"{name}, with obstacles"


def budget_words(settings: RunDefinition) -> str:
    """Say how long an episode may take."""
    time = f"{settings.simulation.time_budget:g} s"
    if settings.scales_budget:
        time = f"3 times a perfect walk of the way described (at most {time})"
    return f"time budget {time}, call budget {settings.simulation.call_budget}"


def followed_words(settings: RunDefinition, results: Sequence[EpisodeResult]) -> str:
    """Say how many instructions were followed, of which files, and who wrote them."""
    counts = Counter(result.source for result in results)
    written = "; ".join(
        f"{count} written by {WRITTEN_BY[source]}" for source, count in counts.items()
    )
    files = ", ".join(stamp.name for stamp in settings.instructions)
    return f"{counted(len(results), 'episode')}; instructions ({files}): {written}"


def sense_notes(
    settings: RunSettings, results: Iterable[EpisodeResult]
) -> Iterator[str]:
    """Say with which body and senses a run is made, where they are not the usual ones."""
    if settings.robot is not None:
        drifts = any(result.by_odometry for result in results)
        how = (
            "BY ITS ODOMETRY from the start on, which may drift, and are not comparable "
            "with others"
            if drifts
            else "by the pose on the plan that it tells"
        )
        yield (
            f"ROBOT {settings.robot}, not the simulated one: walks are measured {how}; "
            "collisions are not counted, and the detector that knows the truth sees what the "
            "plan has."
        )
    if settings.simulation.turning_points == "lidar":
        yield "TURNING POINTS BY LIDAR (scans and odometry), not from the site plan."
    if settings.noise is not None:
        errors = str(settings.noise).replace(",", ", ")
        if settings.simulation.turning_points != "lidar":
            errors += (
                "; without turning points by LiDAR those of odometry have no effect, and "
                "those of scans only on agents that take scans"
            )
        yield f"NOISY LIDAR AND ODOMETRY: {errors}."
    if settings.simulation.motion == "kinematic":
        yield "KINEMATIC MOTION: the robot goes for its speeds exactly, without physics."
    if settings.looks is not None:
        models = f"models of {settings.looks} (docs/seeing.md)"
        yield f"cameras show {LOOKS.get(settings.looks, models)}"
    metres = settings.simulation.detection_range
    if metres != SimulationSettings().detection_range:
        yield f"things are detected up to {metres:g} m away"
    if settings.detector != TRUTH:
        yield f"DETECTOR {settings.detector}, not the one that knows the truth."
    if settings.signs != "truth":
        yield f"SIGNS READ BY {settings.signs.upper()} from pictures."


def track_notes(settings: RunDefinition) -> Iterator[str]:
    """Say what an agent is told and whom it meets, where that is not the usual."""
    if settings.second_telling:
        yield (
            "TOLD TWICE: both tellings of each person as one text; told only once, left "
            f"out: {counted(settings.told_once, 'text')}."
        )
    if settings.ask is not None:
        yield f"TRACK WITH PEOPLE ONE CAN ASK: {_people_to_ask(settings)}."
    if settings.obstacles is not None:
        yield (
            "TRACK WITH OBSTACLES AND PEOPLE, not comparable with runs without: "
            f"{_obstacle_words(settings.obstacles)}."
        )


def _people_to_ask(settings: RunDefinition) -> str:
    kinds = {
        "memory": "who answer from memory",
        "wrong": "ALL OF WHOM ANSWER WRONGLY",
        "empty": "NONE OF WHOM KNOWS ANYTHING",
        "model": "whose words A LANGUAGE MODEL MAKES from what they remember: "
        f"{settings.agent.language_model.model or 'one whose replies were recorded'}",
    }
    return (
        f"the destination's name is told, and {counted(settings.ask or 0, 'question')} an "
        f"episode may be put to people one meets, {kinds[settings.passers_by]}"
    )


def _obstacle_words(obstacles: ObstacleSettings) -> str:
    given = obstacles.people
    number = obstacles.people_per_100m2 if given is None else given
    crowd = f"{number:g} {'person' if number == 1 else 'people'}"
    crowd += " per 100 m2" if given is None else ""
    return (
        f"{obstacles.things_per_100m:g} things per 100 m, {crowd}, obstacle seed "
        f"{obstacles.seed}"
    )


def agent_version(settings: RunDefinition) -> str | None:
    """Say which files and options an agent of a user's own has; None for all others."""
    if not settings.agent_files:
        return None
    files = ", ".join(f"{f.name} {f.sha256[:12]}" for f in settings.agent_files)
    options = ", ".join(f"{name} {value}" for name, value in settings.option_values)
    return f"agent files {files}{f'; options {options}' if options else ''}"


def model_notes(
    settings: RunDefinition, results: Sequence[EpisodeResult]
) -> Iterator[str]:
    """Say which language model answered, how long that took, and at which prices."""
    model = settings.agent.language_model
    if model.model is not None:
        yield f"language model {model.model}"
    if settings.answers is not None:
        known = any(result.inference_s for result in results)
        unknown = "; how long their model took is not known and counted as 0 s"
        yield f"{settings.answers}{'' if known else unknown}"
    if any(result.model_calls for result in results):
        yield model.inference_time.described
        if model.price is not None:
            yield (
                f"prices as given: {model.price.prompt:g} US$ per million tokens read, "
                f"{model.price.completion:g} written"
            )


def part_notes(settings: RunDefinition) -> Iterator[str]:
    """Say of which instructions a run is, where it is not of all."""
    if settings.split is not None:
        yield f"only instructions of the split {settings.split}."
    if settings.limit is not None:
        yield f"A SAMPLE of {counted(settings.episodes, 'episode')} (--limit)."
    if settings.shard is not None:
        yield (
            f"ONLY SHARD {settings.shard} of a run; the folder that it lies in is the whole."
        )


def safety_words(results: Sequence[EpisodeResult]) -> str:
    """Say how safely the robot drove among things and people."""
    found = collision_rates(results)
    return (
        f"per 100 m driven: {found['collisions']:.3f} collisions, "
        f"{found['person_collisions']:.3f} of them with people, {found['near_misses']:.2f} "
        f"near misses; waiting {found['waiting_s']:.1f} s per episode."
    )


def result_lines(
    settings: RunDefinition, results: Sequence[EpisodeResult]
) -> list[str]:
    """Say in a few lines what came of a run; `crash_lines` says of what it crashed."""
    summary = summarise(results, settings)
    mean = summary["mean"]
    ends = Counter(map(ending_words, results))
    told = ", ".join(f"{how} {count}" for how, count in ends.most_common())
    errors = Counter(r.error for r in results if r.error and r.stopped_by != "crash")
    lines = [
        followed_words(settings, results),
        f"success {mean['success']:.3f}, oracle success {mean['oracle_success']:.3f}, "
        f"SPD {mean['spd']:.2f} m, CLS {mean['cls']:.3f} (means over episodes)",
        f"endings: {told}; collisions: {summary['sum']['collisions']}",
    ]
    if errors:
        [(error, count)] = errors.most_common(1)
        lines.append(
            f"{errors.total()} ended with an error, {count} of them with: {error}"
        )
    lines += [*sense_notes(settings, results), *track_notes(settings)]
    if settings.obstacles is not None:
        lines.append(safety_words(results))
    return [*lines, *amount_lines(settings, results)]


def amount_lines(
    settings: RunSettings, results: Sequence[EpisodeResult]
) -> Iterator[str]:
    """Say what was refused, asked, answered and spent in episodes, or in a single one."""

    def total(field: str) -> float:
        return sum(getattr(result, field) for result in results)

    def each(field: str) -> str:
        seconds = f"{total(field) / len(results):.1f} s"
        return seconds if len(results) == 1 else f"{seconds} per episode"

    if total("refused_turns"):
        yield (
            f"{counted(int(total('refused_turns')), 'turn')} refused: no way lay in that "
            "direction, or it was none (calls of turn with turned false, in the traces)"
        )
    if settings.ask is not None:
        yield (
            f"passers-by: {counted(int(total('questions')), 'question')} answered, "
            f"{total('wrong_answers')} of them wrongly, {total('asked_in_vain')} put to "
            f"nobody; strangers stand {each('strangers_s')}"
        )
    if total("strangers_tokens"):
        yield (
            "passers-by's words by a language model: "
            f"{counted(int(total('strangers_tokens')), 'token')}, "
            f"{total('strangers_cost_usd'):.4f} USD, apart from the agent's"
        )
    if total("model_calls"):
        yield (
            f"language model: {counted(int(total('model_calls')), 'call')}, "
            f"{counted(int(total('tokens')), 'token')}, {total('cost_usd'):.4f} USD, "
            f"{total('inference_s'):.1f} s of inference; the user stands waiting "
            f"{each('standing_s')}"
        )


def crash_lines(
    folder: Path, results: Iterable[EpisodeResult], *, whole: bool = False
) -> list[str]:
    """Say of what an agent crashed, where, in how many episodes, most frequent first.

    Tracebacks are shown whole, one of each kind, or by their files.
    """
    crashes: dict[str, list[str]] = {}
    for result in results:
        if result.stopped_by == "crash" and result.error is not None:
            crashes.setdefault(result.error, []).append(result.episode_id)
    lines: list[str] = []
    ordered = sorted(crashes.items(), key=lambda each: -len(each[1]))
    for error, episodes in ordered[:CRASHES]:
        lines.append(f"crash in {counted(len(episodes), 'episode')}: {error}")
        where = kept_traceback(read_trace(folder, episodes[0]))
        if where and whole:
            lines += [f"  {line}" for line in where]
        elif where:
            lines.append(
                f"  traceback in {trace_path(folder, episodes[0])}; shown with "
                "memorymaze --debug"
            )
    if ordered[CRASHES:]:
        lines.append(f"and {counted(len(ordered) - CRASHES, 'further kind')} of crash")
    return lines


@dataclass(frozen=True, slots=True)
class Outcome:
    """A kind of ending; pictures draw it in a colour, a dash and an end mark."""

    key: Key
    title: str
    drawn: str
    """How it is drawn, in words."""


OUTCOMES: dict[Key, Outcome] = {
    "arrived": Outcome("arrived", "arrived", "solid line, ends in a disc"),
    "elsewhere": Outcome(
        "elsewhere", "stopped elsewhere", "dashed line, ends in a cross"
    ),
    "broken": Outcome(
        "broken", "did not stop by itself", "dotted line, ends in a square"
    ),
}


def outcome_of(result: EpisodeResult) -> Outcome:
    """Return how an episode ended."""
    if result.success:
        return OUTCOMES["arrived"]
    return OUTCOMES["elsewhere" if result.stopped_by == "agent" else "broken"]


def ending_words(result: EpisodeResult) -> str:
    """Say how an episode ended: `arrived`, `stopped elsewhere`, `budget spent`."""
    outcome = outcome_of(result)
    if outcome.key == "broken":
        return ENDINGS[result.stopped_by]
    if not result.gave_up:
        return outcome.title
    return f"{GAVE_UP} at the goal" if result.success else GAVE_UP


def outcome_line(result: EpisodeResult) -> str:
    """Say in a line how it ended: `✔ ARRIVED …` or `✘ DID NOT ARRIVE …`."""
    reason = REASONS[result.stopped_by]
    if result.gave_up:
        reason = "the agent gave up and said so"
    verdict = "✔ ARRIVED" if result.success else "✘ DID NOT ARRIVE"
    parts = [
        f"{verdict}: {reason}, {result.spd:.1f} m from the goal",
        f"{result.path_length:.1f} m in {result.duration_s:.0f} s",
        f"CLS {result.cls:.2f}",
        f"SPL {result.spl:.2f}",
    ]
    if not result.success and result.oracle_success:
        parts.append("was near the goal on its way")
    if result.collisions:
        parts.append(f"collisions: {result.collisions}")
    return " · ".join(parts)


def source_line(result: EpisodeResult) -> str:
    """Say who wrote the instruction."""
    return f"Instruction {result.instruction_id}, {SOURCES[result.source]}"
