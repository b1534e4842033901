"""Distinct words as tables: by place and study, and by counting rules."""

from memorymaze.instructions.statistics import COUNTING_RULES
from memorymaze.results.instruction_study.study import InstructionStudy
from memorymaze.results.instruction_study.study_table import StudyTable, place_title


def vocabulary_table(study: InstructionStudy) -> StudyTable:
    """Return the distinct words of every place and study; there is at least one."""
    equal = study.equal_words
    rows = [
        (
            place_title(each.place),
            each.study,
            str(each.texts),
            str(each.words),
            str(each.distinct[COUNTING_RULES[0].name])
            + (f" ({each.published})" if each.published else ""),
            f"{each.curve.at(equal):.0f}",
        )
        for each in sorted(
            study.vocabularies, key=lambda each: (each.place, each.study)
        )
    ]
    return StudyTable(
        "distinct_words",
        "Distinct words",
        ("place", "study", "texts", "words", "distinct", f"among {equal} words"),
        tuple(rows),
        2,
        (
            f"Words here are {COUNTING_RULES[0].says}. Published counts in brackets; the "
            "paper does not state its rule.",
            f"The last column compares equal amounts of text: distinct words among the "
            f"first {equal}, mean over 20 orders of the texts (type-token curve).",
        ),
    )


def rules_table(study: InstructionStudy) -> StudyTable:
    """Return published counts beside those by every rule; some place has them."""
    compared = sorted(
        (each for each in study.vocabularies if each.published),
        key=lambda each: (each.place, each.study),
    )
    misses = study.rule_misses()
    rows: list[tuple[str, ...]] = []
    for rule in COUNTING_RULES:
        miss = misses[rule.name]
        counts = [str(each.distinct[rule.name]) for each in compared]
        off = "-" if miss is None else f"{100 * miss:.0f}"
        rows.append((rule.name, *counts, off))
    rows.append(("published", *(str(each.published) for each in compared), ""))
    near = min((miss, name) for name, miss in misses.items() if miss is not None)
    more = [
        rule.name
        for rule in COUNTING_RULES
        if all(
            onsite.distinct[rule.name] > online.distinct[rule.name]
            for onsite in compared
            if onsite.study == "onsite"
            for online in compared
            if online.study == "online" and online.place == onsite.place
        )
    ]
    return StudyTable(
        "counting_rules",
        "Distinct words by the usual counting rules",
        (
            "rule",
            *(f"{place_title(each.place)} {each.study}" for each in compared),
            "off by %",
        ),
        tuple(rows),
        1,
        (
            f'On these texts the rule nearest to the published counts is "{near[1]}", off '
            f"by {100 * near[0]:.0f} % on average. These are other texts than the "
            "paper's, so this does not show which rule the paper used.",
            "The published counts are higher onsite than online; "
            + (
                f"here they are by: {', '.join(more)}."
                if more
                else "here they are not, by any of these rules."
            ),
            *(f"{rule.name}: {rule.says}." for rule in COUNTING_RULES),
        ),
    )
