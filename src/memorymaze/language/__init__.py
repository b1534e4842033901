"""Language models, what they answered before, prompts, and the sandbox for programs.

Holds models on servers and on this machine, their prices and limits (`model_settings`),
files of answers (`answers`), and the interpreter that programs run in. Does
not hold agents, sites or what descriptions mean (`understanding`).
"""
