"""Zero-shot detection models of Hugging Face `transformers`, such as Grounding DINO.

Needs the extra `detector` (torch and transformers), imported when a model is loaded.
"""

import copy
import inspect
import os
from dataclasses import KW_ONLY, dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.errors import DetectorError, SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.robot.perception.picture_detector import FoundBox

DEFAULT_CHECKPOINT = "IDEA-Research/grounding-dino-tiny"


@dataclass(eq=False)
class ZeroShotFinder:
    """Any zero-shot object detection checkpoint, loaded when it is first used.

    Grounding DINO and its kin read the words as a sentence (`vending machine.`); OWL-ViT
    and the like get them as one label. What the model calls a thing comes back as label.
    """

    checkpoint: str = DEFAULT_CHECKPOINT
    """A folder, or a name in the Hugging Face cache of this machine."""
    _: KW_ONLY
    box_threshold: float = 0.35
    """Least score of a box, 0 to 1."""
    text_threshold: float = 0.25
    """Least score of a word to be part of the label; models without it ignore it."""
    device: str = "auto"
    """`cpu`, `cuda`, `cuda:1`, …; `auto` takes a GPU where there is one."""
    download: bool = False
    """Whether a checkpoint that is not on this machine may be fetched."""

    def check(self) -> None:
        """Load the model, to find out early what is wrong."""
        _ = self._loaded

    def with_thresholds(
        self, box_threshold: float, text_threshold: float
    ) -> "ZeroShotFinder":
        """Return the same model, loaded once for both, with other thresholds."""
        self.check()
        other = copy.copy(self)
        other.box_threshold, other.text_threshold = box_threshold, text_threshold
        return other

    def find(self, rgb: NDArray[np.uint8], query: str) -> list[FoundBox]:
        """Return what fits the words; see `ObjectFinder.find`."""
        words = _plain(query)
        if not words:
            return []
        loaded = self._loaded
        try:
            return self._found(loaded, rgb, words)
        except (RuntimeError, ValueError, IndexError) as error:
            raise DetectorError(
                f"detector {self.checkpoint!r} failed on {query!r}: {_one_line(error)}"
            ) from error

    def _found(
        self, loaded: "_Loaded", rgb: NDArray[np.uint8], words: str
    ) -> list[FoundBox]:
        import torch
        from PIL import Image

        sentence = f"{words}." if loaded.reads_sentences else [[words]]
        inputs = loaded.processor(
            images=Image.fromarray(rgb),
            text=sentence,
            return_tensors="pt",
            truncation=True,
        ).to(loaded.device)
        with torch.inference_mode():
            outputs = loaded.model(**inputs)
        offered = {
            "threshold": self.box_threshold,
            "text_threshold": self.text_threshold,
            "target_sizes": [rgb.shape[:2]],
            "input_ids": inputs.get("input_ids"),
            "text_labels": None if loaded.reads_sentences else [[words]],
        }
        # Each family of models takes some of these, by the same names.
        asked = {k: v for k, v in offered.items() if k in loaded.takes}
        [found] = loaded.processor.post_process_grounded_object_detection(
            outputs, **asked
        )
        labels = found.get("text_labels") or [words] * len(found["scores"])
        return [
            FoundBox(
                (float(box[0]), float(box[1]), float(box[2]), float(box[3])),
                loaded.label(str(label)) or words,
                float(score),
            )
            for box, label, score in zip(
                found["boxes"].tolist(), labels, found["scores"].tolist(), strict=True
            )
        ]

    @cached_property
    def _loaded(self) -> "_Loaded":
        require_extra(
            "detector", "torch", "transformers", purpose="detector grounding-dino"
        )
        path = self.checkpoint
        is_folder = os.path.isabs(path) or path.startswith(".")
        if is_folder and not os.path.isdir(path):
            raise _unusable(path, "there is no such folder")
        return _Loaded(self.checkpoint, self.device, self.download)


class _Loaded:
    """A model in memory, with what its family wants."""

    def __init__(self, checkpoint: str, device: str, download: bool) -> None:
        from transformers import (
            AutoModelForZeroShotObjectDetection,
            AutoProcessor,
        )
        from transformers.utils import logging

        self.device = _device(device)
        logging.disable_progress_bar()
        local = {"local_files_only": not download}
        try:
            self.processor: Any = AutoProcessor.from_pretrained(checkpoint, **local)
            model: Any = AutoModelForZeroShotObjectDetection.from_pretrained(
                checkpoint, **local
            )
        except (OSError, ValueError, KeyError) as error:
            raise _not_there(checkpoint, download, error) from error
        self.model = model.to(self.device).eval()
        process = getattr(
            self.processor, "post_process_grounded_object_detection", None
        )
        if process is None:
            raise SettingsError(
                f"detector grounding-dino: {checkpoint!r} is a "
                f"{type(self.processor).__name__}, which finds no objects by name; "
                "expected a zero-shot object detection checkpoint"
            )
        self.takes = frozenset(inspect.signature(process).parameters)
        self.reads_sentences = "text_threshold" in self.takes

    def label(self, text: str) -> str:
        """Return a label without the marks that tokenizers leave in it."""
        for mark in self.processor.tokenizer.all_special_tokens:
            text = text.replace(mark, " ")
        return " ".join(text.replace(".", " ").split())


def _device(name: str) -> str:
    import torch

    if name == "auto":
        return "cuda" if torch.cuda.is_available() else "cpu"
    try:
        device = torch.device(name)
        torch.zeros(1, device=device)
    except (RuntimeError, AssertionError) as error:
        raise SettingsError(
            f"detector grounding-dino: device {name!r} cannot be used here "
            f"({_one_line(error)}); take device=cpu or device=auto"
        ) from error
    return str(device)


def _not_there(checkpoint: str, download: bool, error: Exception) -> SettingsError:
    why = f" ({_one_line(error)})"
    if os.path.isdir(checkpoint):
        what = "the folder holds no checkpoint that can be loaded" + why
    elif download:
        what = "it could not be fetched" + why
    else:
        what = (
            "it is not on this machine. Give a folder, or let it be fetched with "
            "download=true"
        )
    return _unusable(checkpoint, what)


def _unusable(checkpoint: str, what: str) -> SettingsError:
    return SettingsError(
        "detector grounding-dino: expected a zero-shot object detection checkpoint, a "
        f"folder or a name in the Hugging Face cache, got {checkpoint!r}: {what}"
    )


def _plain(query: str) -> str:
    """Return words in lower case; a full stop would begin another label."""
    # Words may hold halves of characters, which no tokenizer takes.
    whole = query.encode("utf-8", "replace").decode("utf-8")
    words = whole.lower().replace(".", " ").split()
    return " ".join(words)


def _one_line(error: BaseException) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0][:200]
