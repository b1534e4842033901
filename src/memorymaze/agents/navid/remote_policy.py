"""A policy behind a server of the NaVid protocol; its answers can be recorded.

JSON over HTTP, version 1:

    GET  /info    ->  ServerInfo
    POST /reset   ResetRequest   ->  Acknowledgement
    POST /act     ActRequest     ->  ActReply, or Acknowledgement when only observing
    POST /close   CloseRequest   ->  Acknowledgement

Pictures travel as base64 JPEG. A failure is any status from 400 with `{"error": "..."}`.
Their JSON Schema is `docs/navid_protocol.schema.json`, and `examples/navid_server.py` a
server that speaks it.
"""

import base64
import contextlib
import secrets
import time
from collections.abc import Callable
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from memorymaze.agents.navid.policy import (
    CAMERA_HEIGHT_M,
    FIELD_OF_VIEW_DEG,
    HEIGHT,
    WIDTH,
    Answer,
    Command,
    Frame,
    Motion,
    Task,
)
from memorymaze.errors import LanguageModelError
from memorymaze.language.model import (
    MOST_TOKENS,
    Completion,
    CompletionRequest,
    LanguageModel,
    Message,
    Usage,
)
from memorymaze.server_calls import checked_address, exchange

Reply = TypeVar("Reply", bound=BaseModel)
LONGEST_ANSWER = 1_000_000
"""Bytes of an answer beyond which it is given up."""
Recorder = Callable[[LanguageModel], LanguageModel]
"""Puts recorded replies between the policy and its server."""

VERSION = 1
"""Of the protocol."""

Name = Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[^\x00-\x1f]+$")]
Session = Annotated[str, Field(min_length=1, max_length=64)]
Amount = Annotated[float, Field(ge=0, le=1e9)]
Count = Annotated[int, Field(ge=0)]
Tokens = Annotated[int, Field(ge=0, le=MOST_TOKENS)]


class _Sent(BaseModel):
    """What the agent sends: exactly these fields."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", use_attribute_docstrings=True
    )


class _Received(BaseModel):
    """What a server answers: other fields are allowed and not looked at."""

    model_config = ConfigDict(
        frozen=True, extra="ignore", strict=True, use_attribute_docstrings=True
    )


class ServerInfo(_Received):
    """Answer to `GET /info`."""

    protocol: Literal["memorymaze-navid"]
    protocol_version: int
    """Of the messages; the agent speaks version 1."""
    name: Name
    """Of the model, as tables will show it: `NaVid protocol with <name>`."""
    version: str = ""
    """Of the model or its weights."""
    deterministic: bool = False
    """Whether the same episode gets the same answers."""


class CameraDescription(_Sent):
    """Of the pictures that will come; RGB order."""

    width: int
    """Pixels."""
    height: int
    """Pixels."""
    hfov_deg: float
    """Degrees."""
    height_m: float
    """Metres over the floor."""


class ActionSpace(_Sent):
    """The primitive motions."""

    forward_m: float
    """Metres."""
    turn_deg: int
    """Degrees."""
    max_repeat: int
    """Primitives of one kind that an answer may ask for."""


class ResetRequest(_Sent):
    """Body of `POST /reset`: a new episode begins."""

    protocol_version: int = VERSION
    session: Session
    """Names the episode in all further messages; sessions may be open side by side."""
    instruction: str
    camera: CameraDescription
    action_space: ActionSpace
    seed: int
    """For policies that draw lots."""


class ActRequest(_Sent):
    """Body of `POST /act`: the picture after a step.

    Each step's picture comes once, in order, except that a request may come again when
    its answer was lost or could not be read; `step` tells. The video is all pictures of
    different steps, the current one too.
    """

    session: Session
    step: Count
    """Primitives done before the picture."""
    image_jpeg_b64: str
    observe_only: bool = False
    """True: this is only the video; there are motions left to do. Answer `{"ok": true}`."""
    problem: str | None = None
    """Why the answer to this picture just before could not be used; None at first."""


class MotionReply(_Received):
    """A motion in a policy's own terms."""

    type: Motion
    repeat: Annotated[int, Field(ge=1)] = 1
    """Primitives, up to `max_repeat`."""


