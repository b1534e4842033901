"""Pictures for detectors, and checkpoints of real architectures that are tiny."""

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from memorymaze.basics.geometry.pose import Pose
from memorymaze.robot.api.steps import CameraPicture

WORDS = [
    "[PAD]",
    "[UNK]",
    "[CLS]",
    "[SEP]",
    "[MASK]",
    ".",
    "?",
    "door",
    "red",
    "chair",
    "vending",
    "machine",
    "sign",
]


def _write_grounding_dino(folder: Path) -> Path:
    """Write a Grounding DINO of 60 thousand weights with its processor."""
    import torch
    from transformers import (
        BertConfig,
        BertTokenizer,
        GroundingDinoConfig,
        GroundingDinoForObjectDetection,
        GroundingDinoImageProcessorPil,
        GroundingDinoProcessor,
        SwinConfig,
    )

    torch.manual_seed(7)
    config = GroundingDinoConfig(
        backbone_config=SwinConfig(
            image_size=64,
            embed_dim=8,
            depths=[1, 1, 1, 1],
            num_heads=[1, 1, 2, 2],
            window_size=2,
            out_features=["stage2", "stage3", "stage4"],
        ),
        text_config=BertConfig(
            vocab_size=len(WORDS),
            hidden_size=16,
            num_hidden_layers=1,
            num_attention_heads=2,
            intermediate_size=16,
            max_position_embeddings=64,
        ),
        d_model=32,
        encoder_layers=1,
        decoder_layers=2,
        encoder_attention_heads=2,
        decoder_attention_heads=2,
        encoder_ffn_dim=32,
        decoder_ffn_dim=32,
        num_queries=12,
        max_text_len=32,
    )
    GroundingDinoForObjectDetection(config).save_pretrained(folder)
    (folder / "vocab.txt").write_text("\n".join(WORDS), encoding="utf-8")
    GroundingDinoProcessor(
        GroundingDinoImageProcessorPil(size={"shortest_edge": 64, "longest_edge": 96}),
        BertTokenizer(str(folder / "vocab.txt")),
    ).save_pretrained(folder)
    return folder


def _write_owl_vit(folder: Path) -> Path:
    """Write an OWL-ViT, which reads labels and not sentences."""
    import json

    import torch
    from transformers import (
        CLIPTokenizer,
        OwlViTConfig,
        OwlViTForObjectDetection,
        OwlViTImageProcessorPil,
        OwlViTProcessor,
    )

    torch.manual_seed(7)
    letters = [chr(code) for code in range(97, 123)]
    tokens = [*letters, *(f"{each}</w>" for each in letters)]
    tokens += ["<|startoftext|>", "<|endoftext|>", "!"]
    config = OwlViTConfig(
        text_config={
            "vocab_size": len(tokens),
            "hidden_size": 16,
            "intermediate_size": 16,
            "num_hidden_layers": 1,
            "num_attention_heads": 2,
            "max_position_embeddings": 16,
            "bos_token_id": tokens.index("<|startoftext|>"),
            "eos_token_id": tokens.index("<|endoftext|>"),
            "pad_token_id": tokens.index("!"),
        },
        vision_config={
            "hidden_size": 16,
            "intermediate_size": 16,
            "num_hidden_layers": 1,
            "num_attention_heads": 2,
            "image_size": 64,
            "patch_size": 16,
        },
        projection_dim=16,
    )
    OwlViTForObjectDetection(config).save_pretrained(folder)
    (folder / "vocab.json").write_text(
        json.dumps({token: number for number, token in enumerate(tokens)}),
        encoding="utf-8",
    )
    (folder / "merges.txt").write_text("#version: 0.2\n", encoding="utf-8")
    OwlViTProcessor(
        OwlViTImageProcessorPil(size={"height": 64, "width": 64}),
        CLIPTokenizer(
            str(folder / "vocab.json"), str(folder / "merges.txt"), model_max_length=16
        ),
    ).save_pretrained(folder)
    return folder


@pytest.fixture(scope="session")
def grounding_dino(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a tiny Grounding DINO with random weights."""
    return _write_grounding_dino(tmp_path_factory.mktemp("grounding_dino"))


@pytest.fixture(scope="session")
def owl_vit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a tiny OWL-ViT with random weights."""
    return _write_owl_vit(tmp_path_factory.mktemp("owl_vit"))


class Wall:
    """A view of a wall 3 m ahead with boxes before it, each at a depth of its own."""

    def __init__(
        self, *boxes: tuple[tuple[int, int, int, int], float], pose: Pose | None = None
    ) -> None:
        self.pose = pose or Pose(0, 0, 0)
        self.boxes: Sequence[tuple[tuple[int, int, int, int], float]] = boxes
        self.drawn = 0

    def picture(
        self, width: int = 640, height: int = 480, horizontal_fov: float = math.pi / 2
    ) -> CameraPicture:
        self.drawn += 1
        rgb = np.full((height, width, 3), 128, dtype=np.uint8)
        depth = np.full((height, width), 3.0, dtype=np.float32)
        for (left, top, right, bottom), metres in self.boxes:
            depth[top:bottom, left:right] = metres
            rgb[top:bottom, left:right] = (200, 30, 30)
        return CameraPicture(rgb, depth)


@pytest.fixture
def wall() -> Callable[..., Wall]:
    """Makes views: `wall(((left, top, right, bottom), metres), …, pose=…)`."""
    return Wall
