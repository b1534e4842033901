"""How a language model is made of its settings: a server's, a local one, or recorded answers."""

from pathlib import Path

from memorymaze.basics.errors import SettingsError
from memorymaze.language.models.answers import RecordingModel, ReplayingModel
from memorymaze.language.models.local_models import is_local, local_model, model_name
from memorymaze.language.models.model import LanguageModel
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.language.models.spending import (
    Ledger,
    LimitedModel,
    PricedModel,
    QueuedModel,
)


def build_language_model(settings: ModelSettings) -> LanguageModel:
    """Make a language model: a server's, a local one, or recorded answers.

    Raises:
        SettingsError: No model is named, or the settings contradict each other, or the
            server's address, its key, or the file of the model or of answers cannot be
            used.
        AnswerFileError: Something in a file of answers is wrong.
    """
    replayed = replaying_model(settings)
    if replayed is not None:
        return _priced(settings, replayed)
    if settings.model is None:
        raise SettingsError(
            "name a language model with --model, or take recorded replies with --replay"
        )
    if is_local(settings.model) and settings.base_url is None:
        model = local_model(settings.model, threads=settings.threads)
    else:
        model = _server(settings, settings.model)
    model = _limited(settings, _priced(settings, model))
    if settings.record is None:
        return model
    # What is kept may have been recorded at another price.
    return _priced(settings, RecordingModel(model, settings.record))


def _server(settings: ModelSettings, name: str) -> LanguageModel:
    from memorymaze.language.models.openai_model import OpenAIModel

    if name.startswith("gguf:"):
        raise SettingsError(
            f"--model {name} and --base-url: a file is run here and not on a server; "
            "leave --base-url out, or give the server's name for the model"
        )
    return OpenAIModel(
        name,
        base_url=settings.base_url,
        timeout=settings.request_timeout,
        retries=settings.retries,
        grammar_server=settings.grammar,
    )


def _priced(settings: ModelSettings, model: LanguageModel) -> LanguageModel:
    return model if settings.price is None else PricedModel(model, settings.price)


def _limited(settings: ModelSettings, model: LanguageModel) -> LanguageModel:
    """Put the limits that the processes of a run keep together on a model."""
    folder = settings.shared_folder
    shared = None if folder is None else Path(folder)
    if settings.max_requests is not None and shared is not None:
        model = QueuedModel(model, shared / "requests.lock", settings.max_requests)
    # Without limits too: they may come with --resume, and are on all that the run spent.
    ledger = Ledger(None if shared is None else shared / "spending.jsonl")
    most = settings.max_tokens_total
    return LimitedModel(model, ledger, settings.max_cost, most)


def replaying_model(settings: ModelSettings) -> ReplayingModel | None:
    """Return what gives recorded answers; None where a model is asked."""
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
