"""Front: the command line, and what `import memorymaze` gives.

`cli` has a file for each verb: its options and what it prints; `library` does the work of
both, in functions for notebooks. Beside them are two doors that users import from:
`memorymaze.gym`, the Gymnasium environments, and `memorymaze.testing`, the contracts.

Way in: `memorymaze --help`, or `mm.follow` and `mm.evaluate`.
To read first: `cli/main.py`, `library/runs.py`.
"""
