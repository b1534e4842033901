"""The eyes of a run: which detector and which reader of signs, made for each episode."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np

from memorymaze.errors import SettingsError, did_you_mean
from memorymaze.perception.detector import Detector, TruthDetector
from memorymaze.perception.error_model import ErrorModel, ErrorSource
from memorymaze.perception.grounding_dino import DEFAULT_CHECKPOINT, ZeroShotFinder
from memorymaze.perception.picture_detector import PictureDetector
from memorymaze.perception.remote_detector import RemoteFinder
from memorymaze.perception.sign_reading import SignReader, TruthSignReader
from memorymaze.robot.api import DETECTION_RANGE

DetectorName = Literal["truth", "grounding-dino", "remote"]
SignSource = Literal["truth", "ocr"]


@dataclass(frozen=True, slots=True)
class DetectorSettings:
    """Which detector a run has, and how it is set.

    Raises:
        SettingsError: A value has no meaning; the message names it and the range.
    """

    name: DetectorName = "truth"
    """What it is."""
    errors: ErrorModel | None = None
    """Mistakes of `truth`; None makes none."""
    checkpoint: str | None = None
    """Of `grounding-dino`: a folder, or a name in the Hugging Face cache."""
    url: str | None = None
    """Of `remote`: address of the server."""
    box_threshold: float = 0.35
    """Least score of a box, 0 to 1; not for `truth`."""
    text_threshold: float = 0.25
    """Least score of a word to be part of the label, 0 to 1; not for `truth`."""
    device: str = "auto"
    """Of `grounding-dino`: `cpu`, `cuda`, …; `auto` takes a GPU where there is one."""
    download: bool = False
    """Of `grounding-dino`: whether the checkpoint may be fetched."""
    timeout: float = 60.0
    """Of `remote`: seconds to wait for each part of a reply."""

    def __post_init__(self) -> None:
        """Check every value."""
        if self.name not in get_args(DetectorName):
            raise SettingsError(
                f"detector: expected one of {', '.join(get_args(DetectorName))}; got "
                f"{self.name!r}"
            )
        for name in ("box_threshold", "text_threshold"):
            value = getattr(self, name)
            if not 0 <= value <= 1:
                raise SettingsError(
                    f"detector setting {name}: expected a number from 0 to 1, got "
                    f"{value!r}"
                )
        if not 0 < self.timeout <= 86_400:
            raise SettingsError(
                "detector setting timeout: expected more than 0 and at most 86400 "
                f"seconds, got {self.timeout!r}"
            )
        if self.name == "remote" and not self.url:
            raise SettingsError(
                "detector remote: expected the address of a server, such as "
                "remote:http://localhost:8000/"
            )

    @property
    def short_name(self) -> str:
        """What tables call it: `detector grounding-dino`, `detector with mistakes`."""
        if self.name == "truth":
            return "detector" if self.errors is None else "detector with mistakes"
        return f"detector {self.name}"

    def __str__(self) -> str:
        """Return it as the command line takes it, with what differs from the default."""
        if self.name == "truth":
            if self.errors is None:
                return "truth"
            return "truth:" + ",".join(
                f"{each.name}={getattr(self.errors, each.name):g}"
                for each in fields(self.errors)
            )
        where = self.url if self.name == "remote" else self.checkpoint
        plain = DetectorSettings(self.name, url=self.url)
        changed = [
            f"{name}={_told(getattr(self, name))}"
            for name in _SETTINGS[self.name]
            if getattr(self, name) != getattr(plain, name)
        ]
        return ":".join([
            self.name,
            ",".join([*filter(None, [where]), *changed]),
        ]).rstrip(":")


TRUTH = DetectorSettings()
"""The default: a detector that knows the truth and makes no mistakes."""


_SETTINGS: Mapping[str, Mapping[str, type]] = {
    "truth": {each.name: float for each in fields(ErrorModel)},
    "grounding-dino": {
        "box_threshold": float,
        "text_threshold": float,
        "device": str,
        "download": bool,
    },
    "remote": {"box_threshold": float, "text_threshold": float, "timeout": float},
}
"""Settings that each detector has on the command line."""


def parse_detector(text: str) -> DetectorSettings:
    """Read a detector as the command line gives it: `NAME` or `NAME:SETTINGS`.

    `truth`, `truth:miss=0.2,phantoms=0`, `grounding-dino:path/to/checkpoint,device=cpu`,
    `remote:http://localhost:8000/,box_threshold=0.4`. Naming any setting of `truth`
    switches its error model on; `truth:` with the word `errors` takes its defaults.

    Raises:
        SettingsError: There is no such detector or setting, or a value has no meaning.
    """
    name, _, rest = text.partition(":")
    known = get_args(DetectorName)
    if name not in known:
        raise SettingsError(
            f"detector: expected one of {', '.join(known)}, with settings after a "
            f"colon, got {name!r}{did_you_mean(name, known)}"
        )
    parts = [part.strip() for part in rest.split(",") if part.strip()]
    first: str | None = None
    if parts and (name == "remote" or "=" not in parts[0]):
        first = parts.pop(0)
    values = dict(_setting(name, part) for part in parts)
    if name == "truth":
        if first is not None and first != "errors":
            raise SettingsError(
                "detector truth: expected settings such as miss=0.1, or `errors` for "
                f"the usual ones (there are {', '.join(_SETTINGS['truth'])}), got "
                f"{first!r}"
            )
        on = first is not None or bool(values)
        return DetectorSettings("truth", errors=ErrorModel(**values) if on else None)
    if name == "remote":
        return DetectorSettings("remote", url=first, **values)
    return DetectorSettings(
        "grounding-dino", checkpoint=first or DEFAULT_CHECKPOINT, **values
    )


def _setting(detector: str, part: str) -> tuple[str, Any]:
    name, equals, value = (piece.strip() for piece in part.partition("="))
    known = _SETTINGS[detector]
    if not equals or name not in known:
        raise SettingsError(
            f"detector {detector}: expected NAME=VALUE (there are {', '.join(known)}), "
            f"got {part!r}{did_you_mean(name, known)}"
        )
    kind = known[name]
    if kind is str:
        return name, value
    if kind is bool:
        if value not in {"yes", "no"}:
            raise SettingsError(
                f"detector {detector}: expected yes or no for {name}, got {value!r}"
            )
        return name, value == "yes"
    try:
        return name, float(value)
    except ValueError:
        raise SettingsError(
            f"detector {detector}: expected a number for {name}, got {value!r}"
        ) from None


def _told(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)


def parse_signs(text: str) -> SignSource:
    """Read the source of signs as the command line gives it.

    Raises:
        SettingsError: It is none.
    """
    for known in get_args(SignSource):
        if text == known:
            return known
    raise SettingsError(
        f"signs: expected one of {', '.join(get_args(SignSource))}; got {text!r}"
    )


@dataclass
class Eyes:
    """Makes the detector and the reader of signs of each episode.

    Models are loaded once, when they are first used, and serve all episodes of a
    process.
    """

    detector: DetectorSettings = TRUTH
    """Which detector."""
    signs: SignSource = "truth"
    """Where `read_signs` knows texts from."""

    @property
    def need_pictures(self) -> bool:
        """Whether anything is drawn for them."""
        return self.detector.name != "truth" or self.signs != "truth"

    def check(self) -> None:
        """Find out early what is missing: packages, a checkpoint, a server.

        Raises:
            SettingsError: Something is.
        """
        if self.detector.name != "truth":
            self._finder.check()
        if self.signs == "ocr":
            self._recognizer.check()

    def detector_for(
        self, rng: np.random.Generator, range_limit: float = DETECTION_RANGE
    ) -> Detector:
        """Make the detector of an episode.

        Args:
            rng: Source of its mistakes; used where it makes any.
            range_limit: Metres.
        """
        if self.detector.name != "truth":
            return PictureDetector(self._finder, range_limit)
        model = self.detector.errors
        errors = None if model is None else ErrorSource(model, rng)
        return TruthDetector(range_limit, errors)

    def sign_reader(self) -> SignReader:
        """Make the reader of signs of an episode."""
        if self.signs == "truth":
            return TruthSignReader()
        from memorymaze.perception.sign_reading import PictureSignReader

        return PictureSignReader(self._recognizer)

    @cached_property
    def _finder(self) -> ZeroShotFinder | RemoteFinder:
        settings = self.detector
        if settings.name == "remote":
            return RemoteFinder(
                settings.url or "",
                box_threshold=settings.box_threshold,
                text_threshold=settings.text_threshold,
                timeout=settings.timeout,
            )
        return ZeroShotFinder(
            settings.checkpoint or DEFAULT_CHECKPOINT,
            box_threshold=settings.box_threshold,
            text_threshold=settings.text_threshold,
            device=settings.device,
            download=settings.download,
        )

    @cached_property
    def _recognizer(self) -> Any:
        from memorymaze.perception.sign_reading import TextRecognizer

        return TextRecognizer()
