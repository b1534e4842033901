"""From settings to the language model that an agent asks."""

from memorymaze.errors import SettingsError
from memorymaze.evaluation.settings import AgentSettings
from memorymaze.language.model import LanguageModel

__all__ = ["build_language_model"]


def build_language_model(settings: AgentSettings) -> LanguageModel:
    """Make the language model of an agent: a server's, or recorded replies.

    Raises:
        SettingsError: No model is named, or the settings contradict each other, or the
            server's address, its key or the file of replies cannot be used.
    """
    if settings.replay is not None:
        from memorymaze.language.recorded_replies import ReplayingModel

        for option in ("record", "base_url"):
            if getattr(settings, option) is not None:
                raise SettingsError(
                    f"--replay and --{option.replace('_', '-')}: replies are replayed "
                    "or asked for, not both; leave one out"
                )
        return ReplayingModel(settings.replay, name=settings.model)
    if settings.model is None:
        raise SettingsError(
            f"--agent {settings.name}: name a language model with --model, or take "
            "recorded replies with --replay"
        )
    from memorymaze.language.openai_model import OpenAIModel
    from memorymaze.language.recorded_replies import RecordingModel

    model = OpenAIModel(settings.model, base_url=settings.base_url)
    return model if settings.record is None else RecordingModel(model, settings.record)
