"""From a plan's file to checked features; what they mean is in `loading.py`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar, cast

from pydantic import BaseModel, ValidationError

from memorymaze.basics.errors import SitePlanError
from memorymaze.basics.input_files import mistakes, parse_json, read_text, shown
from memorymaze.world.sites.plan_models import FEATURE_MODELS, AnyFeature, PlanHeader
from memorymaze.world.sites.problems import PLAN, Rule, SiteProblem

Model = TypeVar("Model", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class PlanContent:
    """What could be read of a plan."""

    header: PlanHeader | None
    """None when it is unusable."""
    features: tuple[AnyFeature, ...]
    """Those whose members are all there and of the right types."""
    broken: Mapping[str, str]
    """Kinds of the features in the file that are not among `features`, by id.

    The kind is empty where it is not known.
    """
    findings: tuple[SiteProblem, ...]


def read_plan(path: Path) -> PlanContent:
    """Read a plan's file and every feature in it that can be understood.

    Never raises: whatever is wrong, from a missing file to a wrong word, is among
    `findings`.
    """
    document = _read_document(path)
    if isinstance(document, SiteProblem):
        return PlanContent(None, (), {}, (document,))
    return understand_plan(document)


def understand_plan(document: Mapping[str, object]) -> PlanContent:
    """Return what can be understood of a plan that is already JSON."""
    findings: list[SiteProblem] = []
    header = _validated(PlanHeader, document, PLAN, findings)
    features: list[AnyFeature] = []
    broken: dict[str, str] = {}
    seen: set[str] = set()
    for index, raw in enumerate(_raw_features(document, findings)):
        label = _label(raw, index)
        model = _feature_model(raw, label, findings)
        feature = model and _validated(model, raw, label, findings)
        if label in seen:
            findings.append(
                SiteProblem(
                    label,
                    "unique-id",
                    f"expected an id of its own for every feature, got {label!r} "
                    "twice; rename one",
                )
            )
        elif feature:
            features.append(feature)
        else:
            broken[label] = _kind(raw) or ""
        seen.add(label)
    return PlanContent(header, tuple(features), broken, tuple(findings))


def _read_document(path: Path) -> Mapping[str, object] | SiteProblem:
    def finding(rule: Rule, message: str) -> SiteProblem:
        return SiteProblem(PLAN, rule, message)

    if path.is_dir():
        return finding("readable", "expected a GeoJSON file, got a directory")
    if path.exists() and not path.is_file():
        return finding("readable", "expected a GeoJSON file, got a device or pipe")
    try:
        text = read_text(path, SitePlanError)
    except SitePlanError as error:
        return finding("readable", str(error).removeprefix(f"{path}: "))
    if not text.strip():
        return finding("json", "expected a GeoJSON document, got an empty file")
    try:
        document = parse_json(text)
    except ValueError as error:
        return finding("json", str(error))
    if not isinstance(document, dict):
        return finding(
            "json",
            'expected {"type": "FeatureCollection", …} at the top, got '
            f"{shown(document)}",
        )
    return cast(Mapping[str, object], document)


def _raw_features(
    document: Mapping[str, object], findings: list[SiteProblem]
) -> Sequence[object]:
    features = document.get("features")
    if isinstance(features, list) and features:
        return cast(Sequence[object], features)
    got = shown(features) if "features" in document else "nothing"
    findings.append(
        SiteProblem(
            PLAN,
            "members",
            f"features: expected a list of at least one feature, got {got}",
        )
    )
    return ()


def _label(raw: object, index: int) -> str:
    """Return a feature's id, or its place in the file when it has none."""
    identity = cast(dict[str, object], raw).get("id") if isinstance(raw, dict) else None
    if not isinstance(identity, str) or not identity:
        return f"features[{index}]"
    return identity if identity.isprintable() else ascii(identity)


def _kind(raw: object) -> str | None:
    """Return a feature's kind where it is one of those there are."""
    properties = (
        cast(dict[str, object], raw).get("properties")
        if isinstance(raw, dict)
        else None
    )
    if not isinstance(properties, dict):
        return None
    kind = cast(dict[str, object], properties).get("kind")
    return kind if isinstance(kind, str) and kind in FEATURE_MODELS else None


def _feature_model(
    raw: object, label: str, findings: list[SiteProblem]
) -> type[AnyFeature] | None:
    """Return the model of the feature's kind, or note why there is none."""
    kind = _kind(raw)
    if kind is not None:
        return FEATURE_MODELS[kind]
    where, wanted, got = "", "a feature object", raw
    if isinstance(raw, dict):
        where, wanted = "properties: ", 'an object with "kind"'
        got = cast(dict[str, object], raw).get("properties")
        if isinstance(got, dict):
            where, wanted = "properties.kind: ", f"one of {', '.join(FEATURE_MODELS)}"
            got = cast(dict[str, object], got).get("kind")
    findings.append(
        SiteProblem(label, "known-kind", f"{where}expected {wanted}, got {shown(got)}")
    )
    return None


def _validated(
    model: type[Model], raw: object, label: str, findings: list[SiteProblem]
) -> Model | None:
    try:
        return model.model_validate(raw)
    except ValidationError as error:
        findings.extend(
            SiteProblem(label, "members", f"{where}: {said}")
            for where, said in mistakes(error)
        )
        return None
