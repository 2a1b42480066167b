"""The studio's client reads quantities with the units of `ilmek.units`, none more and none less."""

from client_units import TABLE, client_units


def test_the_client_has_the_units_of_the_package() -> None:
    assert TABLE.read_text(encoding="utf-8") == client_units(), "write it by: python tests/support/client_units.py"
