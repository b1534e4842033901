"""Words of tables: titles, headings and how values are written in a cell."""

from memorymaze.results.tables.bootstrap import Estimate
from memorymaze.results.tables.rows import TableName, TableRow, place_title

TITLES: dict[TableName, str] = {
    "II": "Table II: methods on every route, both iterations together",
    "III": "Table III: first and second iteration on every route",
}

STUDY_TITLES = {
    "online": "Online instructions (thinking out loud)",
    "onsite": "Onsite instructions (from memory)",
}

HEADINGS = {"sr": "SR", "osr": "OSR", "spd": "SPD (m)", "cls": "CLS"}

KEY = (
    "SR success rate, OSR oracle success rate, SPD shortest walk left to the goal, CLS "
    "coverage\nweighted by length; [95 % interval], bootstrap over participants. The "
    'mean over routes is\nunweighted. Rows that begin with "paper" are published '
    "figures on human instructions."
)


def group_title(row: TableRow) -> str:
    """Return the heading of the rows that belong together with this one."""
    title = f"Mean over {len(row.places)} routes" if row.is_mean else None
    title = title or place_title(row.places)
    return title if row.iteration is None else f"{title}, iteration {row.iteration}"


def parser_cell(row: TableRow) -> str:
    """Say whether instructions were parsed first; `-` where that has no meaning."""
    return "-" if row.parser is None else "yes" if row.parser else "no"


def count_cell(row: TableRow) -> str:
    """Return the number of episodes; nothing for the paper's figures."""
    return "" if row.episodes is None else str(row.episodes)


def estimate_cell(estimate: Estimate, sign: str = "") -> str:
    """Write a mean with its interval where there is one; `sign="+"` for differences.

    >>> estimate_cell(Estimate(0.5, 0.25, 0.75))
    '0.50 [0.25, 0.75]'
    """
    if estimate.low is None or estimate.high is None:
        return f"{estimate.mean:{sign}.2f}"
    low, high = f"{estimate.low:{sign}.2f}", f"{estimate.high:{sign}.2f}"
    return f"{estimate.mean:{sign}.2f} [{low}, {high}]"
