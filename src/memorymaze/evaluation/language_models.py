"""From settings to the language model that an agent asks, or to the answers it takes."""

from collections.abc import Callable, Sequence
from pathlib import Path

from memorymaze.agents.agent import Agent
from memorymaze.errors import AnswerFileError, SettingsError
from memorymaze.evaluation.settings import AgentSettings, AnswersTaken
from memorymaze.input_files import stamp_file
from memorymaze.instructions.records import Episode
from memorymaze.language.answer_files import AnswerFile
from memorymaze.language.answers import RecordingModel, ReplayingModel
from memorymaze.language.local_models import is_local, local_model, model_name
from memorymaze.language.model import LanguageModel
from memorymaze.language.spending import PricedModel


def build_language_model(settings: AgentSettings) -> LanguageModel:
    """Make the language model of an agent: a server's, a local one, recorded replies.

    Raises:
        SettingsError: No model is named, or the settings contradict each other, or the
            server's address, its key, or the file of the model or of replies cannot be
            used.
    """
    price = settings.asking.price
    replayed = replaying_model(settings)
    if replayed is not None:
        return replayed if price is None else PricedModel(replayed, price)
    if settings.model is None:
        raise SettingsError(
            f"--agent {settings.name}: name a language model with --model, or take "
            "recorded replies with --replay"
        )
    if is_local(settings.model) and settings.base_url is None:
        model = local_model(settings.model, threads=settings.asking.threads)
    else:
        model = _server(settings, settings.model)
    if price is not None:
        model = PricedModel(model, price)
    model = _limited(settings, model)
    return model if settings.record is None else RecordingModel(model, settings.record)


def replaying_model(settings: AgentSettings) -> ReplayingModel | None:
    """Return what gives an agent recorded answers; None where a model is asked.

    Raises:
        SettingsError: The file cannot be used, or the settings also say how to ask.
        AnswerFileError: Something in the file is wrong.
    """
    if settings.replay is None:
        return None
    for option in ("record", "base_url"):
        if getattr(settings, option) is not None:
            raise SettingsError(
                f"--replay and --{option.replace('_', '-')}: replies are replayed "
                "or asked for, not both; leave one out"
            )
    named = None if settings.model is None else model_name(settings.model)
    return ReplayingModel(settings.replay, name=named)


def parses_first(settings: AgentSettings) -> bool:
    """Tell whether an agent with a parser uses it; by its answers, if nobody says."""
    if settings.parser is not None:
        return settings.parser
    model = replaying_model(settings)
    stages = set() if model is None else {stage for _, stage in model.versions()}
    return not stages or any(stage.partition("+")[0] == "parse" for stage in stages)


def answers_taken(
    settings: AgentSettings,
    agent_for: Callable[[Episode], Agent],
    episodes: Sequence[Episode],
) -> AnswersTaken | None:
    """Say which answers a run takes; None where it asks a model.

    Raises:
        AnswerFileError: A file has no answer for some episodes; names the first. A
            store may have none: a failure of the model is not kept.
    """
    model = replaying_model(settings)
    if model is None or settings.replay is None:
        return None
    versions = model.versions()
    wanted = list(dict.fromkeys(each.instruction.id for each in episodes))
    known = {instruction for instruction, _ in versions}
    missing = [each for each in wanted if versions and each not in known]
    if missing and isinstance(model.answers, AnswerFile):
        raise AnswerFileError(
            f"{settings.replay}: expected an answer for each of {len(wanted)} "
            f"instructions, got none for {len(missing)}: "
            f"{', '.join(missing[:10])}{', …' if len(missing) > 10 else ''}; for one "
            "that the model failed on write a record with `error`"
        )
    prompts: dict[str, str] = getattr(agent_for(episodes[0]), "prompts", {})
    other = unknown = 0
    for each in wanted:
        answered = [
            (versions.get((each, stage)) or versions.get((each, plain), set()), prompt)
            for stage, prompt in prompts.items()
            for plain in [stage.partition("+")[0]]
        ]
        differing = [
            found for found, prompt in answered if found and prompt not in found
        ]
        unknown += any(None in found for found in differing)
        other += bool(differing) and not any(None in found for found in differing)
    stamp = stamp_file(settings.replay)
    return AnswersTaken(stamp.name, stamp.sha256, len(missing), other, unknown)


def _server(settings: AgentSettings, name: str) -> LanguageModel:
    from memorymaze.language.openai_model import OpenAIModel

    if name.startswith("gguf:"):
        raise SettingsError(
            f"--model {name} and --base-url: a file is run here and not on a server; "
            "leave --base-url out, or give the server's name for the model"
        )
    asking = settings.asking
    return OpenAIModel(
        name,
        base_url=settings.base_url,
        timeout=asking.timeout,
        retries=asking.retries,
        grammar_server=asking.grammar,
    )


def _limited(settings: AgentSettings, model: LanguageModel) -> LanguageModel:
    """Put the limits that the processes of a run keep together on a model."""
    asking = settings.asking
    shared = None if asking.shared_folder is None else Path(asking.shared_folder)
    if asking.max_requests is not None and shared is not None:
        from memorymaze.language.spending import QueuedModel

        model = QueuedModel(model, shared / "requests.lock", asking.max_requests)
    if asking.limited:
        from memorymaze.language.spending import Ledger, LimitedModel

        ledger = Ledger(None if shared is None else shared / "spending.jsonl")
        model = LimitedModel(model, ledger, asking.max_cost, asking.max_tokens_total)
    return model
