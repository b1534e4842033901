"""The shipped corpus as a folder for dataset hubs: Parquet files, plans and a card."""

from collections import Counter
from importlib.metadata import version
from importlib.resources import files
from io import BytesIO
from pathlib import Path
from string import Template

from memorymaze.basics.extras import require_extra
from memorymaze.texts.corpus.files import load_instructions
from memorymaze.texts.corpus.record_format import instruction_record, write_file
from memorymaze.world.sites.loading import BUILTIN_SITE_NAMES, plan_file


def write_hub_folder(folder: str | Path) -> list[Path]:
    """Write `STUDY/SPLIT.parquet`, the plans in `sites/`, and the card, `README.md`.

    A study is a configuration of the dataset. Columns are the fields of an instruction.

    Args:
        folder: Where; made if need be.

    Returns:
        The files written.

    Raises:
        InstructionFileError: A file cannot be written.
        SettingsError: The extra `tables` is missing.
    """
    require_extra("tables", "pyarrow", purpose="--format hub")
    # Imported here: it takes longer than all else of a command.
    import pyarrow
    import pyarrow.parquet

    folder = Path(folder)
    texts = load_instructions()
    whole = pyarrow.Table.from_pylist([instruction_record(each) for each in texts])
    parts = Counter((each.study, each.split) for each in texts)
    contents: dict[str, bytes] = {}
    for study, split in parts:
        chosen = [each.study == study and each.split == split for each in texts]
        content = BytesIO()
        pyarrow.parquet.write_table(whole.filter(chosen), content)
        contents[f"{study}/{split}.parquet"] = content.getvalue()
    for name in BUILTIN_SITE_NAMES:
        contents[f"sites/{name}.geojson"] = plan_file(name).read_bytes()
    contents["README.md"] = _card(parts).encode()
    for name, content in contents.items():
        write_file(folder / name, content)
    return [folder / name for name in contents]


def _card(parts: Counter[tuple[str, str]]) -> str:
    configurations: list[str] = []
    for study in dict.fromkeys(study for study, _ in parts):
        configurations += [f"- config_name: {study}", "  data_files:"]
        for split in (split for of, split in parts if of == study):
            configurations += [
                f"  - split: {split}",
                f"    path: {study}/{split}.parquet",
            ]
    rows = [f"| `{study}` | `{split}` | {n} |" for (study, split), n in parts.items()]
    template = files("memorymaze.texts.exchange") / "hub_card.md"
    return Template(template.read_text(encoding="utf-8")).substitute(
        version=version("memorymaze"),
        configurations="\n".join(configurations),
        total=parts.total(),
        rows="\n".join(rows),
    )
