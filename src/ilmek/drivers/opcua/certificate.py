"""The server's certificate and key: given, or made by itself."""

import datetime as dt
import ipaddress
from dataclasses import dataclass

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

from ilmek.errors import LoomError

KEY_BITS, MOST_KEY_BITS = 2048, 4096
"""Size of a key made here, and largest size of one that is given: those that Basic256Sha256 allows."""

VALID_DAYS = 3650
"""Validity of a certificate made here."""


class OtherApplicationError(LoomError):
    """A certificate of another application."""


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


def credentials_pem(credentials: Credentials) -> tuple[bytes, bytes]:
    """A certificate and its key as PEM, the key without a password."""
    key = credentials.key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    return credentials.certificate.public_bytes(Encoding.PEM), key


def parse_credentials(certificate: bytes, key: bytes, uri: str) -> Credentials:
    """A certificate and its key, PEM or DER. Raises LoomError for those that cannot be used.

    The certificate must be valid today, belong to the key, and name the application's URI; where it names another one
    OtherApplicationError.
    """
    found, private = parse_certificate(certificate), _parsed_key(key)
    if found.public_key() != private.public_key():
        raise LoomError("the certificate is not that of the key", do="give files of one pair")
    now = dt.datetime.now(dt.UTC)
    if not found.not_valid_before_utc <= now <= found.not_valid_after_utc:
        dates = f"{found.not_valid_before_utc:%Y-%m-%d} to {found.not_valid_after_utc:%Y-%m-%d}"
        raise LoomError(f"the certificate is valid from {dates}", do="renew it")
    try:
        names = found.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
        uris = names.get_values_for_type(x509.UniformResourceIdentifier)
    except x509.ExtensionNotFound:
        uris = []
    if uri not in uris:
        raise OtherApplicationError(
            f"the certificate is for {', '.join(uris) or 'no application'}",
            allowed=f"the URI {uri} as a subject alternative name",
        )
    return Credentials(found, private, uri)


def parse_certificate(data: bytes) -> x509.Certificate:
    """A certificate, PEM or DER. Raises LoomError for anything else."""
    load = x509.load_pem_x509_certificate if data.lstrip().startswith(b"-----") else x509.load_der_x509_certificate
    try:
        return load(data)
    except ValueError:
        raise LoomError("the file is not a certificate", allowed="X.509, PEM or DER") from None


def _parsed_key(data: bytes) -> rsa.RSAPrivateKey:
    load = load_pem_private_key if data.lstrip().startswith(b"-----") else load_der_private_key
    try:
        found = load(data, None)
    except (ValueError, TypeError):
        raise LoomError("the file is not a private key", allowed="RSA, PEM or DER, without a password") from None
    if not isinstance(found, rsa.RSAPrivateKey) or not KEY_BITS <= found.key_size <= MOST_KEY_BITS:
        raise LoomError("the key is of another kind", allowed=f"RSA of {KEY_BITS} to {MOST_KEY_BITS} bits")
    return found


def _general_name(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        return x509.DNSName(host)
