"""From a plan's file to checked features; what they mean is in `conversion.py`."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar, cast

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from memorymaze.sites.plan_models import FEATURE_MODELS, FeatureModel, PlanHeader
from memorymaze.sites.problems import SiteProblem

__all__ = ["PLAN", "PlanContent", "read_plan"]

Model = TypeVar("Model", bound=BaseModel)

PLAN = "-"
"""Stands for the plan as a whole where a problem names its feature."""


@dataclass(frozen=True, slots=True)
class PlanContent:
    """What could be read of a plan."""

    header: PlanHeader | None
    """None when it is unusable."""
    features: tuple[FeatureModel, ...]
    """Those whose members are all there and of the right types."""
    broken: frozenset[str]
    """Ids of features that are in the file but not among `features`."""
    problems: tuple[SiteProblem, ...]


def read_plan(path: Path) -> PlanContent:
    """Read a plan's file and every feature in it that can be understood.

    Never raises: whatever is wrong, from a missing file to a wrong word, is among
    `problems`.
    """
    file = str(path)
    document = _read_document(path)
    if isinstance(document, SiteProblem):
        return PlanContent(None, (), frozenset(), (document,))
    problems: list[SiteProblem] = []
    header = _validated(PlanHeader, document, file, PLAN, problems)
    features: list[FeatureModel] = []
    broken: set[str] = set()
    seen: set[str] = set()
    for index, raw in enumerate(_raw_features(document, file, problems)):
        label = _label(raw, index)
        model = _feature_model(raw, file, label, problems)
        feature = model and _validated(model, raw, file, label, problems)
        if label in seen:
            problems.append(
                SiteProblem(
                    file,
                    label,
                    "unique-id",
                    "error",
                    f"expected an id of its own for every feature, got {label!r} "
                    "twice; rename one",
                )
            )
        elif feature:
            features.append(feature)
        else:
            broken.add(label)
        seen.add(label)
    return PlanContent(header, tuple(features), frozenset(broken), tuple(problems))


def _read_document(path: Path) -> Mapping[str, object] | SiteProblem:
    def problem(rule: str, message: str) -> SiteProblem:
        return SiteProblem(str(path), PLAN, rule, "error", message)

    try:
        if path.is_dir():
            return problem("readable", "expected a GeoJSON file, got a directory")
        if path.exists() and not path.is_file():
            return problem("readable", "expected a GeoJSON file, got a device or pipe")
        text = path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError:
        return problem("readable", "expected a GeoJSON file, got none: no such file")
    except UnicodeDecodeError as error:
        return problem(
            "readable",
            "expected text in UTF-8, got other bytes at position "
            f"{error.start}; save the plan as GeoJSON in UTF-8",
        )
    except (OSError, ValueError) as error:
        return problem("readable", f"expected a readable file, got: {error}")
    if not text.strip():
        return problem("json", "expected a GeoJSON document, got an empty file")
    try:
        document: object = json.loads(text)
    except json.JSONDecodeError as error:
        return problem(
            "json",
            f"expected JSON, got a mistake in line {error.lineno}, column "
            f"{error.colno}: {error.msg}",
        )
    except RecursionError:
        return problem("json", "expected JSON, got brackets nested too deep to read")
    except ValueError as error:
        return problem("json", f"expected JSON, got a number out of bounds: {error}")
    if not isinstance(document, dict):
        return problem(
            "json",
            'expected {"type": "FeatureCollection", …} at the top, got '
            f"{shown(document)}",
        )
    return cast(Mapping[str, object], document)


def _raw_features(
    document: Mapping[str, object], file: str, problems: list[SiteProblem]
) -> Sequence[object]:
    features = document.get("features")
    if isinstance(features, list) and features:
        return cast(Sequence[object], features)
    got = shown(features) if "features" in document else "nothing"
    problems.append(
        SiteProblem(
            file,
            PLAN,
            "members",
            "error",
            f"features: expected a list of at least one feature, got {got}",
        )
    )
    return ()


def _label(raw: object, index: int) -> str:
    """Return a feature's id, or its place in the file when it has none."""
    identity = cast(dict[str, object], raw).get("id") if isinstance(raw, dict) else None
    if not isinstance(identity, str) or not identity:
        return f"features[{index}]"
    return identity.encode("utf-8", "backslashreplace").decode()


def _feature_model(
    raw: object, file: str, label: str, problems: list[SiteProblem]
) -> type[FeatureModel] | None:
    """Return the model of the feature's kind, or note why there is none."""

    def problem(rule: str, message: str) -> None:
        problems.append(SiteProblem(file, label, rule, "error", message))

    if not isinstance(raw, dict):
        problem("members", f"expected a feature object, got {shown(raw)}")
        return None
    properties = cast(dict[str, object], raw).get("properties")
    if not isinstance(properties, dict):
        problem(
            "members",
            f'properties: expected an object with "kind", got {shown(properties)}',
        )
        return None
    kind = cast(dict[str, object], properties).get("kind")
    model = FEATURE_MODELS.get(kind) if isinstance(kind, str) else None
    if model is None:
        problem(
            "known-kind",
            f"properties.kind: expected one of {', '.join(FEATURE_MODELS)}, got "
            f"{shown(kind) if 'kind' in properties else 'nothing'}",
        )
    return model


def _validated(
    model: type[Model], raw: object, file: str, label: str, problems: list[SiteProblem]
) -> Model | None:
    try:
        return model.model_validate(raw)
    except ValidationError as error:
        problems.extend(
            SiteProblem(file, label, "members", "error", _sentence(detail))
            for detail in error.errors(include_url=False)
        )
        return None


def _sentence(detail: ErrorDetails) -> str:
    """Say where a value is, what was expected there, and what came."""
    where = ""
    for step in detail["loc"]:
        where += f"[{step}]" if isinstance(step, int) else f".{step}"
    where = where.lstrip(".")
    if detail["type"] == "missing":
        return (
            f"{where}: expected this member, got none; add it (null only where allowed)"
        )
    wanted = detail["msg"]
    for opening in ("Input should be ", "List should ", "String should "):
        wanted = wanted.removeprefix(opening)
    return f"{where}: expected {wanted}, got {shown(detail['input'])}"


def shown(value: object) -> str:
    """Return a value as JSON, cut to a length that fits a message."""
    text = json.dumps(value, default=repr)
    return text if len(text) <= 60 else text[:57] + "…"
