"""Labels that people give descriptions on the plan: what is marked, by whom, what is settled.

Does not hold labels of finished texts (`texts.labels`).
"""
