"""Collecting what people say of instructions: labels, agreement, consensus.

Annotators are asked in the terminal (`dialogue`) or a sheet (`label_sheet`); their labels
are files of their own (`labels`), compared in `agreement` and merged in `consensus`.
Nobody walks here, and nothing is evaluated.
"""
