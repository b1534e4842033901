"""Agents that follow route instructions: a text and a robot in, motion out.

Holds the role (`agent`), the agents that come with the package, how agents of users' own
are found, made and told apart, and the process of its own that one may live in
(`isolated`). Does not hold sites or answers: agents see what their robot tells them.

Way in: `agent.Agent`, which yours may be too.
To read first: `agent.py`, `guide/agent.py`.
"""
