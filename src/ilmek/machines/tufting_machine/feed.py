"""Feed of yarn and backing in step with the needles.

    yarn      turns of the feed roller a stitch  l / (pi d)      torque  N T d / 2
    backing   s a stitch over spiked rollers, evenly: while the needles are in it, it goes s (exit - entry) / 2 pi

    shift     the needle bar goes by j g while the needles are out, half of the time each way:  a = 4 j g / t²

The loopers do not shift, so that a shift is of whole gauges. High and low loops need a roller or servo for each group
of needles that is fed alike.
"""

import math

from ilmek.elements.duty import MARGIN
from ilmek.elements.motors import SERVO, Motor, geared_motor
from ilmek.elements.reducers import DIRECT, PLANETARY, Reducer
from ilmek.machines.tufting_machine.needle_parts import NEEDLE_BAR
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.product import TuftedCarpet
from ilmek.records import computed, record
from ilmek.report import Check, at_most, must
from ilmek.units import turn

YARN_ROLLER, SPIKED_ROLLER = "tufting-machine/yarn-roller", "tufting-machine/spiked-roller"


@record
class TuftingFeed:
    """Rollers of yarn and backing; inside: turn of the main shaft in which the needles are in the backing [rad]."""

    params: TuftingMachineParams
    carpet: TuftedCarpet
    inside: float

    yarn_roller_turn = computed(
        "deg",
        "turn of the yarn feed roller a stitch",
        lambda it: turn * it.carpet.yarn_per_stitch / (math.pi * it.params.feed.yarn_roller),
    )
    backing_roller_turn = computed(
        "deg",
        "turn of the spiked rollers a stitch",
        lambda it: turn * it.params.stitch / (math.pi * it.params.feed.spiked_roller),
    )
    yarn_speed = computed(
        "m/s", "speed of the yarn", lambda it: it.carpet.yarn_per_stitch * it.params.needle.speed / turn
    )
    backing_speed = computed("m/s", "speed of the backing", lambda it: it.params.stitch * it.params.needle.speed / turn)
    advance_in_needles = computed(
        "mm", "travel of the backing while needles are in it", lambda it: it.params.stitch * it.inside / turn
    )

    shift_acceleration = computed(
        "m/s^2",
        "acceleration of the needle bar in its shift along the shafts",
        lambda it: 4 * it.params.shift * it.params.gauge / it.outside**2,
    )

    @property
    def outside(self) -> float:
        """Time of a stitch in which the needles are out of the backing [s]."""
        return (turn - self.inside) / self.params.needle.speed

    @property
    def torques(self) -> dict[str, float]:
        """Torque of yarn and spiked rollers [N m]."""
        feed = self.params.feed
        return {
            "yarn": self.carpet.needles * feed.yarn_tension * feed.yarn_roller / 2,
            "spiked": self.params.width * feed.backing_tension * feed.spiked_roller / 2,
        }

    @property
    def speeds(self) -> dict[str, float]:
        """Speed of yarn and spiked rollers [rad/s]."""
        turns = {"yarn": self.yarn_roller_turn, "spiked": self.backing_roller_turn}
        return {name: angle * self.params.needle.speed / turn for name, angle in turns.items()}

    @property
    def motors(self) -> dict[str, tuple[Motor, Reducer] | None]:
        """Servos of yarn and spiked rollers."""
        speeds = self.speeds
        return {
            name: geared_motor(MARGIN * torque, speeds[name], (DIRECT, *PLANETARY), SERVO)
            for name, torque in self.torques.items()
        }

    @property
    def checks(self) -> tuple[Check, ...]:
        """Advance of the backing, motors."""
        slower = "set a lower needle.speed, or a lower tension"
        motors = self.motors
        return (
            at_most(
                "travel of the backing while needles are in it",
                self.advance_in_needles,
                self.params.feed.give,
                "mm",
                "parameter feed.give",
            ).with_cure("set more stitches over the length, or a lower pile_height", SPIKED_ROLLER),
            at_most(
                "acceleration of the needle bar in its shift",
                self.shift_acceleration,
                self.params.feed.shift_acceleration,
                "m/s^2",
                "parameter feed.shift_acceleration",
            ).with_cure("set a lower needle.speed, or a smaller shift", NEEDLE_BAR),
            must("a servo turns the yarn feed rollers", motors["yarn"] is not None, "motor table").with_cure(
                slower, YARN_ROLLER
            ),
            must("a servo turns the spiked rollers", motors["spiked"] is not None, "motor table").with_cure(
                slower, SPIKED_ROLLER
            ),
        )
