"""The eyes of a run: which detector and which reader of signs, made for each episode."""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Literal

import numpy as np

from memorymaze.basics.errors import SettingsError, did_you_mean
from memorymaze.basics.options import check_number, parse_options, write_options
from memorymaze.robot.api.control import DETECTION_RANGE
from memorymaze.robot.perception.detector import Detector, TruthDetector
from memorymaze.robot.perception.error_model import ErrorModel, ErrorSource
from memorymaze.robot.perception.grounding_dino import (
    DEFAULT_CHECKPOINT,
    ZeroShotFinder,
)
from memorymaze.robot.perception.own_finder import make_own_finder
from memorymaze.robot.perception.picture_detector import ObjectFinder, PictureDetector
from memorymaze.robot.perception.sign_reading import (
    PictureSignReader,
    SignReader,
    TextRecognizer,
    TruthSignReader,
)

DETECTORS = ("truth", "grounding-dino")
"""Those that come with the package."""
SignSource = Literal["truth", "ocr"]


@dataclass(frozen=True, slots=True)
class DetectorSettings:
    """Which detector a run has, and how it is set."""

    name: str = "truth"
    """From `DETECTORS`, or `module:Class` or `file.py:Class` of a finder of one's own."""
    errors: ErrorModel | None = None
    """Mistakes of `truth`; None makes none."""
    checkpoint: str | None = None
    """Of `grounding-dino`: a folder, or a name in the Hugging Face cache."""
    box_threshold: float = 0.35
    """Of `grounding-dino`: least score of a box, 0 to 1."""
    text_threshold: float = 0.25
    """Of `grounding-dino`: least score of a word to be part of the label, 0 to 1."""
    device: str = "auto"
    """Of `grounding-dino`: `cpu`, `cuda`, …; `auto` takes a GPU where there is one."""
    download: bool = False
    """Of `grounding-dino`: whether the checkpoint may be fetched."""
    options: str = ""
    """Of one's own: `NAME=VALUE,NAME=VALUE`."""

    def __post_init__(self) -> None:
        """Check every value."""
        if self.name not in DETECTORS and not self.is_own:
            raise SettingsError(
                f"detector: expected one of {', '.join(DETECTORS)}, with settings after a "
                "colon, or a finder of your own as module:Class or file.py:Class, got "
                f"{self.name!r}{did_you_mean(self.name, DETECTORS)}"
            )
        for name in ("box_threshold", "text_threshold"):
            check_number(f"detector setting {name}", getattr(self, name), 0, 1)

    @property
    def is_own(self) -> bool:
        """Whether it is a finder of a user's own."""
        return self.name.rpartition(":")[2].isidentifier() and ":" in self.name

    @property
    def short_name(self) -> str:
        """What tables call it: `detector grounding-dino`, `detector with mistakes`."""
        if self.name == "truth":
            return "detector" if self.errors is None else "detector with mistakes"
        return f"detector {self.name.rpartition('/')[2]}"

    def __str__(self) -> str:
        """Return it as the command line takes it, with what differs from the default."""
        if self.name == "truth":
            if self.errors is None:
                return "truth"
            return "truth:" + write_options(self.errors)
        if self.is_own:
            return f"{self.name},{self.options}".rstrip(",")
        changed = write_options(self, _SETTINGS, changed_from=TRUTH)
        settings = ",".join(filter(None, [self.checkpoint, changed]))
        return f"{self.name}:{settings}".rstrip(":")


TRUTH = DetectorSettings()
"""The default: a detector that knows the truth and makes no mistakes."""


_SETTINGS = ("box_threshold", "text_threshold", "device", "download")
"""Those of `grounding-dino` on the command line."""


def parse_detector(text: str) -> DetectorSettings:
    """Read a detector as the command line gives it: `NAME` or `NAME:SETTINGS`.

    `truth`, `truth:miss=0.2,phantoms=0`, `grounding-dino:path/to/checkpoint,device=cpu`,
    or one's own, `my_finder.py:MyFinder,threshold=0.4`. Naming any setting of `truth`
    switches its error model on; `truth:` with the word `errors` takes its defaults.
    """
    name, _, rest = (part.strip() for part in text.partition(":"))
    if name == "remote" and rest.startswith("http"):
        raise SettingsError(
            "detector remote: is a finder of its own in examples/ now; give "
            f"detector=examples/remote_finder.py:RemoteFinder,url={rest}"
        )
    if name not in DETECTORS:
        place, _, options = (part.strip() for part in text.partition(","))
        return DetectorSettings(place, options=options)
    subject = f"detector {name}"
    where, _, settings = (part.strip() for part in rest.partition(","))
    if "=" in where:
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
    return parse_options(
        DetectorSettings, settings, subject=subject, start=start, only=_SETTINGS
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
        """Find out early what is missing: packages, a checkpoint, what one's own needs."""
        if self.detector.name != "truth":
            _ = self._finder
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
    def _finder(self) -> ObjectFinder:
        settings = self.detector
        if settings.is_own:
            return make_own_finder(settings.name, settings.options)
        finder = ZeroShotFinder(
            settings.checkpoint or DEFAULT_CHECKPOINT,
            box_threshold=settings.box_threshold,
            text_threshold=settings.text_threshold,
            device=settings.device,
            download=settings.download,
        )
        finder.check()
        return finder

    @cached_property
    def _recognizer(self) -> Any:
        return TextRecognizer()
