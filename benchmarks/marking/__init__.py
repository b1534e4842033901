"""Trains the network that marks what the words of a description say.

`python -m benchmarks.marking --minilm WHEEL --out FOLDER`: its data, what was
left out and its figures are in docs/lab/learned_reader.md.
"""
