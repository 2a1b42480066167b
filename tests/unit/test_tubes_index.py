"""The sensor of the tubes' index and its stand keep off motors, bracket and plates, for any number of tubes."""

import pytest

from ilmek.machines.catalogue import MACHINES
from ilmek.part.contacts import contacts

WEAVER = MACHINES["weaver"]


@pytest.mark.parametrize("tubes", [4, 5, 6, 8, 10, 12, 14, 16, 20, 24])
def test_nothing_is_through_another_with_any_number_of_tubes(tubes: int) -> None:
    assert WEAVER.tree is not None
    head = WEAVER.designed(WEAVER.params.read({"tubes": str(tubes)}))
    assert not contacts(WEAVER.tree(head)).through
