"""From settings to the language model that an agent asks."""

from pathlib import Path

from memorymaze.errors import SettingsError
from memorymaze.evaluation.settings import AgentSettings
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
    if settings.replay is not None:
        model = _replayed(settings, settings.replay)
        return model if price is None else PricedModel(model, price)
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
    if settings.record is None:
        return model
    from memorymaze.language.recorded_replies import RecordingModel

    return RecordingModel(model, settings.record)


def _replayed(settings: AgentSettings, path: str) -> LanguageModel:
    from memorymaze.language.recorded_replies import ReplayingModel

    for option in ("record", "base_url"):
        if getattr(settings, option) is not None:
            raise SettingsError(
                f"--replay and --{option.replace('_', '-')}: replies are replayed "
                "or asked for, not both; leave one out"
            )
    named = settings.model
    return ReplayingModel(path, name=None if named is None else model_name(named))


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
