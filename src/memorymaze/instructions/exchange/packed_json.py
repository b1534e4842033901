"""JSON files, also gzipped, with messages for what is wrong in them."""

import gzip
import json
import zlib
from pathlib import Path
from typing import Any

from memorymaze.errors import InstructionFileError
from memorymaze.instructions.files import write_file


def read_json(path: str | Path) -> Any:
    """Read a JSON file; gzipped where its name ends in `.gz`.

    Raises:
        InstructionFileError: It cannot be read, or is not JSON.
    """
    path = Path(path)
    try:
        content = path.read_bytes()
        if path.suffix == ".gz":
            content = gzip.decompress(content)
        return json.loads(content)
    except (OSError, EOFError, zlib.error) as error:
        reason = getattr(error, "strerror", None) or error
        raise InstructionFileError(f"{path}: cannot be read ({reason})") from None
    except (ValueError, RecursionError) as error:
        raise InstructionFileError(f"{path}: expected JSON ({error})") from None


def write_json(path: str | Path, value: Any) -> None:
    """Write a JSON file; gzipped where its name ends in `.gz`.

    The same value gives the same bytes.

    Raises:
        InstructionFileError: It cannot be written.
    """
    path = Path(path)
    content = json.dumps(value, ensure_ascii=False, allow_nan=False).encode()
    if path.suffix == ".gz":
        content = gzip.compress(content, mtime=0)
    write_file(path, content)