class ReplyUsage(_Received):
    """What an answer cost."""

    prompt_tokens: Tokens = 0
    completion_tokens: Tokens = 0
    cost_usd: Amount | None = None


class ActReply(_Received):
    """Answer to `POST /act`: the model's words, or motions, or both.

    Motions count where there are any; otherwise the agent reads the words.
    """

    text: str = ""
    """What the model said, unchanged."""
    actions: Annotated[tuple[MotionReply, ...], Field(strict=False, max_length=8)] = ()
    """Motions to do in turn."""
    latency_ms: Amount | None = None
    """Of the model alone, for information; the agent measures its own."""
    usage: ReplyUsage = ReplyUsage()


class Acknowledgement(_Received):
    """Answer where nothing is asked."""

    ok: Literal[True]


class CloseRequest(_Sent):
    """Body of `POST /close`: the episode is over."""

    session: Session


class Failure(_Received):
    """Body of an answer with a status from 400."""

    error: str


class PolicyServer:
    """A server of the NaVid protocol.

    What may pass is tried again: a connection that fails or breaks, a time-out, and
    statuses from 500. The protocol allows for a message that comes twice.
    """

    def __init__(
        self,
        address: str,
        *,
        timeout: float = 120.0,
        retries: int = 4,
        first_delay: float = 1.0,
    ) -> None:
        """Prepare a client; nothing is sent yet."""
        example = "http://localhost:8765"
        self.address = checked_address("--set server", address, example).rstrip("/")
        self._timeout = timeout
        self._retries = retries
        self._first_delay = first_delay

    def info(self) -> ServerInfo:
        """Ask who is there."""
        info = self._exchange("GET", "/info", None, ServerInfo)
        if info.protocol_version != VERSION:
            raise self._error(
                "/info",
                f"speaks version {info.protocol_version} of the protocol, expected "
                f"version {VERSION}; use a server made for this version",
            )
        return info

    def tell(self, path: str, request: BaseModel) -> None:
        """Send a message to which nothing is to be answered but that it came."""
        self._exchange("POST", path, request, Acknowledgement)

    def act(self, request: ActRequest) -> ActReply:
        """Show a picture and ask for the next motion."""
        reply = self._exchange("POST", "/act", request, ActReply)
        if not (reply.text.strip() or reply.actions):
            raise self._error("/act", "sent an answer with neither text nor actions")
        return reply

    def _exchange(
        self, method: str, path: str, request: BaseModel | None, expected: type[Reply]
    ) -> Reply:
        body = None if request is None else request.model_dump_json()
        attempt = 0
        while True:
            try:
                status, answer = exchange(
                    method,
                    self.address + path,
                    body,
                    seconds=self._timeout,
                    longest=LONGEST_ANSWER,
                )
                if status < 500:
                    return self._read(path, status, answer, expected)
                cause = f"answered {status}: {_said(answer)}"
            except ValueError as error:
                raise self._error(path, str(error)) from error
            except TimeoutError:
                cause = f"did not answer within {self._timeout:g} s"
            except ConnectionError as error:
                cause = str(error)
            attempt += 1
            if attempt > self._retries:
                tried = f" ({attempt} attempts)" if attempt > 1 else ""
                raise self._error(path, cause + tried)
            time.sleep(self._first_delay * 2 ** (attempt - 1))

    def _read(
        self, path: str, status: int, answer: bytes, expected: type[Reply]
    ) -> Reply:
        if status != 200:
            raise self._error(path, f"answered {status}: {_said(answer)}")
        try:
            return expected.model_validate_json(answer)
        except ValidationError as error:
            first: Any = error.errors()[0]
            where = ".".join(str(part) for part in first["loc"])
            what = f"where {where!r} is wrong" if where else "that is wrong"
            raise self._error(
                path,
                f"sent an answer {what} ({first['msg']}): {_beginning(answer)}",
            ) from None

    def _error(self, path: str, cause: str) -> LanguageModelError:
        return LanguageModelError(f"policy server {self.address}{path} {cause}")


