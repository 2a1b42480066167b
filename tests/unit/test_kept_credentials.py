"""A host and a plant that begin at once on one computer."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from ilmek.drivers.opcua.certificate import credentials_pem
from ilmek.jobs.serve import kept_credentials


def test_those_that_begin_at_once_have_one_certificate(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    with ThreadPoolExecutor(4) as at_once:
        begun = [at_once.submit(kept_credentials, "client", "urn:ilmek:client", "a client") for _ in range(4)]
        made = {credentials_pem(one.result()) for one in begun}
    assert len(made) == 1
