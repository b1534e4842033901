"""Whether made-up texts have the counts of the paper's Table I, cell by cell.

`python -m benchmarks.made_texts [--per-cell N] [--seed N]` prints every cell beside the
published figures and ends with 1 where one is further off than the targets: failure and
alternative rates within 3 points, mean of words within 5 %, SD within 15 %.
"""

import argparse
import sys
import time

from memorymaze.texts.corpus.published import published_tables
from memorymaze.texts.corpus.statistics import describe_corpus
from memorymaze.texts.writing import (
    ErrorRates,
    cells_of,
    sample_outlines,
    write_texts,
)
from memorymaze.world.sites import load_sites

POINTS, MEAN, SD = 0.03, 0.05, 0.15
TITLE = "study   site        route it.  mean (paper)           SD (paper)             FR %           AR %"


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.made_texts")
    parser.add_argument("--per-cell", type=int, default=1000, metavar="N")
    parser.add_argument("--seed", type=int, default=0, metavar="N")
    options = parser.parse_args()
    sites, paper = load_sites(), published_tables().descriptions
    begun, far_off, texts = time.perf_counter(), 0, 0
    print(TITLE)
    for cell in [each for site in sites.values() for each in cells_of(site)]:
        wanted = sample_outlines(cell, ErrorRates(), options.per_cell, options.seed)
        made = [text for one in wanted for text in write_texts(one, paired=False)]
        texts += len(made)
        (found,) = describe_corpus(made, sites)
        key = (cell.study, cell.site, cell.route, cell.iteration)
        (goal,) = [
            each
            for each in paper
            if (each.study, each.site, each.route, each.iteration) == key
        ]
        alternative = goal.alternative_rate or 0.0
        mean, sd = found.words_mean / goal.words_mean, found.words_sd / goal.words_sd
        good = (
            abs(mean - 1) <= MEAN
            and abs(sd - 1) <= SD
            and abs(found.failure_rate - goal.failure_rate) <= POINTS
            and abs(found.alternative_rate - alternative) <= POINTS
        )
        far_off += not good
        print(
            f"{cell.study:7} {cell.site:11} {cell.route:5} {cell.iteration}   "
            f"{found.words_mean:6.1f} ({goal.words_mean:5.1f}) {mean - 1:+5.1%}  "
            f"{found.words_sd:6.1f} ({goal.words_sd:5.1f}) {sd - 1:+6.1%}  "
            f"{found.failure_rate:5.1%} ({goal.failure_rate:5.1%})  "
            f"{found.alternative_rate:5.1%} ({alternative:5.1%})"
            + ("" if good else "  FAR OFF"),
            flush=True,
        )
    took = time.perf_counter() - begun
    print(f"{texts} texts in {took:.0f} s; {far_off} cells far off", file=sys.stderr)
    return 1 if far_off else 0


if __name__ == "__main__":
    sys.exit(main())
