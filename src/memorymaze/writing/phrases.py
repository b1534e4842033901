"""The words of the grammar: how turns, ends of ways and destinations are told.

Slots: `{side}`, `{ord}`, `{thing}`, `{place}`, `{goal}`, `{there}`. What stands in
brackets says where; a pattern without brackets leaves that to the listener.
"""

from collections.abc import Mapping, Sequence

ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")

Patterns = Mapping[str, Sequence[str]]

TURNS: Mapping[str, Patterns] = {
    "first": {
        "terse": (
            "turn {side}",
            "[first] {side}",
            "take the [first] {side}",
            "[next] {side}",
            "{side} [at the first opening]",
        ),
        "plain": (
            "take the [first] {side}",
            "turn {side} [at the first opening]",
            "go straight and take the [next] {side}",
            "take the [first] way on the {side}",
            "go {side} [as soon as you can]",
            "make a {side} [at the first turning]",
            "walk on and take the [first] {side} you come to",
        ),
        "wordy": (
            "keep going until there is [a first] way off to the {side}, and take that",
            "[the first chance you get] to go {side}, take it",
            "walk on until you come to [the first opening] on the {side}, and turn in there",
            "go on until you can turn {side} [for the first time], and do that",
            "the very [first] turning on the {side} is the one you want",
        ),
    },
    "later": {
        "terse": (
            "[{ord}] {side}",
            "take the [{ord}] {side}",
            "{side} [at the {ord} opening]",
        ),
        "plain": (
            "take the [{ord}] {side}",
            "turn {side} [at the {ord} opening]",
            "go on and take the [{ord}] way on the {side}",
            "it is the [{ord}] {side} that you want",
            "walk on to the [{ord}] turning on the {side} and go in there",
        ),
        "wordy": (
            "you want the [{ord}] way on the {side}, not the one before it",
            "go on until you come to the [{ord}] opening on the {side}, and turn in there",
            "count the openings on the {side}, please, and take the [{ord}] one",
        ),
    },
    "end": {
        "terse": (
            "[at the end], {side}",
            "{side} [at the end]",
            "turn {side} [at the end]",
            "[end of {place}], {side}",
        ),
        "plain": (
            "go [to the end] and turn {side}",
            "[at the end of {place}], turn {side}",
            "walk [to the end of {place}] and go {side}",
            "turn {side} [where {place} ends]",
            "[when {place} ends], take a {side}",
            "follow {place} [all the way to the end] and turn {side}",
        ),
        "wordy": (
            "walk [until you cannot go any further], and there you turn {side}",
            "keep going [until there is a wall in front of you], then go {side}",
            "follow {place} [until it just stops], and go {side} from there",
            "[when you get to the end of {place}] you have to turn, and you turn {side}",
        ),
    },
    "forced": {
        "terse": (
            "{side} [at the corner]",
            "turn {side} [at the corner]",
            "{side} [round the corner]",
        ),
        "plain": (
            "follow {place} [round the corner] to the {side}",
            "[at the corner], turn {side}",
            "[where {place} bends], go {side}",
            "go straight [to the corner] and turn {side}",
            "keep to {place} and turn {side} [at the corner]",
        ),
        "wordy": (
            "you come [to a corner] with no other way, and it takes you {side}",
            "just stay on {place}, and [at the corner] it goes {side}",
            "walk on [until {place} turns a corner], to the {side}",
        ),
    },
    "thing": {
        "terse": (
            "{side} [at {thing}]",
            "[at {thing}], {side}",
            "turn {side} [at {thing}]",
        ),
        "plain": (
            "turn {side} [at {thing}]",
            "[when you get to {thing}], turn {side}",
            "[at {thing}], go {side}",
            "go on [as far as {thing}] and turn {side}",
            "walk up [to {thing}] and go {side} there",
            "take the {side} [by {thing}]",
        ),
        "wordy": (
            "keep walking [until you come to {thing}], and that is where you turn {side}",
            "go on until you see the way to the {side} [by {thing}], and take it",
            "what you are looking for is [{thing}], because that is where you go {side}",
            "straight on [as far as {thing}], and once you are there you go {side}",
        ),
    },
}

