"""The format of one line of an instruction file, checked at the boundary."""

import json
from dataclasses import asdict
from typing import Annotated, Any, Literal, cast

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationError,
    model_validator,
)

from memorymaze.errors import did_you_mean
from memorymaze.input_files import parse_json
from memorymaze.instructions.records import Failure, Followers, Instruction, Span

Text = Annotated[str, StringConstraints(min_length=1, pattern=r"\S")]


def _whole(value: object) -> object:
    """Refuse `true` and `1.0`, which compare equal to 1."""
    if type(value) is not int:
        raise ValueError("not a whole number")
    return value


class _FailureLine(BaseModel):
    model_config = ConfigDict(strict=True)

    kind: Text = Field(description="a non-empty text such as missing_turn")
    where: str = Field(description="a text: turning point id or place")
    detail: str = Field(description="a text")


class _SpanLine(BaseModel):
    model_config = ConfigDict(strict=True)

    kind: Text = Field(description="a non-empty text such as missing_turn or filler")
    start: Annotated[int, Field(ge=0)] = Field(description="a character of the text")
    end: Annotated[int, Field(ge=0)] = Field(description="the character after the last")
    where: str = Field(default="", description="a text: turning point id or place")
    detail: str = Field(default="", description="a text")


class _FollowersLine(BaseModel):
    model_config = ConfigDict(strict=True)

    usable: bool = Field(description="true or false")
    tried: Annotated[int, Field(ge=0)] | None = Field(description="a count or null")
    arrived: Annotated[int, Field(ge=0)] | None = Field(description="a count or null")


class _InstructionLine(BaseModel):
    model_config = ConfigDict(strict=True)

    id: Text = Field(description="a non-empty text, unique among all files")
    site: Text = Field(description="the name of a site, such as museum_5f")
    route: Text = Field(description="the name of a route, such as R1")
    study: Literal["online", "onsite"] = Field(description="'online' or 'onsite'")
    iteration: Annotated[Literal[1, 2], BeforeValidator(_whole)] = Field(
        description="the number 1 or 2"
    )
    participant: Text = Field(description="a non-empty text")
    text: Text = Field(description="the instruction, a non-empty text")
    reference_route: Text = Field(
        description="the id of a route in the site plan, such as route_r1_reference"
    )
    failures: list[_FailureLine] = Field(
        description="a list of {kind, where, detail}, [] when the text is right"
    )
    source: Literal["human", "llm", "synthetic"] = Field(
        description="'human', 'llm' or 'synthetic'"
    )
    language: Text = Field(description="a language code such as en")
    split: Annotated[str, StringConstraints(pattern=r"^[a-z0-9_]+$")] = Field(
        default="test", description="a name in small letters such as 'dev' or 'test'"
    )
    original_text: str | None = Field(default=None, description="a text or null")
    followers: _FollowersLine | None = Field(
        default=None, description="a record {usable, tried, arrived} or null"
    )
    pair: Text | None = Field(default=None, description="a non-empty text or null")
    spans: list[_SpanLine] = Field(
        default=[], description="a list of {kind, start, end, where, detail}"
    )
    method: Literal["told", "retold", "edited"] | None = Field(
        default=None, description="'told', 'retold', 'edited' or null"
    )

    @model_validator(mode="after")
    def _spans_lie_in_the_text(self) -> "_InstructionLine":
        for number, span in enumerate(self.spans):
            if not span.start <= span.end <= len(self.text):
                raise ValueError(
                    f"field 'spans.{number}': expected start <= end <= "
                    f"{len(self.text)}, the length of the text, got {span.start} and "
                    f"{span.end}"
                )
        return self


def parse_line(
    line: str, place: str
) -> tuple[Instruction | None, list[str], list[str]]:
    """Read one line.

    Returns:
        The instruction, or None where something is wrong; the names of fields that
        the format does not know; and what is wrong, one entry per field.
    """
    try:
        record = parse_json(line)
        if not isinstance(record, dict):
            raise ValueError(f"expected one JSON record {{…}}, got {_shown(record)}")
        record = cast(dict[str, Any], record)
        unknown = _unknown_fields(record)
        return _instruction(record, place), unknown, []
    except ValidationError as error:
        return None, [], _explain(error)
    except ValueError as error:
        return None, [], [str(error)]


def instruction_record(instruction: Instruction) -> dict[str, Any]:
    """Return the JSON record of an instruction, which `parse_line` reads back."""
    record = asdict(instruction)
    del record["origin"]
    for optional in ("original_text", "followers", "pair", "spans", "method"):
        if not record[optional] and record[optional] != "":
            del record[optional]
    return record


def _unknown_fields(record: dict[str, Any]) -> list[str]:
    known = _InstructionLine.model_fields
    unknown = [name for name in record if name not in known]
    unset = [name for name in known if name not in record]
    for name in unknown:
        meant = did_you_mean(name, unset, cutoff=0.75)
        if meant:
            raise ValueError(f"field {name!r} is unknown{meant}")
    return unknown


def _instruction(record: dict[str, Any], place: str) -> Instruction:
    line = _InstructionLine.model_validate(record)
    return Instruction(
        id=line.id,
        site=line.site,
        route=line.route,
        study=line.study,
        iteration=line.iteration,
        participant=line.participant,
        text=line.text,
        reference_route=line.reference_route,
        failures=tuple(Failure(f.kind, f.where, f.detail) for f in line.failures),
        source=line.source,
        language=line.language,
        split=line.split,
        original_text=line.original_text,
        followers=line.followers and Followers(**line.followers.model_dump()),
        pair=line.pair,
        spans=tuple(Span(**span.model_dump()) for span in line.spans),
        method=line.method,
        origin=place,
    )


def _expected_at(location: tuple[int | str, ...]) -> str:
    """Return what the format expects at a place in a record."""
    *outer, name = location
    model: type[BaseModel] = _InstructionLine
    if outer:
        parts = {"followers": _FollowersLine, "spans": _SpanLine}
        model = parts.get(str(outer[0]), _FailureLine)
    field = model.model_fields.get(str(name))
    return (field.description if field else None) or "a record with its fields"


def _explain(error: ValidationError) -> list[str]:
    said: list[str] = []
    for detail in error.errors():
        if not detail["loc"]:
            said.append(
                str(detail["ctx"]["error"]) if "ctx" in detail else detail["msg"]
            )
            continue
        name = ".".join(str(part) for part in detail["loc"])
        expected = _expected_at(detail["loc"])
        if detail["type"] == "missing":
            said.append(f"field {name!r} is missing: expected {expected}")
        else:
            got = _shown(detail["input"])
            if detail["type"] == "string_unicode":
                expected = "text without halves of characters"
            said.append(f"field {name!r}: expected {expected}, got {got}")
    return said


def _shown(value: object) -> str:
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    cut = text if len(text) <= 60 else text[:57] + "…"
    shown = repr(cut) if isinstance(value, str) else cut
    return shown.encode("utf-8", "backslashreplace").decode()
