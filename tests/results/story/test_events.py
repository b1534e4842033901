from memorymaze.results.story.events import events_of


def test_a_dialogue_is_told_with_what_was_true_of_the_answer() -> None:
    question = {"question": "Excuse me, is this the library?"}
    asked = {"kind": "call", "call": "ask", "pose": [0, 0, 0], "arguments": question}
    entries = [
        {**asked, "time": 1.0, "result": None},
        {**asked, "time": 9.5, "result": "Yes, that's it."},
        {
            "kind": "passer_by",
            "time": 6.0,
            "seconds": 3.5,
            "person": "person-3",
            "truth": "wrong",
            "error": "says yes; it is 9.0 m away",
        },
    ]
    assert [(each.time, each.text) for each in events_of(entries)] == [
        (1.0, "“Excuse me, is this the library?” → nobody near"),
        (9.5, "“Excuse me, is this the library?” → “Yes, that's it.”"),
        (9.5, "the answer of person-3 is WRONG: says yes; it is 9.0 m away"),
    ]


def test_who_put_an_answer_into_words_is_told() -> None:
    answered = {
        "kind": "passer_by",
        "time": 6.0,
        "seconds": 3.5,
        "person": "person-3",
        "error": "",
    }
    entries = [
        {**answered, "truth": "unknown"},
        {**answered, "truth": "right", "model": "canned"},
    ]
    assert [each.text for each in events_of(entries)] == [
        "the answer of person-3 tells nothing",
        "the answer of person-3 is right (in the words of a language model, canned; "
        "not checked)",
    ]