SPOKEN_TURNS: Patterns = {
    "first": (
        "you take the [first] {side}",
        "so it is the [first] one on the {side}",
        "you go along there and it is the [next] {side}",
        "[the first time you can] go {side}, you go {side}",
        "straight on a bit and then the [first] {side}",
        "that is where you go {side}, the [first] one",
    ),
    "later": (
        "you take the [{ord}] {side}, not earlier",
        "so it is the [{ord}] one on the {side}",
        "you keep going and it is the [{ord}] {side} you want",
        "straight past, and then the [{ord}] {side}",
    ),
    "end": (
        "you go [all the way to the end] and there you go {side}",
        "so straight on [till it ends], and {side}",
        "[at the very end], there you go {side}",
        "you walk down there [until you hit the wall] and it is {side}",
        "[when that is over], {side}",
    ),
    "forced": (
        "it goes round [a corner], to the {side}, so you just follow that",
        "then {place} goes {side} [at the corner], and you with it",
        "you get [to the corner] and go {side} there",
    ),
    "thing": (
        "you go [as far as {thing}], and there it is {side}",
        "so [at {thing}] you go {side}",
        "you will see [{thing}], and that is where you turn {side}",
        "there is the way to the {side} [by {thing}], you take that",
        "[by {thing}], yes, you turn {side} there",
    ),
}
"""Like the plain ones, in speech."""

SLIGHT: Mapping[str, Patterns] = {
    "place": {
        "terse": ("bear {side}", "slightly {side}", "keep {side}"),
        "plain": (
            "bear {side} [where {place} bends]",
            "go slightly {side} [at the bend]",
            "{place} bends a little to the {side} [there], follow it",
        ),
        "wordy": (
            "[a bit further on] {place} bends, and you go with it, slightly to the {side}",
            "you do not really turn, you just keep slightly {side} [where it bends]",
        ),
    },
    "thing": {
        "terse": ("bear {side} [at {thing}]",),
        "plain": ("bear {side} [at {thing}]", "[at {thing}], keep slightly {side}"),
        "wordy": ("go on [as far as {thing}] and bear slightly {side} there",),
    },
}

MERGED: Sequence[str] = (
    "and then immediately {side}",
    "and right after that {side}",
    "and then straight away {side}",
    "and almost at once {side}",
    "then {side} just after",
)
"""Follows a turn that another one follows within a few metres."""

SKIPPED: Sequence[str] = (
    "just follow {place} round",
    "stay on {place} wherever it goes",
    "go along {place}, it bends by itself",
    "follow along {place}",
)
"""For a corner without a choice that is left to the listener."""

ARRIVALS: Patterns = {
    "terse": (
        "{goal} is {there}",
        "{goal}, {there}",
        "then {goal}, {there}",
    ),
    "plain": (
        "go straight, and {goal} is {there}",
        "you will see {goal} {there}",
        "{goal} will be {there}",
        "keep going and {goal} is {there}",
        "from there it is straight on, and {goal} is {there}",
    ),
    "wordy": (
        "now you only have to go straight, and you will find {goal} {there}",
        "from here you just carry on straight until you reach {goal}, which is {there}",
        "that last bit is straight, and then there it is, {goal}, {there}",
    ),
}

ARRIVALS_BY: Patterns = {
    "terse": (
        "{goal} is by {thing}, {there}",
        "stop at {thing}, that is {goal}",
    ),
    "plain": (
        "go on to {thing}, {there}; that is {goal}",
        "{goal} is right by {thing}, {there}",
        "walk up to {thing} and you are at {goal}",
    ),
    "wordy": (
        "keep going until you get to {thing}, {there}, and then you have reached {goal}",
        "you will come to {thing}, {there}, and that is where {goal} is",
    ),
}
"""For a destination that is said to be at a thing."""
