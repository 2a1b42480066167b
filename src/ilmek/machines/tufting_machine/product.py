"""The tufted carpet: tufts, yarn, mass, and what the machine makes in an hour.

    n = 1 / (g s)                                  tufts per area, gauge g, stitch s
    l = 2 (h + t) + k sqrt(s² + (j g)²)            yarn of a stitch: two legs through the backing, and its back
    m = n l mu                                     yarn of linear density mu over the carpet's area
    D = 2 n mu                                     density of the pile: what stands over the backing, over its height
    A' = N g s f / c                               area in a time, needles N, strokes in a time f

With c colours of the creel in turn the needle bar goes a gauge from stroke to stroke, there and back, so that c needles
come to each place, c strokes a row. Where all of them tuft, all but one are hidden at a height h0; where the needles
are selected, one does, and the next of its colour is as far across as two places of the bar are on average:

    l = 2 (h + t) + (c - 1) 2 (h0 + t) + k ((c - 1) sqrt((s/c)² + g²) + s/c)           selected by yarn
    l = 2 (h + t) + k sqrt(s² + ((c² - 1) g / 3 c)²)                                   selected by needle, estimated

k is the yarn on the back over the distance of the stitches: 1 where it lies straight; j gauges of shift between them.
Calculators of the trade leave out t; one adds s in full for the back, another 10/st mm for st stitches in 10 cm, a
tenth of s: k = 0.1.
    [geometry; the second calculator gives 773 g/m² for 1/8 in, 32 stitches in 10 cm, 10 mm, 3400 den, cut pile]

A low loop is fed less, but its needle goes as deep as all others, so that it draws the rest out of the loop before.
"""

import math

from ilmek.elements.yarns import yarn_diameter
from ilmek.machines.tufting_machine.params import BY_YARN, TuftedCarpetParams
from ilmek.records import computed, record
from ilmek.units import turn
from ilmek.weaving.tufts import tuft_yarn


@record
class TuftedCarpet:
    """The carpet that a machine tufts at a speed of its main shaft [rad/s]."""

    params: TuftedCarpetParams
    speed: float

    needles = computed("1", "needles over the width", lambda it: int(it.params.width / it.params.gauge + 1e-9))
    tufts_per_area = computed("1/m^2", "tufts", lambda it: it.params.stitch_rate / it.params.gauge)
    yarn_per_stitch = computed(
        "mm",
        "yarn of a stitch: both legs and the back stitch; of low loops their share; with those hidden under it",
        lambda it: it.yarn_of_stitch,
    )
    back_robbing = computed(
        "mm", "yarn that a low loop draws out of the loop before it", lambda it: 2 * (it.params.pile_height - it.low)
    )
    yarn_per_area = computed("1/m", "length of yarn per area", lambda it: it.tufts_per_area * it.yarn_per_stitch)
    mass_per_area = computed(
        "g/m^2", "mass of the yarn per area, backing left out", lambda it: it.yarn_per_area * it.params.yarn_density
    )
    pile_density = computed(
        "kg/m^3",
        "yarn of the pile over the backing, over its height",
        lambda it: 2 * it.tufts_per_area * it.params.yarn_density,
    )
    stitches_per_minute = computed("1", "stitches of a needle in a minute", lambda it: 60 * it.speed / turn)
    production = computed("m^2/h", "carpet, with the share of the time for which it runs", lambda it: it.area_rate)

    @property
    def low(self) -> float:
        """Height of the low loops [m]."""
        given = self.params.low_height
        return self.params.pile_height if given is None else given

    @property
    def yarn_of_stitch(self) -> float:
        """Mean length of yarn of a stitch [m]."""
        params = self.params
        height = params.pile_height - params.low_share * (params.pile_height - self.low)
        pattern, colours, back = params.pattern, params.pattern.colours, params.back_stitch
        if colours == 1:
            step = math.hypot(params.stitch, params.bar_step)
        elif pattern.selection == BY_YARN:
            step = (colours - 1) * math.hypot(params.advance, params.bar_step) + params.advance
        else:
            step = math.hypot(params.stitch, (colours**2 - 1) / (3 * colours) * params.gauge)
        hidden = (colours - 1) * tuft_yarn(pattern.hidden, params.backing_thickness, 0.0)
        return float(tuft_yarn(height, params.backing_thickness, step, back) + hidden * (pattern.selection == BY_YARN))

    @property
    def area_rate(self) -> float:
        """Carpet over the time [m²/s]."""
        params = self.params
        return self.needles * params.gauge * params.advance * self.speed / turn * params.running

    @property
    def yarn_diameter(self) -> float:
        """Diameter of the yarn [m]."""
        params = self.params
        return yarn_diameter(params.yarn_density, params.fibre_density, params.packing)
