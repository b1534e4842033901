"""Instructions in the formats of other benchmarks and of statistics programs.

One file per format: Room-to-Room, VLN-CE, and tables in CSV and Parquet.
"""

from memorymaze.instructions.exchange.foreign_files import Unlabelled
from memorymaze.instructions.exchange.r2r import read_r2r, write_r2r
from memorymaze.instructions.exchange.spreadsheets import (
    read_spreadsheet,
    write_spreadsheet,
)
from memorymaze.instructions.exchange.vln_ce import read_vln_ce, write_vln_ce

__all__ = [
    "Unlabelled",
    "read_r2r",
    "read_spreadsheet",
    "read_vln_ce",
    "write_r2r",
    "write_spreadsheet",
    "write_vln_ce",
]
