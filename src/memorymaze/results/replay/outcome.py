"""How an episode ended and what it was, in words for the edge of a picture."""

from memorymaze.evaluation.results import EpisodeResult

ENDINGS = {
    "agent": "the agent said “we are there”",
    "budget": "the time or call budget ran out",
    "stuck": "stuck: too many calls in a row changed nothing",
    "crash": "the agent failed",
    "unsafe": "the program was refused as unsafe",
    "model_error": "the language model or detector failed",
}
SOURCES = {
    "human": "said by a person",
    "llm": "written by a language model",
    "synthetic": "made by a program",
}


def outcome_line(result: EpisodeResult) -> str:
    """Say how an episode ended: `✔ ARRIVED …` or `✘ DID NOT ARRIVE …`."""
    verdict = "✔ ARRIVED" if result.success else "✘ DID NOT ARRIVE"
    parts = [
        f"{verdict}: {ENDINGS[result.stopped_by]}, {result.spd:.1f} m from the goal",
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
