import ssl
from pathlib import Path

import httpx2
import pytest
from cryptography import x509

from memorymaze.basics.errors import SettingsError
from memorymaze.web.serving.certificates import (
    authority_of,
    fingerprint,
    local_certificate,
)
from memorymaze.web.serving.web import ServedApplication, make_app, serving


def test_who_trusts_the_authority_reaches_pages_over_https(tmp_path: Path) -> None:
    certificate = local_certificate(tmp_path / "mine.tls", "127.0.0.1")
    authority = authority_of(certificate)
    trusting = ssl.create_default_context(cafile=str(authority))
    with serving(ServedApplication(make_app([]), certificate=certificate)) as [address]:
        assert address.startswith("https://127.0.0.1:")
        for host in ("127.0.0.1", "localhost"):
            page = f"https://{host}:{address.rpartition(':')[2]}/static/page.css"
            assert httpx2.get(page, verify=trusting).status_code == 200
        with pytest.raises(httpx2.ConnectError, match="certificate"):
            httpx2.get(f"{address}/")
    assert len(fingerprint(authority).split(":")) == 32


def test_only_the_owner_reads_the_files_and_no_key_can_sign_others(
    tmp_path: Path,
) -> None:
    local_certificate(tmp_path / "mine.tls", "192.0.2.7")
    files = sorted((tmp_path / "mine.tls").iterdir())
    assert [file.name for file in files] == [
        "authority.crt",
        "certificate.pem",
        "key.pem",
    ]
    assert {oct(file.stat().st_mode)[-3:] for file in files} == {"600"}
    texts = "".join(file.read_text() for file in files)
    assert texts.count("PRIVATE KEY") == 2  # begin and end of one, that of the server
    authority = x509.load_pem_x509_certificate(files[0].read_bytes())
    allowed = authority.extensions.get_extension_for_class(x509.NameConstraints).value
    assert [str(name.value) for name in allowed.permitted_subtrees or ()] == [
        "localhost",
        "127.0.0.1/32",
        "192.0.2.7/32",
    ]
    assert (authority.not_valid_after_utc - authority.not_valid_before_utc).days == 365


def test_a_certificate_is_kept_for_its_names_and_made_anew_for_others(
    tmp_path: Path,
) -> None:
    first = local_certificate(tmp_path, "192.0.2.7").chain.read_bytes()
    assert local_certificate(tmp_path, "192.0.2.7").chain.read_bytes() == first
    assert local_certificate(tmp_path, "192.0.2.8").chain.read_bytes() != first
    (tmp_path / "certificate.pem").write_text("broken")
    assert b"BEGIN" in local_certificate(tmp_path, "tablet.local").chain.read_bytes()


@pytest.mark.parametrize("host", ["0.0.0.0", "::"])
def test_a_certificate_needs_one_address(tmp_path: Path, host: str) -> None:
    with pytest.raises(SettingsError, match=f"the one address .*got {host}"):
        local_certificate(tmp_path, host)
