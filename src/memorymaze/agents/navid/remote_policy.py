"""A policy behind a server of the NaVid protocol; its answers can be recorded."""

import base64
import contextlib
import secrets
import time
from collections.abc import Callable

from pydantic import ValidationError

from memorymaze.agents.navid.client import PolicyServer
from memorymaze.agents.navid.motions import Command
from memorymaze.agents.navid.policy import (
    CAMERA_HEIGHT_M,
    FIELD_OF_VIEW_DEG,
    HEIGHT,
    WIDTH,
    Answer,
    Frame,
    Task,
)
from memorymaze.agents.navid.protocol import (
    ActionSpace,
    ActReply,
    ActRequest,
    CameraDescription,
    CloseRequest,
    ResetRequest,
)
from memorymaze.errors import LanguageModelError
from memorymaze.language.model import (
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
    Usage,
)

CAMERA = CameraDescription(
    width=WIDTH,
    height=HEIGHT,
    hfov_deg=FIELD_OF_VIEW_DEG,
    height_m=CAMERA_HEIGHT_M,
)

Recorder = Callable[[LanguageModel], LanguageModel]
"""Puts recorded replies between the policy and its server."""


class RemotePolicy:
    """Asks a policy server.

    An answer passes as a `Completion` whose text is the server's message, so that it is
    counted, recorded and replayed like a language model's.
    """

    def __init__(self, server: PolicyServer, recorder: Recorder | None = None) -> None:
        """Ask the server who it is.

        Args:
            server: Where it is.
            recorder: Makes a `RecordingModel` of what asks the server; None for none.

        Raises:
            LanguageModelError: Nobody is there who speaks the protocol.
        """
        self._server = server
        self._recorder = recorder
        info = server.info()
        self._name = f"{info.name} {info.version}".strip()

    @property
    def name(self) -> str:
        """What the server calls itself, with its version."""
        return self._name

    def begin(self, task: Task) -> "RemoteSession":
        """Begin an episode on the server.

        Raises:
            LanguageModelError: The server cannot be used.
        """
        line = _Line(self._server, self._name, task)
        model: LanguageModel = line if self._recorder is None else self._recorder(line)
        return RemoteSession(model, task, line)


class ReplayedPolicy:
    """Gives the recorded answers of a policy server, which need not be there."""

    def __init__(self, model: LanguageModel) -> None:
        """Prepare."""
        self._model = model

    @property
    def name(self) -> str:
        """What the server called itself when it was recorded."""
        return self._model.name

    def begin(self, task: Task) -> "RemoteSession":
        """Begin an episode."""
        return RemoteSession(self._model, task, None)


class RemoteSession:
    """One episode with a server, or with what is recorded of one."""

    def __init__(self, model: LanguageModel, task: Task, line: "_Line | None") -> None:
        """Prepare; used by the policies.

        Args:
            model: What answers: the line, or recorded replies of it.
            task: The episode.
            line: Where pictures are sent; None for nowhere.
        """
        self._model = model
        self._task = task
        self._line = line

    def observe(self, frame: Frame) -> None:
        """See `PolicySession.observe`."""
        if self._line is not None:
            self._line.observe(frame)

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        """See `PolicySession.act`."""
        if self._line is not None:
            self._line.put(frame, problem)
        asked = f"Step {frame.step}: {self._task.instruction}"
        if problem is not None:
            asked += f"\n(asked again: {problem})"
        request = CompletionRequest(
            (Message("user", asked, (frame.jpeg(),)),), seed=self._task.seed
        )
        completion = self._model.complete(request)
        if self._line is not None:
            # An answer that was recorded before: the server still has to see this.
            self._line.observe(frame)
        return _answer(completion, self._task.motions.most)

    def close(self) -> None:
        """See `PolicySession.close`."""
        if self._line is not None:
            self._line.close()


class _Line:
    """A session on the server; as a language model it asks about the picture put."""

    def __init__(self, server: PolicyServer, name: str, task: Task) -> None:
        self._server = server
        self._name = name
        self._session = secrets.token_hex(16)
        self._shown = -1
        self._waiting: tuple[Frame, str | None] | None = None
        motions = task.motions
        server.reset(
            ResetRequest(
                session=self._session,
                instruction=task.instruction,
                camera=CAMERA,
                action_space=ActionSpace(
                    forward_m=motions.forward_m,
                    turn_deg=motions.turn_deg,
                    max_repeat=motions.most,
                ),
                seed=task.seed,
            )
        )

    @property
    def name(self) -> str:
        """Name of the model behind the server."""
        return self._name

    def put(self, frame: Frame, problem: str | None) -> None:
        """Say which picture the next question is about."""
        self._waiting = frame, problem

    def observe(self, frame: Frame) -> None:
        """Send a picture that was not sent yet."""
        if frame.step > self._shown:
            self._server.observe(self._request(frame, observe_only=True))
            self._shown = frame.step

    def complete(self, request: CompletionRequest) -> Completion:
        """Ask about the picture that was put."""
        if self._waiting is None:
            raise LanguageModelError("policy server: asked without a picture")
        frame, problem = self._waiting
        message = self._request(frame, problem=problem)
        began = time.monotonic()
        reply = self._server.act(message)
        latency = time.monotonic() - began
        self._shown = frame.step
        usage = reply.usage
        return Completion(
            text=reply.model_dump_json(exclude_defaults=True),
            model=self._name,
            usage=Usage(usage.prompt_tokens, usage.completion_tokens, usage.cost_usd),
            latency=latency,
        )

    def close(self) -> None:
        """Say that it is over; a server that is gone has nothing to tidy up."""
        with contextlib.suppress(LanguageModelError):
            self._server.close(CloseRequest(session=self._session))

    def _request(
        self, frame: Frame, *, observe_only: bool = False, problem: str | None = None
    ) -> ActRequest:
        return ActRequest(
            session=self._session,
            step=frame.step,
            image_jpeg_b64=base64.b64encode(frame.jpeg().data).decode("ascii"),
            observe_only=observe_only,
            problem=problem,
        )


def _answer(completion: Completion, most: int) -> Answer:
    try:
        reply = ActReply.model_validate_json(completion.text)
    except ValidationError as error:
        raise LanguageModelError(
            f"recorded replies of {completion.model}: expected a policy server's "
            f"answer ({error.errors()[0]['msg']})"
        ) from None
    for action in reply.actions:
        if action.repeat > most:
            raise LanguageModelError(
                f"policy server {completion.model}: expected at most {most} of one "
                f"motion in a row, got {action.repeat}"
            )
    commands = tuple(Command(each.type, each.repeat) for each in reply.actions)
    return Answer(completion, reply.text, commands)
