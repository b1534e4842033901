"""The settings of a run as rows of names and values."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict

from memorymaze.evaluation.run_folder import RunRecord


def settings_rows(record: RunRecord) -> list[tuple[str, str]]:
    """Return all that `run.json` says, flat: `settings.seed`, `0`, and so on."""
    return list(_flat(asdict(record), ""))


def _flat(value: object, name: str) -> Iterator[tuple[str, str]]:
    if isinstance(value, Mapping):
        for key, part in value.items():
            yield from _flat(part, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list | tuple) and value:
        for number, part in enumerate(value):
            yield from _flat(part, f"{name}[{number}]")
    else:
        yield name, "-" if value is None or value == () or value == [] else str(value)
