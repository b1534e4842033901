"""Messages between the agent and a policy server: JSON over HTTP, version 1.

    GET  /info    ->  ServerInfo
    POST /reset   ResetRequest   ->  Acknowledgement
    POST /act     ActRequest     ->  ActReply, or Acknowledgement when only observing
    POST /close   CloseRequest   ->  Acknowledgement

Pictures travel as base64 JPEG. A failure is any status from 400 with `{"error": "..."}`.
The JSON Schema of all messages: `python -m memorymaze.agents.navid.protocol`.
"""

import json
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field
from pydantic.json_schema import models_json_schema

from memorymaze.agents.navid.motions import Motion

PROTOCOL = "memorymaze-navid"
VERSION = 1

Name = Annotated[str, Field(min_length=1, max_length=200, pattern=r"^[^\x00-\x1f]+$")]
Session = Annotated[str, Field(min_length=1, max_length=64)]
Amount = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Count = Annotated[int, Field(ge=0)]


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

    prompt_tokens: Count = 0
    completion_tokens: Count = 0
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


MESSAGES = (
    ServerInfo,
    ResetRequest,
    ActRequest,
    ActReply,
    CloseRequest,
    Acknowledgement,
    Failure,
)


def message_schema() -> dict[str, Any]:
    """Return the JSON Schema of all messages, by their names under `$defs`."""
    _, schema = models_json_schema(
        [(message, "validation") for message in MESSAGES],
        title=f"{PROTOCOL}, version {VERSION}",
    )
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


if __name__ == "__main__":
    print(json.dumps(message_schema(), indent=2))
