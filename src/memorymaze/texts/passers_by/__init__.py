"""People one can ask on the way: what they know, what they remember of it, what they say.

What is true from a place comes from the site plan (`knowledge`), what somebody makes of it
from their memory (`memory`), and the words from a bank that a language model wrote in role
(`bank`), never from a grammar; or from a language model in role (`players`). Who is near
enough to be asked is decided in `simulation`; agents get the words alone and cannot import
this room.
"""

from memorymaze.texts.passers_by.bank import load_bank
from memorymaze.texts.passers_by.encounters import Asked, Encounters, Meet
from memorymaze.texts.passers_by.knowledge import FloorKnowledge
from memorymaze.texts.passers_by.memory import Memory
from memorymaze.texts.passers_by.players import ModelInRole

__all__ = [
    "Asked",
    "Encounters",
    "FloorKnowledge",
    "Meet",
    "Memory",
    "ModelInRole",
    "load_bank",
]
