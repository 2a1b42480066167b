"""Datums of a part, and tolerances of position and run-out of its features from these."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ilmek.elements.fits import fit, tolerance_grade
from ilmek.part.tolerances import Characteristic, FeatureKind, FitDuty, GeometricTolerance, ToleratedFeature
from ilmek.units import um


def related(features: Sequence[ToleratedFeature]) -> list[ToleratedFeature]:
    """The features with their tolerances of position and run-out, from datums among them."""
    seats = [feature for feature in features if feature.kind is FeatureKind.JOURNAL and feature.duty is FitDuty.BEARING]
    if any(feature.duty in {FitDuty.ROLLING, FitDuty.TRACK} for feature in features):
        seats = [feature for feature in features if feature.kind in {FeatureKind.BORE, FeatureKind.SQUARE_BORE}]
    datums: dict[str, str] = {}
    if seats:
        axis = seats[0], seats[-1] if seats[-1] is not seats[0] else seats[0]
        datums = {seat.name: letter for seat, letter in zip(dict.fromkeys(axis), "AB", strict=False)}
        return [_turning_true(feature, datums) for feature in features]
    bores = [feature for feature in features if feature.kind is FeatureKind.BORE and feature.duty in _LINKED]
    if not _parallel(bores):
        return list(features)
    axes: list[list[ToleratedFeature]] = []
    for bore in bores:  # what is bored in one line has one datum
        line = next((line for line in axes if _in_line(line[0], bore)), None)
        axes.append([bore]) if line is None else line.append(bore)
    if len(axes) == 1:
        return list(features)
    datums = {bore.name: letter for line, letter in zip(axes, "AB", strict=False) for bore in line}
    return [_located(feature, datums) if feature in bores else feature for feature in features]


_LINKED = {FitDuty.RUNNING, FitDuty.FIXED, FitDuty.HOUSING, FitDuty.BEARING}


def _parallel(features: Sequence[ToleratedFeature]) -> bool:
    along = [feature.position.rotation[:, 2] for feature in features]
    return all(bool(np.abs(np.cross(axis, along[0])).max() < um) for axis in along)


def _in_line(one: ToleratedFeature, other: ToleratedFeature) -> bool:
    """Whether two parallel bores of one size have one axis."""
    axis, away = one.position.rotation[:, 2], other.position.origin - one.position.origin
    return abs(one.nominal - other.nominal) < um and bool(np.abs(np.cross(away, axis)).max() < um)


def _turning_true(one: ToleratedFeature, datums: Mapping[str, str]) -> ToleratedFeature:
    """A feature of a shaft with the run-out that it needs about its bearings."""
    letter, common = datums.get(one.name, ""), ("-".join(datums.values()),)
    track = one.duty is FitDuty.TRACK
    if not (one.kind is FeatureKind.JOURNAL or track) or (letter and len(datums) == 1) or not common[0]:
        return replace(one, datum=letter)
    total = one.duty is FitDuty.BEARING
    characteristic = Characteristic.TOTAL_RUN_OUT if total else Characteristic.RUN_OUT
    rolls = one.duty is FitDuty.ROLLING
    reason = "the bearings lie in line" if total else "it rolls true" if rolls else "what is on the shaft turns true"
    reason = "its track stays under the roller" if track else reason
    value = tolerance_grade(5 if total or rolls else 7, one.nominal)
    run_out = GeometricTolerance(characteristic, value, common, reason=reason)
    return replace(one, datum=letter, geometric=(*one.geometric, run_out))


def _located(one: ToleratedFeature, datums: Mapping[str, str]) -> ToleratedFeature:
    """A bore of a link with its position: no more beside its place than its joint has play."""
    letter = datums.get(one.name, "")
    before = tuple(dict.fromkeys(other for other in datums.values() if other != letter))[: 1 if letter else 2]
    if letter == "A":
        return replace(one, datum=letter)
    loose = fit("H7/g6", one.nominal).largest_clearance
    value = max(_STEP, loose // _STEP * _STEP)
    reason = "a pin's distance may err by the play of its joint"
    position = GeometricTolerance(Characteristic.POSITION, value, before, round=True, reason=reason)
    return replace(one, datum=letter, geometric=(*one.geometric, position))


_STEP = 5 * um
"""Step of tolerances of position [m]."""