def _said(answer: bytes) -> str:
    try:
        return " ".join(Failure.model_validate_json(answer).error.split())[:300]
    except ValidationError:
        return _beginning(answer)


def _beginning(answer: bytes) -> str:
    return repr(" ".join(answer[:300].decode("utf-8", "replace").split())[:80])


class RemotePolicy:
    """Asks a policy server.

    An answer passes as a `Completion` whose text is the server's message, so that it is
    counted, recorded and replayed like a language model's.
    """

    def __init__(self, server: PolicyServer, recorder: Recorder | None = None) -> None:
        """Ask the server who it is."""
        self._server = server
        self._recorder = recorder
        info = server.info()
        self.name = f"{info.name} {info.version}".strip()
        """What the server calls itself, with its version."""

    def begin(self, task: Task) -> "_RemoteSession":
        """Begin an episode on the server."""
        return _RemoteSession(self._server, self.name, task, self._recorder)


class ReplayedPolicy:
    """Gives the recorded answers of a policy server, which need not be there."""

    def __init__(self, model: LanguageModel) -> None:
        """Prepare."""
        self._model = model
        self.name = model.name
        """What the server called itself when it was recorded."""

    def begin(self, task: Task) -> "_ReplayedSession":
        """Begin an episode."""
        return _ReplayedSession(self._model, task)


class _ReplayedSession:
    """One episode with what is recorded of a server."""

    def __init__(self, model: LanguageModel, task: Task) -> None:
        self._model = model
        self._task = task

    def observe(self, frame: Frame) -> None:
        """Nobody looks at it."""

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        asked = f"Step {frame.step}: {self._task.instruction}"
        if problem is not None:
            asked += f"\n(asked again: {problem})"
        request = CompletionRequest(
            (Message("user", asked, (frame.jpeg(),)),), seed=self._task.seed
        )
        return _answer(self._model.complete(request), self._task.motions.most)

    def close(self) -> None:
        """Nobody waits for it."""


class _RemoteSession(_ReplayedSession):
    """One episode on the server; as a language model it asks about the picture shown."""

    _waiting: tuple[Frame, str | None]

    def __init__(
        self, server: PolicyServer, name: str, task: Task, recorder: Recorder | None
    ) -> None:
        super().__init__(self if recorder is None else recorder(self), task)
        self.name = name
        self._server = server
        self._session = secrets.token_hex(16)
        self._shown = -1
        motions = task.motions
        server.tell(
            "/reset",
            ResetRequest(
                session=self._session,
                instruction=task.instruction,
                camera=CameraDescription(
                    width=WIDTH,
                    height=HEIGHT,
                    hfov_deg=FIELD_OF_VIEW_DEG,
                    height_m=CAMERA_HEIGHT_M,
                ),
                action_space=ActionSpace(
                    forward_m=motions.forward_m,
                    turn_deg=motions.turn_deg,
                    max_repeat=motions.most,
                ),
                seed=task.seed,
            ),
        )

    def observe(self, frame: Frame) -> None:
        if frame.step > self._shown:
            self._server.tell("/act", self._request(frame, observe_only=True))
            self._shown = frame.step

    def act(self, frame: Frame, problem: str | None = None) -> Answer:
        self._waiting = frame, problem
        answer = super().act(frame, problem)
        # An answer that was recorded before: the server still has to see this.
        self.observe(frame)
        return answer

    def complete(self, request: CompletionRequest) -> Completion:
        frame, problem = self._waiting
        message = self._request(frame, problem=problem)
        began = time.monotonic()
        reply = self._server.act(message)
        latency = time.monotonic() - began
        self._shown = frame.step
        usage = reply.usage
        return Completion(
            text=reply.model_dump_json(exclude_defaults=True),
            model=self.name,
            usage=Usage(usage.prompt_tokens, usage.completion_tokens, usage.cost_usd),
            latency=latency,
        )

    def close(self) -> None:
        # A server that is gone has nothing to tidy up.
        with contextlib.suppress(LanguageModelError):
            self._server.tell("/close", CloseRequest(session=self._session))

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
