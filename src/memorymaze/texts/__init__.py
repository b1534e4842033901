"""Texts: route instructions and the people who give them.

`corpus` has the records, the files, the shipped texts and another corpus, `sail`;
`exchange` the formats of others; `writing` makes texts up, with errors; `passers_by` answers on the way; `labels` is
what annotators say of texts, `statistics` counts them; `datasets` are made buildings with
made texts.

Way in: `corpus.load_corpus`.
To read first: `corpus/records.py`, `writing/making.py`.
"""
