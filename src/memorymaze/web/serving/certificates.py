"""A certificate for this machine, so that a tablet gives its pages the microphone.

Browsers record, and keep pages for when there is no network, only over https that they
trust. The authority that signs is made for one certificate and its key is thrown away:
whoever trusts it trusts these names and nothing else, for a year.
"""

import ipaddress
import os
from datetime import UTC, datetime, timedelta
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
)
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import SettingsError
from memorymaze.web.serving.web import Certificate, own_address

YEAR = timedelta(days=365)
RENEWED = timedelta(days=7)
"""Before its end a new one is made."""
CHAIN, KEY, AUTHORITY = "certificate.pem", "key.pem", "authority.crt"


def local_certificate(folder: Path, host: str) -> Certificate:
    """Return the certificate of a host that is kept in a folder; make it where needed."""
    names = _names(host)
    kept = Certificate(folder / CHAIN, folder / KEY)
    if not _serves(kept, names):
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        before = os.umask(0o177)
        try:
            _make(folder, names)
        finally:
            os.umask(before)
    return kept


def authority_of(certificate: Certificate) -> Path:
    """Return the file that a tablet has to trust."""
    return certificate.chain.with_name(AUTHORITY)


def fingerprint(authority: Path) -> str:
    """Return what a person compares: SHA-256 in pairs of digits."""
    found = x509.load_pem_x509_certificate(authority.read_bytes())
    return found.fingerprint(hashes.SHA256()).hex(":").upper()


def _names(host: str) -> list[x509.GeneralName]:
    local: list[x509.GeneralName] = [
        x509.DNSName("localhost"),
        x509.IPAddress(ipaddress.ip_address("127.0.0.1")),
    ]
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return [*local, *([x509.DNSName(host)] if host != "localhost" else [])]
    if address.is_unspecified:
        own = own_address()
        raise SettingsError(
            "--tls: expected with --host the one address that the tablet goes to"
            f"{f', such as {own}' if own else ''}, got {host}"
        )
    name = x509.IPAddress(address)
    return local if name in local else [*local, name]


def _serves(kept: Certificate, names: list[x509.GeneralName]) -> bool:
    if not (kept.key.is_file() and authority_of(kept).is_file()):
        return False
    try:
        leaf = x509.load_pem_x509_certificates(kept.chain.read_bytes())[0]
        found = leaf.extensions.get_extension_for_class(x509.SubjectAlternativeName)
    except (OSError, ValueError, x509.ExtensionNotFound):
        return False
    ends = leaf.not_valid_after_utc - RENEWED
    return list(found.value) == names and datetime.now(UTC) < ends


def _make(folder: Path, names: list[x509.GeneralName]) -> None:
    authority_key = ec.generate_private_key(ec.SECP256R1())
    key = ec.generate_private_key(ec.SECP256R1())
    issuer = _called(f"memorymaze study in {folder.stem}")
    authority = (
        _dated(issuer, issuer, authority_key.public_key())
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(_usage(signs_certificates=True), critical=True)
        .add_extension(x509.NameConstraints(_permitted(names), None), critical=True)
        .add_extension(
            x509.SubjectKeyIdentifier.from_public_key(authority_key.public_key()), False
        )
        .sign(authority_key, hashes.SHA256())
    )
    leaf = (
        _dated(_called("memorymaze study"), issuer, key.public_key())
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(_usage(signs_certificates=False), critical=True)
        .add_extension(
            x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False
        )
        .add_extension(x509.SubjectAlternativeName(names), critical=False)
        .add_extension(
            x509.AuthorityKeyIdentifier.from_issuer_public_key(
                authority_key.public_key()
            ),
            critical=False,
        )
        .sign(authority_key, hashes.SHA256())
    )
    secret = key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    trusted = authority.public_bytes(Encoding.PEM)
    write_whole(folder / KEY, secret)
    write_whole(folder / AUTHORITY, trusted)
    write_whole(folder / CHAIN, leaf.public_bytes(Encoding.PEM) + trusted)


def _called(name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name[:64])])


def _dated(
    subject: x509.Name, issuer: x509.Name, key: ec.EllipticCurvePublicKey
) -> x509.CertificateBuilder:
    begin = datetime.now(UTC) - timedelta(hours=1)  # clocks of tablets differ
    return (
        x509
        .CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key)
        .serial_number(x509.random_serial_number())
        .not_valid_before(begin)
        .not_valid_after(begin + YEAR)
    )


def _usage(*, signs_certificates: bool) -> x509.KeyUsage:
    return x509.KeyUsage(
        digital_signature=not signs_certificates,
        key_cert_sign=signs_certificates,
        crl_sign=signs_certificates,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        encipher_only=False,
        decipher_only=False,
    )


def _permitted(names: list[x509.GeneralName]) -> list[x509.GeneralName]:
    return [
        x509.IPAddress(ipaddress.ip_network(name.value))
        if isinstance(name, x509.IPAddress)
        else name
        for name in names
    ]
