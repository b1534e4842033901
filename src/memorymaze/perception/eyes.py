"""The eyes of a run: which detector and which reader of signs, made for each episode."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from memorymaze.errors import SettingsError, did_you_mean
from memorymaze.options import check_number, parse_options, write_options
from memorymaze.perception.detector import Detector, TruthDetector
from memorymaze.perception.error_model import ErrorModel, ErrorSource
from memorymaze.perception.grounding_dino import DEFAULT_CHECKPOINT, ZeroShotFinder
from memorymaze.perception.picture_detector import PictureDetector
from memorymaze.perception.sign_reading import (
    PictureSignReader,
    SignReader,
    TextRecognizer,
    TruthSignReader,
)
from memorymaze.robot.api import DETECTION_RANGE

if TYPE_CHECKING:
    from memorymaze.perception.remote_detector import RemoteFinder

DetectorName = Literal["truth", "grounding-dino", "remote"]
SignSource = Literal["truth", "ocr"]


@dataclass(frozen=True, slots=True)
class DetectorSettings:
    """Which detector a run has, and how it is set."""

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
    """Of `remote`: seconds for a whole reply to come."""

    def __post_init__(self) -> None:
        """Check every value."""
        if self.name not in get_args(DetectorName):
            raise SettingsError(
                f"detector: expected one of {', '.join(get_args(DetectorName))}; got "
                f"{self.name!r}"
            )
        for name in ("box_threshold", "text_threshold"):
            check_number(f"detector setting {name}", getattr(self, name), 0, 1)
        check_number("detector setting timeout", self.timeout, above=0, most=86_400)
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
            return "truth:" + write_options(self.errors)
        where = self.url if self.name == "remote" else self.checkpoint
        plain = DetectorSettings(self.name, url=self.url)
        changed = write_options(self, _SETTINGS[self.name], changed_from=plain)
        return f"{self.name}:{','.join(filter(None, [where, changed]))}".rstrip(":")


TRUTH = DetectorSettings()
"""The default: a detector that knows the truth and makes no mistakes."""


_SETTINGS: Mapping[str, Sequence[str]] = {
    "grounding-dino": ("box_threshold", "text_threshold", "device", "download"),
    "remote": ("box_threshold", "text_threshold", "timeout"),
}
"""Settings that detectors which look have on the command line."""


def parse_detector(text: str) -> DetectorSettings:
    """Read a detector as the command line gives it: `NAME` or `NAME:SETTINGS`.

    `truth`, `truth:miss=0.2,phantoms=0`, `grounding-dino:path/to/checkpoint,device=cpu`,
    `remote:http://localhost:8000/,box_threshold=0.4`. Naming any setting of `truth`
    switches its error model on; `truth:` with the word `errors` takes its defaults.
    """
    name, _, rest = (part.strip() for part in text.partition(":"))
    known = get_args(DetectorName)
    if name not in known:
        raise SettingsError(
            f"detector: expected one of {', '.join(known)}, with settings after a "
            f"colon, got {name!r}{did_you_mean(name, known)}"
        )
    subject = f"detector {name}"
    where, _, settings = (part.strip() for part in rest.partition(","))
    if "=" in where and name != "remote":
        where, settings = "", rest
    if name == "truth":
        if where not in ("", "errors"):
            raise SettingsError(
                f"{subject}: expected settings such as miss=0.1, or `errors` for the "
                f"usual ones (there are {', '.join(each.name for each in fields(ErrorModel))})"
                f", got {where!r}"
            )
        errors = parse_options(ErrorModel, settings, subject=subject)
        return DetectorSettings(errors=errors if where or settings else None)
    start = DetectorSettings("grounding-dino", checkpoint=where or DEFAULT_CHECKPOINT)
    if name == "remote":
        start = DetectorSettings("remote", url=where)
    return parse_options(
        DetectorSettings, settings, subject=subject, start=start, only=_SETTINGS[name]
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
        """Find out early what is missing: packages, a checkpoint, a server."""
        if self.detector.name != "truth":
            self._finder.check()
        if self.signs == "ocr":
            self._recognizer.check()

    def detector_for(
        self, rng: np.random.Generator, range_limit: float = DETECTION_RANGE
    ) -> Detector:
        """Make the detector of an episode; its mistakes, if any, come from `rng`."""
        if self.detector.name != "truth":
            return PictureDetector(self._finder, range_limit)
        model = self.detector.errors
        errors = None if model is None else ErrorSource(model, rng)
        return TruthDetector(range_limit, errors)

    def sign_reader(self) -> SignReader:
        """Make the reader of signs of an episode."""
        if self.signs == "truth":
            return TruthSignReader()
        return PictureSignReader(self._recognizer)

    @cached_property
    def _finder(self) -> "ZeroShotFinder | RemoteFinder":
        settings = self.detector
        if settings.name == "remote":
            # Few runs need what checks a server's answers.
            from memorymaze.perception.remote_detector import RemoteFinder

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
        return TextRecognizer()
