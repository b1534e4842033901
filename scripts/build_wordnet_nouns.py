"""Build the noun data of `memorymaze.robot.perception` from WordNet's database files.

    apt-get install wordnet-base
    python scripts/build_wordnet_nouns.py /usr/share/wordnet

Writes `nouns.txt.gz`, byte for byte the same from the same WordNet. It keeps what
naming visible things needs: the nouns for physical things, what each is a kind of,
irregular plurals, and the common adjectives. Proper names, scientific names,
definitions and examples are left out. WordNet 3.0 is copyright Princeton University;
its licence is shipped beside the data as `WORDNET-LICENSE`.
"""

import argparse
import gzip
import sys
from pathlib import Path
from typing import NamedTuple

TARGET = Path(__file__).parent.parent / "src/memorymaze/language/data/nouns.txt.gz"

# The lexicographer files (lexnames(5WN)) that hold physical things: animal, artifact,
# body, food, object, person, plant and substance; and the tops of their trees.
PHYSICAL = {3, 5, 6, 8, 13, 17, 18, 20, 27}

# Meanings outside those files that one sees in buildings (word, number of its sense):
# public displays of a message, and balls.
EXTRA_ROOTS = (("globe", 2), ("sign", 2))


class Synset(NamedTuple):
    """One meaning and the words for it."""

    lexicographer_file: int
    words: tuple[str, ...]
    hypernyms: tuple[str, ...]
    is_instance: bool


def read_synsets(path: Path) -> dict[str, Synset]:
    """Read `data.noun`: byte offset to synset."""
    synsets: dict[str, Synset] = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("  "):
            continue
        fields = line.partition(" | ")[0].split()
        word_count = int(fields[3], 16)
        words = tuple(fields[4 : 4 + 2 * word_count : 2])
        first = 4 + 2 * word_count
        pointers = [
            (fields[first + 1 + 4 * i], fields[first + 2 + 4 * i])
            for i in range(int(fields[first]))
        ]
        synsets[fields[0]] = Synset(
            int(fields[1]),
            words,
            tuple(offset for symbol, offset in pointers if symbol == "@"),
            any(symbol == "@i" for symbol, _ in pointers),
        )
    return synsets


class Lemma(NamedTuple):
    """A word, its meanings in WordNet's order, and how many occur in its texts."""

    offsets: tuple[str, ...]
    tagged: int


def read_index(path: Path) -> dict[str, Lemma]:
    """Read an `index.*` file: lemma to meanings."""
    index: dict[str, Lemma] = {}
    for line in path.read_text(encoding="ascii").splitlines():
        if line.startswith("  "):
            continue
        fields = line.split()
        count = int(fields[2])
        offsets = fields[-count:]
        index[fields[0]] = Lemma(tuple(offsets), int(fields[-count - 1]))
    return index


def visible_synsets(
    synsets: dict[str, Synset], index: dict[str, Lemma]
) -> frozenset[str]:
    """Return the meanings that one can see: physical things, and the extra roots."""
    children: dict[str, list[str]] = {}
    for offset, synset in synsets.items():
        for parent in synset.hypernyms:
            children.setdefault(parent, []).append(offset)
    waiting = [index[word].offsets[sense - 1] for word, sense in EXTRA_ROOTS]
    visible = set(waiting)
    while waiting:
        new = [c for c in children.get(waiting.pop(), []) if c not in visible]
        visible.update(new)
        waiting.extend(new)
    visible.update(
        offset
        for offset, synset in synsets.items()
        if synset.lexicographer_file in PHYSICAL
        and not synset.is_instance
        and any(word == word.lower() for word in synset.words)
    )
    return frozenset(visible)


def with_kinds(synsets: dict[str, Synset], visible: frozenset[str]) -> dict[str, int]:
    """Number the meanings and all that they are kinds of."""
    kept = set(visible)
    waiting = list(visible)
    while waiting:
        new = [h for h in synsets[waiting.pop()].hypernyms if h not in kept]
        kept.update(new)
        waiting.extend(new)
    return {offset: number for number, offset in enumerate(sorted(kept))}


def noun_lines(
    synsets: dict[str, Synset],
    index: dict[str, Lemma],
    visible: frozenset[str],
    kept: dict[str, int],
) -> list[str]:
    """Return one line for each lemma: words, tab, meanings; `*` marks a common one."""
    lines: list[str] = []
    for lemma, entry in sorted(index.items()):
        senses: list[str] = []
        for rank, offset in enumerate(entry.offsets):
            if offset not in visible:
                continue
            if not any(w == lemma for w in synsets[offset].words):
                continue  # a proper or scientific name
            mark = "*" if rank < entry.tagged else ""
            senses.append(f"{kept[offset]}{mark}")
        if senses:
            lines.append(f"{lemma.replace('_', ' ')}\t{' '.join(senses)}")
    return lines


def plural_lines(path: Path, lemmas: set[str]) -> list[str]:
    """Return the irregular plurals of kept words: plural, tab, singular."""
    pairs = (line.split()[:2] for line in path.read_text("ascii").splitlines())
    return sorted(
        f"{plural}\t{singular}"
        for plural, singular in pairs
        if singular in lemmas and plural != singular and "_" not in plural
    )


def adjective_lines(adjectives: dict[str, Lemma], nouns: dict[str, Lemma]) -> list[str]:
    """Return common adjectives that are not more common as nouns."""
    return sorted(
        word
        for word, entry in adjectives.items()
        if "_" not in word
        and entry.tagged > 0
        and (word not in nouns or entry.tagged > nouns[word].tagged)
    )


def main() -> int:
    """Write the data file; return an exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("wordnet", type=Path, help="folder with data.noun, index.noun")
    folder: Path = parser.parse_args().wordnet
    synsets = read_synsets(folder / "data.noun")
    nouns = read_index(folder / "index.noun")
    visible = visible_synsets(synsets, nouns)
    kept = with_kinds(synsets, visible)
    words = noun_lines(synsets, nouns, visible, kept)
    lemmas = {line.partition("\t")[0] for line in words}
    sections = {
        "synsets": [
            " ".join(str(kept[h]) for h in synsets[offset].hypernyms) for offset in kept
        ],
        "nouns": words,
        "plurals": plural_lines(folder / "noun.exc", lemmas),
        "adjectives": adjective_lines(read_index(folder / "index.adj"), nouns),
    }
    text = "\f".join("\n".join(lines) for lines in sections.values())
    with (
        TARGET.open("wb") as raw,
        gzip.GzipFile("", "wb", compresslevel=9, fileobj=raw, mtime=0) as packed,
    ):
        packed.write(text.encode("ascii"))
    counts = ", ".join(f"{len(lines)} {name}" for name, lines in sections.items())
    print(f"{TARGET.name}: {counts}, {TARGET.stat().st_size} bytes", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
