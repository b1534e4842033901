"""What speakers say round the description: beginnings, endings, doubts, summaries."""

from collections.abc import Sequence

import numpy as np

from memorymaze.writing.asides import Aside
from memorymaze.writing.clauses import (
    is_command,
    one_of,
    spoken_as,
)
from memorymaze.writing.marked_text import mark, without_marks
from memorymaze.writing.voices import Voice

SPOKEN_BEGINNINGS = (
    "okay, so, to {goal}",
    "let me think for a moment",
    "right, {goal}, that is not so far",
    "hmm, {goal}, yes, I know where that is",
    "so you want to go to {goal}, is that right?",
    "I hope I can explain it",
    "oh, that is a bit of a maze, but I will try",
    "yes, sure, I can tell you how to get there",
)
SPOKEN_AGAIN = (
    "okay, I will go through it again, a bit slower",
    "right, once more from the beginning",
    "ah, sorry, then let me say it again properly",
    "okay, so for the robot I will try to be more exact",
    "all right, again, and this time with more detail",
)
TYPED_BEGINNINGS = (
    "this is how you get to {goal}",
    "the way to {goal} is as follows",
    "start by going straight ahead",
    "first go straight from where you are",
)
TYPED_AGAIN = (
    "here is the way again with more detail for the robot",
    "these are the directions for the robot, step by step",
    "the robot starts by going straight ahead",
)
SPOKEN_ENDINGS = (
    "you cannot miss it",
    "that is it, really",
    "does that help?",
    "good luck",
    "I hope that makes sense",
    "if you are not sure, ask somebody there",
    "and then you are there",
    "it sounds worse than it is",
)
TYPED_ENDINGS = (
    "you have arrived",
    "that is the destination",
    "stop there",
    "this is the end of the route",
)
SMALL_TALK = (
    "I walk there nearly every day and still I have to think about it",
    "I am not very good at explaining these things, sorry",
    "it all looks the same in there, to be honest",
    "I got lost there myself the first time",
    "there are usually a lot of people about, so take your time",
    "it is quite quiet round there in the mornings",
    "I am trying to picture it as I say this",
    "now where does that put us",
    "my sense of distance is terrible, so do not trust my numbers",
    "they changed a few things in there last year, but this should be the same",
    "you can hear your own steps there, it is that quiet",
    "I would walk with you, but I have to wait for somebody",
    "people always ask me this, you are not the first today",
    "it takes a few minutes, not more",
    "if you walk slowly you will be fine",
    "let me see that in my head again",
    "bear with me, I am walking it in my mind",
    "it is easier than it sounds when I say it",
    "I hope I have not forgotten anything",
    "somebody should put up better signs",
    "it echoes a bit in there, so you notice when the walls open up",
    "take it easy there, some people walk very fast",
    "that part I am quite sure about",
    "you will feel it when you are getting close",
)
TYPED_TALK = (
    "it is all on the same floor",
    "keep to the middle of the way",
    "there is enough room to walk side by side",
    "the way is level and without steps",
    "watch out for other people on the way",
    "do not hurry, the turns come one after the other",
    "there are other ways in between that are not needed",
    "the robot should keep its distance from the walls",
    "please check each place before turning",
    "the lights are bright along the whole way",
)
HEDGES_BEFORE = ("I think", "I believe", "if I remember right,", "I'm fairly sure")
HEDGES_AFTER = (
    "I think",
    "I think",
    "I believe",
    "if I remember",
    "if I'm not wrong",
    "I'm pretty sure",
    "or something like that",
)
DOUBTFUL = (
    "?",
    "maybe",
    "perhaps",
    "roughly",
    "or so",
    "would say",
    "I'd say",
    "should",
)
FRESH_STARTS = ("so you, ", "and then you, ", "there's, ", "it's, ", "and, and ")


def opening_and_closing(
    voice: Voice, goal: str, first: str, last: str, rng: np.random.Generator
) -> list[Aside]:
    """Return a way to begin and a way to end."""
    if voice.again:
        openings: Sequence[str] = SPOKEN_AGAIN if voice.spoken else TYPED_AGAIN
    else:
        openings = SPOKEN_BEGINNINGS if voice.spoken else TYPED_BEGINNINGS
    opening = one_of(openings, rng).format(goal=goal)
    closing = one_of(SPOKEN_ENDINGS if voice.spoken else TYPED_ENDINGS, rng)
    return [
        Aside(first, 0, spoken_as(opening, voice), sure=True),
        Aside(last, 0, spoken_as(closing, voice), sure=True),
    ]


def small_talk(
    voice: Voice, keys: Sequence[str], rng: np.random.Generator
) -> list[Aside]:
    """Return what has nothing to do with the turns, in random order and places."""
    pool = SMALL_TALK if voice.spoken else TYPED_TALK
    return [
        Aside(
            str(rng.choice(keys)),
            float(rng.uniform(-60, -5)),
            spoken_as(pool[int(number)], voice),
            sure=True,
        )
        for number in rng.permutation(len(pool))
    ]


def disturbed(
    text: str,
    voice: Voice,
    rng: np.random.Generator,
    *,
    turn: bool = False,
    sure: bool = False,
) -> str:
    """Put the fillers, hedges and fresh starts of a speaker into a sentence."""
    filler, hedge, again, inside = rng.random(4)
    plain = without_marks(text)
    doubtful = any(word in plain for word in DOUBTFUL)
    if hedge < voice.surface.hedge and not (sure or doubtful):
        command = turn or is_command(plain) or plain.startswith(("I ", "I'"))
        if command or rng.random() < 0.5:
            text = f"{text}, {mark('hedge', one_of(HEDGES_AFTER, rng))}"
        else:
            text = f"{mark('hedge', one_of(HEDGES_BEFORE, rng))} {text}"
    if voice.spoken and again < voice.surface.restart / 2:
        text = mark("restart", one_of(FRESH_STARTS, rng).rstrip()) + " " + text
    if voice.fillers and filler < voice.surface.filler:
        first, middle = voice.fillers
        if inside < 0.6 and " and " in text:
            said = mark("filler", f"{middle},")
            text = text.replace(" and ", f" and, {said} ", 1)
        elif not plain.lower().startswith(("so", "um", "uh", "well", "okay", "right,")):
            text = f"{mark('filler', f'{first},')} {text}"
    return text
