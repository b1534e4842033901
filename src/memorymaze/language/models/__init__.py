"""Language models, what they answered before, and prompts.

Holds models on servers and on this machine, their prices and limits (`model_settings`),
and files of answers (`answers`). Does not hold agents, the interpreter that programs run
in (`agents/code_generation`), sites or what descriptions mean (`reading`).
"""
