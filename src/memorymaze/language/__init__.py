"""Language: from words to plans, and models of language; no robot and no building.

`plans` are the records of what a route description says; `reading` makes them of a text,
by a grammar and by a network that marks words; `models` asks language models, keeps their
answers and counts what they cost; `nouns` tells which words are kinds of what.

Way in: `agents/plan_readers.py` has a text read, `models/building.py` makes a model.
To read first: `plans/records.py`, `reading/reading.py`.
"""
