"""Instructions for others: in the formats of Room-to-Room and VLN-CE, and for hubs."""

from memorymaze.texts.exchange.foreign_files import Unlabelled
from memorymaze.texts.exchange.hub import write_hub_folder
from memorymaze.texts.exchange.r2r import read_r2r, write_r2r
from memorymaze.texts.exchange.vln_ce import read_vln_ce, write_vln_ce

__all__ = [
    "Unlabelled",
    "read_r2r",
    "read_vln_ce",
    "write_hub_folder",
    "write_r2r",
    "write_vln_ce",
]
