"""The server's certificate and key: read from files, or made by itself and kept for the next start."""

import datetime as dt
import ipaddress
import os
from dataclasses import dataclass
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes
from cryptography.hazmat.primitives.asymmetric import rsa
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    load_der_private_key,
    load_pem_private_key,
)
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from ilmek.errors import IlmekError, LoomError

KEY_BITS = 2048
"""Size of a key made here; Basic256Sha256 allows 2048 to 4096."""

VALID_DAYS = 3650
"""Validity of a certificate made here."""

LARGEST_FILE = 100_000
"""Largest size of a certificate or key file [bytes]."""


@dataclass(frozen=True, repr=False)
class Credentials:
    """A certificate and its key, and the application's URI that the certificate is for."""

    certificate: x509.Certificate
    key: rsa.RSAPrivateKey
    uri: str


def make_credentials(uri: str, name: str, hosts: tuple[str, ...]) -> Credentials:
    """A certificate signed by its own key: OPC 10000-6, 6.2.2, application instance certificate."""
    key = rsa.generate_private_key(public_exponent=65537, key_size=KEY_BITS)
    subject = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])
    now = dt.datetime.now(dt.UTC)
    usage = x509.KeyUsage(
        digital_signature=True, content_commitment=True, key_encipherment=True, data_encipherment=True,
        key_agreement=False, key_cert_sign=True, crl_sign=False, encipher_only=False, decipher_only=False,
    )  # fmt: skip
    alternative = [x509.UniformResourceIdentifier(uri), *map(_general_name, hosts)]
    purposes = [ExtendedKeyUsageOID.SERVER_AUTH, ExtendedKeyUsageOID.CLIENT_AUTH]
    identifier = x509.SubjectKeyIdentifier.from_public_key(key.public_key())
    certificate = (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(subject)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - dt.timedelta(minutes=5))
        .not_valid_after(now + dt.timedelta(days=VALID_DAYS))
        .add_extension(x509.SubjectAlternativeName(alternative), critical=False)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(usage, critical=True)
        .add_extension(x509.ExtendedKeyUsage(purposes), critical=False)
        .add_extension(identifier, critical=False)
        .sign(key, hashes.SHA256())
    )
    return Credentials(certificate, key, uri)


def kept_credentials(folder: Path, uri: str, name: str, hosts: tuple[str, ...]) -> Credentials:
    """The certificate of a folder, made there where it is missing or for another application; the key is private."""
    paths = folder / "certificate.pem", folder / "key.pem"
    if all(path.exists() for path in paths):
        try:
            return read_credentials(*paths, uri)
        except OtherApplicationError:
            pass  # made for another loom
    made = make_credentials(uri, name, hosts)
    try:
        folder.mkdir(parents=True, mode=0o700, exist_ok=True)
        _write_private(paths[1], made.key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption()))
        _write_private(paths[0], made.certificate.public_bytes(Encoding.PEM))
    except OSError as failed:
        raise LoomError(f"the certificate cannot be kept in {folder} ({failed.strerror})") from None
    return made


class OtherApplicationError(LoomError):
    """A certificate of another application."""


def read_credentials(certificate: Path, key: Path, uri: str) -> Credentials:
    """A certificate and its key from files, PEM or DER. Raises LoomError for a file that cannot be used.

    The certificate must be valid today and belong to the key. The application's URI is the one in the certificate;
    where it is not `uri`, OtherApplicationError.
    """
    found, private = read_certificate(certificate), _read_key(key)
    if found.public_key() != private.public_key():
        raise LoomError(f"the certificate {certificate} is not that of the key {key}", do="give files of one pair")
    now = dt.datetime.now(dt.UTC)
    if not found.not_valid_before_utc <= now <= found.not_valid_after_utc:
        dates = f"{found.not_valid_before_utc:%Y-%m-%d} to {found.not_valid_after_utc:%Y-%m-%d}"
        raise LoomError(f"the certificate {certificate} is valid from {dates}", do="renew it")
    try:
        names = found.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
        uris = names.get_values_for_type(x509.UniformResourceIdentifier)
    except x509.ExtensionNotFound:
        uris = []
    if uri not in uris:
        raise OtherApplicationError(
            f"the certificate {certificate} is for {', '.join(uris) or 'no application'}",
            allowed=f"the URI {uri} as a subject alternative name",
        )
    return Credentials(found, private, uri)


def read_certificate(path: Path) -> x509.Certificate:
    """A certificate from a file, PEM or DER. Raises LoomError for anything else."""
    data = _content(path, "certificate")
    load = x509.load_pem_x509_certificate if data.lstrip().startswith(b"-----") else x509.load_der_x509_certificate
    try:
        return load(data)
    except ValueError:
        raise LoomError(f"{path} is not a certificate", allowed="X.509, PEM or DER") from None


def _read_key(path: Path) -> rsa.RSAPrivateKey:
    private_file(path, "key")
    data = _content(path, "key")
    load = load_pem_private_key if data.lstrip().startswith(b"-----") else load_der_private_key
    try:
        found = load(data, None)
    except (ValueError, TypeError):
        raise LoomError(f"{path} is not a private key", allowed="RSA, PEM or DER, without a password") from None
    if not isinstance(found, rsa.RSAPrivateKey) or not KEY_BITS <= found.key_size <= 4096:
        raise LoomError(f"{path} has another kind of key", allowed=f"RSA of {KEY_BITS} to 4096 bits")
    return found


def private_file(path: Path, noun: str, error: type[IlmekError] = LoomError) -> None:
    """Check that a file of secrets belongs to the user and is closed to others. Raises `error` otherwise."""
    try:
        found = path.stat()
    except OSError as failed:
        raise error(f"the {noun} file {path} cannot be read ({failed.strerror})") from None
    if os.name == "posix" and (found.st_mode & 0o077 or found.st_uid not in (0, os.geteuid())):
        raise error(
            f"the {noun} file {path} can be read or written by others", allowed="only by its owner", do="chmod 600"
        )


def _content(path: Path, noun: str) -> bytes:
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
    except OSError as failed:
        raise LoomError(f"the {noun} file {path} cannot be read ({failed.strerror})") from None
    if len(data) > LARGEST_FILE:
        raise LoomError(f"{path} is too large for a {noun}", allowed=f"at most {LARGEST_FILE // 1000} kB")
    return data


def _write_private(path: Path, data: bytes) -> None:
    part = path.with_suffix(".part")
    part.unlink(missing_ok=True)
    with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    part.replace(path)


def _general_name(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        return x509.DNSName(host)
