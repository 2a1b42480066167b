"""A run of the plant has the same digest on every machine."""

from plant_driver import weave
from small_programme import small_programme

from ilmek.drivers.twin_port import TwinPort
from ilmek.loom.control.ports import Failed
from ilmek.loom.twin.comparison import compare
from ilmek.loom.twin.model import FaultRates, plant_model
from ilmek.loom.twin.state import Repaired, first_state
from ilmek.loom.twin.woven import Woven, woven_size


def test_the_digests_of_a_run_with_faults() -> None:
    programme = small_programme(6, 24, 3, 4, seed=11)
    rates = FaultRates(2026, 0.01, 0.03, 0.05, 0.05, 0.03, 0.03)
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    woven.keep(first_state(plant_model(programme.setup)))
    port = TwinPort(programme.setup, woven, rates=rates)
    failures = sum(isinstance(one, Failed) for one in weave(port, programme, cure=lambda _: port.act(Repaired())))
    assert (failures, port.time) == (18, 684488000000)
    assert port.state.digest.hex() == "a38bda25afb7a8511b7b1068feede6b2ae1687e62a36de514cabffca975be5de"
    assert compare(woven, programme).digest == "1e7149f0274efb83493870e0a6b42bef5c60b824844a28f8337d7752e97b8fe6"
