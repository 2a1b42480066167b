"""Rates from which the cost of a carpet follows. They are assumed by this project, without a currency's year or place;
each states the range that is usual. Amounts are in the currency of the prices of parts.
"""

from dataclasses import dataclass

from ilmek.params import Params, kind, param


@dataclass(frozen=True, slots=True)
class CostRates(Params):
    """Wage, hours, capital, energy, floor, and the assembly of the machine."""

    wage: float = param(
        8 / 3600, unit="1/h", at_least=0.0, at_most=1.0, doc="cost of an hour of a person; usual: 2 to 40 an hour"
    )
    persons: float = param(0.25, at_least=0.0, at_most=20.0, doc="persons a loom; usual: 0.1 to 1")
    hours: float = kind.time(
        4000 * 3600.0, unit="h", above=0.0, at_most=8784 * 3600.0, doc="hours a year of work; usual: 2,000 to 8,000 h"
    )
    availability: float | None = param(
        None,
        unit="%",
        above=0.0,
        at_most=1.0,
        doc="share of the hours in which the loom runs or changes carpets, 60 to 95 %; default: by stops and failures",
    )
    failures: float = param(
        0.1, unit="%", at_least=0.0, below=1.0, doc="share of the hours for upkeep and failures; usual: 5 to 20 %"
    )
    changeover: float | None = kind.time(
        None,
        unit="h",
        at_least=0.0,
        at_most=1e7,
        doc="time between two carpets, 4 to 24 h; default: dressing of the loom, and 4.5 h to cut off and begin",
    )
    life: float = param(7.0, above=0.0, at_most=100.0, doc="years over which the loom is paid; usual: 5 to 15")
    interest: float = param(0.05, unit="%", at_least=0.0, at_most=1.0, doc="interest a year; usual: 2 to 15 %")
    upkeep: float = param(
        0.03, unit="%", at_least=0.0, at_most=1.0, doc="upkeep a year, of the machine's price; usual: 2 to 6 %"
    )
    energy: float = param(
        0.15 / 3.6e6, unit="1/kWh", at_least=0.0, at_most=1e-3, doc="price of energy; usual: 0.05 to 0.4 a kWh"
    )
    rent: float = param(40.0, unit="1/m^2", at_least=0.0, at_most=1e6, doc="rent of floor a year; usual: 15 to 120")
    aisle: float = kind.length(
        0.8, unit="m", at_least=0.0, at_most=20.0, doc="floor round the fence; usual: 0.6 to 1 m"
    )
    inspection: float = param(
        1.5, unit="1/m^2", at_least=0.0, at_most=1e6, doc="inspection and mending of the carpet; usual: 0.5 to 5"
    )
    inspection_time: float = param(
        900.0,
        unit="min/m^2",
        at_least=0.0,
        at_most=1e6,
        doc="inspection and mending; usual: 5 to 60 min a square metre",
    )
    shearing: float = param(
        3.5, unit="1/m^2", at_least=0.0, at_most=1e6, doc="shearing of the carpet; usual: 1.5 to 10"
    )
    shearing_time: float = param(
        360.0, unit="min/m^2", at_least=0.0, at_most=1e6, doc="shearing; usual: 2 to 20 min a square metre"
    )
    carving_speed: float = param(
        4 / 3600, unit="m/h", above=0.0, at_most=1.0, doc="carving of lines by hand; usual: 2 to 8 m an hour"
    )
    washing: float = param(
        7.0, unit="1/m^2", at_least=0.0, at_most=1e6, doc="washing, drying and stretching of the carpet; usual: 3 to 15"
    )
    washing_time: float = kind.time(
        48 * 3600.0, unit="h", at_least=0.0, at_most=1e7, doc="washing and drying of a carpet; usual: 24 to 120 h"
    )
    piece_time: float = kind.time(
        40.0, at_least=0.0, at_most=1e5, doc="cleaning and placing of a piece; usual: 10 to 120 s"
    )
    screw_time: float = kind.time(
        90.0, at_least=0.0, at_most=1e5, doc="fitting of a screw and what it holds; 60 to 300 s"
    )
    pin_time: float = kind.time(
        300.0, at_least=0.0, at_most=1e5, doc="fitting of a pin's joint, until it turns freely; usual: 120 to 900 s"
    )
    slide_time: float = kind.time(600.0, at_least=0.0, at_most=1e5, doc="aligning of a slide; usual: 300 to 3,600 s")
    contact_time: float = kind.time(
        300.0, at_least=0.0, at_most=1e5, doc="setting of a cam's follower or a transmission; usual: 120 to 1,200 s"
    )
    axis_time: float = kind.time(
        6 * 3600.0, unit="h", at_least=0.0, at_most=1e6, doc="wiring and setting of an axis; usual: 3 to 10 h"
    )
    sensor_time: float = kind.time(
        900.0, at_least=0.0, at_most=1e5, doc="wiring and test of a sensor or button; usual: 600 to 3,600 s"
    )
    cabinet_time: float = kind.time(
        24 * 3600.0, unit="h", at_least=0.0, at_most=1e6, doc="building of the control's cabinet; usual: 16 to 80 h"
    )
    commissioning: float = kind.time(
        80 * 3600.0, unit="h", at_least=0.0, at_most=1e7, doc="putting the loom to work; usual: 40 to 300 h"
    )
    fitter_wage: float = param(
        35 / 3600, unit="1/h", at_least=0.0, at_most=1.0, doc="cost of an hour of a fitter; usual: 15 to 70 an hour"
    )
    margin: float = param(
        0.35, unit="%", at_least=0.0, at_most=20.0, doc="margin of the maker on what is made; usual: 20 to 60 %"
    )
    weaver_knots: float = param(
        8000.0, above=0.0, at_most=1e6, doc="knots that a weaver ties a day; usual: 5,000 to 12,000"
    )
    weaver_day: float = kind.time(8 * 3600.0, unit="h", above=0.0, at_most=86400.0, doc="hours of a weaver's day")

    def finishing(self, area: float, carved: float = 0.0) -> float:
        """Cost of inspection, shearing and washing of a carpet of an area [m^2], and of the carving of lines [m]."""
        return (self.inspection + self.shearing + self.washing) * area + self.wage * carved / self.carving_speed
