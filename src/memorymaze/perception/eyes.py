"""The eyes of a run: its detector and its reader of signs, made for each episode."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, get_args

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.perception.detector import Detector
from memorymaze.perception.detector_settings import TRUTH, DetectorSettings
from memorymaze.perception.error_model import ErrorSource
from memorymaze.perception.grounding_dino import DEFAULT_CHECKPOINT, ZeroShotFinder
from memorymaze.perception.picture_detector import PictureDetector
from memorymaze.perception.remote_detector import RemoteFinder
from memorymaze.perception.sign_reading import SignReader, TruthSignReader
from memorymaze.perception.truth_detector import TruthDetector
from memorymaze.robot.api import DETECTION_RANGE

SignSource = Literal["truth", "ocr"]


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
        from memorymaze.perception.ocr import PictureSignReader

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
        from memorymaze.perception.ocr import TextRecognizer

        return TextRecognizer()
