"""A language model that says what it was given to say; for tests and offline use."""

from collections.abc import Callable, Sequence

from memorymaze.basics.errors import LanguageModelError
from memorymaze.language.models.model import Completion, CompletionRequest, Usage


class ScriptedLanguageModel:
    """Answers from a list, one reply per request, or from a function.

    Example:
        >>> from memorymaze.language.models.model import Message
        >>> model = ScriptedLanguageModel(["stop()"])
        >>> request = CompletionRequest((Message("user", "Go nowhere."),))
        >>> model.complete(request).text
        'stop()'
    """

    def __init__(
        self,
        replies: Sequence[str] | Callable[[CompletionRequest], str],
        *,
        name: str = "scripted",
    ) -> None:
        """Prepare the replies."""
        self._replies = replies
        self._name = name
        self.requests: list[CompletionRequest] = []
        """What was asked so far."""

    @property
    def name(self) -> str:
        """Name shown in tables."""
        return self._name

    def complete(self, request: CompletionRequest) -> Completion:
        """Give the next reply; words are counted as its tokens."""
        asked = len(self.requests)
        self.requests.append(request)
        if callable(self._replies):
            text = self._replies(request)
        elif asked < len(self._replies):
            text = self._replies[asked]
        else:
            raise LanguageModelError(
                f"the scripted model has {len(self._replies)} replies "
                f"and was asked {asked + 1} times"
            )
        prompt_words = sum(len(message.content.split()) for message in request.messages)
        usage = Usage(prompt_words, len(text.split()))
        return Completion(text=text, model=self._name, usage=usage, latency=0.0)
