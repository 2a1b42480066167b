"""Palette: the distinct colours of a picture, and the best N yarns of a list.

A picture of millions of knots has about a hundred thousand distinct colours. The nearest yarn is computed once for each
of them and looked up for every knot, through a table of all 2^24 codes.
"""

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.arrays import Float, Float32, FloatArray, Indices, Int, Int32, Int64, IntArray, Rgb, UInt8
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import PART, bands
from ilmek.carpet.nearest_colour import nearest
from ilmek.errors import YarnError
from ilmek.num.compiled import compiled, uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress
from ilmek.records import record

_CODES = 1 << 24
_BATCH = 1 << 14
_SEARCHED = 1 << 18
"""Colours of one search for their nearest yarns: each search puts the list in order anew."""

_LARGEST_TABLE = 1 << 25
_MOST_TRIALS = 3_000_000
_TABLE, _SWAPS = 0.3, 0.4
"""Share of the search for yarns in which the table of differences is made, and share of the rest before the swaps."""

_CELLS = 256
"""Cells of the Lab space along a and b; both are -108 to 99 in sRGB."""


@record
class Colours:
    """The distinct colours of a picture.

    index  for each code r·65536 + g·256 + b the number of the colour, from 1; 0: not in the picture
    codes  of each colour
    labs   CIELAB of each colour          counts  knots of each colour
    """

    index: Int32[np.ndarray, " codes"]
    codes: Int32[np.ndarray, " colours"]
    labs: Float[np.ndarray, "colours 3"]
    counts: Int64[np.ndarray, " colours"]


@uncounted
def _count(rgb: Rgb, index: IntArray, codes: IntArray, counts: IntArray, found: int) -> int:
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            code = np.int32(rgb[row, column, 0]) << 16 | np.int32(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
            if index[code] == 0:
                codes[found] = code
                counts[found] = 0
                found += 1
                index[code] = found
            counts[index[code] - 1] += 1
    return found


@uncounted
def _paint(rgb: Rgb, index: IntArray, yarn_of: UInt8[np.ndarray, " colours"], knots: Indices) -> None:
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            code = np.int32(rgb[row, column, 0]) << 16 | np.int32(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
            knots[row, column] = yarn_of[index[code] - 1]


def distinct_colours(rgb: Rgb, progress: Progress = SILENT) -> Colours:
    """The distinct colours of a picture, in order of first appearance."""
    rgb = np.ascontiguousarray(rgb)
    rows, columns = rgb.shape[:2]
    index = np.zeros(_CODES, dtype=np.int32)
    most = min(_CODES, rows * columns)
    codes, counts = np.empty(most, dtype=np.int32), np.empty(most, dtype=np.int64)
    found = 0
    for band in bands(rows, columns):
        found = int(_count(rgb[band], index, codes, counts, found))
        progress(0.5 * band.stop / rows)
    labs = np.empty((found, 3))

    def convert(batch: slice) -> None:
        channels = np.stack([codes[batch] >> 16, codes[batch] >> 8 & 255, codes[batch] & 255], axis=-1)
        labs[batch] = srgb_to_lab(channels.astype(np.uint8))

    for batch, _ in in_threads(convert, bands(found, 1, _BATCH)):
        progress(0.5 + 0.5 * batch.stop / found)
    return Colours(index, codes[:found].copy(), labs, counts[:found].copy())


def recoloured(colours: Colours, codes: UInt8[np.ndarray, "colours 3"]) -> Colours:
    """The distinct colours of a picture after each of its colours has become another, of these sRGB codes."""
    made = distinct_colours(codes[None])
    red, green, blue = codes.astype(np.int32).T
    weights = colours.counts.astype(float)  # whole numbers below 2^53: their sums are exact
    counts = np.bincount(made.index[red << 16 | green << 8 | blue] - 1, weights=weights)
    return replace(made, counts=counts.astype(np.int64))


def nearest_yarns(
    colours: Colours, yarn_labs: Float[np.ndarray, "yarns 3"], progress: Progress = SILENT
) -> tuple[UInt8[np.ndarray, " colours"], Float[np.ndarray, " colours"]]:
    """For each distinct colour the index of the nearest yarn by CIEDE2000, and its difference."""
    index = np.empty(len(colours.labs), dtype=np.uint8)
    delta = np.empty(len(colours.labs))

    def find(batch: slice) -> None:
        index[batch], delta[batch] = nearest(colours.labs[batch], yarn_labs)

    for batch, _ in in_threads(find, bands(len(index), 1, _SEARCHED)):
        progress(batch.stop / len(index))
    return index, delta


def paint(rgb: Rgb, colours: Colours, yarn_of: UInt8[np.ndarray, " colours"], progress: Progress = SILENT) -> Indices:
    """The knot chart (rows, columns) of a picture; `yarn_of`: index of the yarn of each distinct colour."""
    rgb = np.ascontiguousarray(rgb)
    rows, columns = rgb.shape[:2]
    knots = np.empty((rows, columns), dtype=np.uint8)
    parts = bands(rows, columns, PART)
    for band, _ in in_threads(lambda band: _paint(rgb[band], colours.index, yarn_of, knots[band]), parts):
        progress(band.stop / rows)
    return knots


def best_yarns(
    colours: Colours,
    yarn_labs: Float[np.ndarray, "yarns 3"],
    count: int,
    progress: Progress = SILENT,
    kept: tuple[int, ...] = (),
) -> tuple[int, ...]:
    """Indices, ascending, of the `count` yarns with the least total CIEDE2000 over the picture.

    kept  indices of yarns that are among them in any case

    Every choice is tried where these are few. Else yarns are added one by one, each the best addition, and then swapped
    one for one while a swap lowers the total. Where the table colours × yarns would exceed 2^25 entries, near colours
    are pooled. Raises YarnError unless 2 <= count <= length of the list, and at least as many as are kept.
    """
    if not max(2, len(kept)) <= count <= len(yarn_labs):
        raise YarnError(
            f"{count} colours cannot be picked from the list",
            allowed=f"{max(2, len(kept))} to {len(yarn_labs)}, its length",
        )
    table = difference_table(
        *pooled(colours, _LARGEST_TABLE // len(yarn_labs), progress), yarn_labs, progress.part(0.0, _TABLE)
    )
    return best_of_table(table, count, progress.part(_TABLE, 1.0), kept)


def best_of_table(
    table: Float[np.ndarray, "yarns colours"], count: int, progress: Progress = SILENT, kept: tuple[int, ...] = ()
) -> tuple[int, ...]:
    """As `best_yarns`, of a table of differences."""
    others = [yarn for yarn in range(len(table)) if yarn not in kept]
    more = count - len(kept)
    if math.comb(len(others), more) * table.shape[1] * count <= _MOST_TRIALS:
        choices = ((*kept, *choice) for choice in itertools.combinations(others, more))
        best: tuple[int, ...] = min(choices, key=lambda choice: total_difference(table, choice))
        return tuple(sorted(best))
    adding = progress.part(0.0, _SWAPS)
    begun = list(kept)
    for yarn, _ in itertools.islice(additions(table, kept), more):
        begun.append(yarn)
        adding(len(begun) / count)
    return tuple(sorted(swap_while_better(table, begun, progress.part(_SWAPS, 1.0), len(kept))))


def difference_table(
    labs: Float[np.ndarray, "colours 3"],
    weights: Float[np.ndarray, " colours"],
    yarn_labs: Float[np.ndarray, "yarns 3"],
    progress: Progress = SILENT,
) -> Float32[np.ndarray, "yarns colours"]:
    """CIEDE2000 × weight (knots) of every yarn and every colour."""
    table = np.empty((len(yarn_labs), len(labs)), dtype=np.float32)
    for number, (row, lab) in enumerate(zip(table, yarn_labs, strict=True)):
        for part in bands(len(labs), 1, _BATCH):
            row[part] = delta_e_2000(labs[part], lab) * weights[part]
            progress(number / len(table))
    return table


def total_difference(table: Float[np.ndarray, "yarns colours"], choice: tuple[int, ...]) -> float:
    """Sum over the colours of the least entry (difference × knots) among the chosen yarns."""
    return float(table[list(choice)].min(axis=0).sum(dtype=float))


def pooled(colours: Colours, most: int, progress: Progress = SILENT) -> tuple[FloatArray, FloatArray]:
    """CIELAB and knots of the colours; more than `most` colours are pooled by cells of the Lab space."""
    if len(colours.labs) <= most:
        return colours.labs, colours.counts.astype(float)
    labs, cell, table = np.ascontiguousarray(colours.labs), 1.0, np.zeros(_CELLS**3, dtype=np.int32)
    keys, cells = np.empty(len(labs), dtype=np.int32), np.empty(most, dtype=np.int32)
    while (number := int(_number_cells(labs, cell, table, keys, cells))) > most:
        progress(0.0)
        table[cells] = 0
        cell *= 1.5
    places = np.empty(number, dtype=np.int64)
    places[np.argsort(cells[:number])] = np.arange(number)
    group = places[table[keys] - 1]
    weights = np.bincount(group, weights=colours.counts)
    sums = [np.bincount(group, weights=colours.counts * axis) / weights for axis in labs.T]
    return np.stack(sums, axis=-1), weights


@uncounted
def _number_cells(labs: FloatArray, cell: float, table: IntArray, keys: IntArray, cells: IntArray) -> int:
    """The number of cells of the Lab space that contain a colour; above the room of `cells` the search ends.

    keys   receives the key of each colour's cell, in the order of lightness, a and b
    table  0 everywhere; receives for each key the number of its cell, from 1      cells  receives their keys
    """
    number = 0
    for colour in range(len(labs)):
        lightness, a, b = (
            math.floor(labs[colour, 0] / cell),
            math.floor(labs[colour, 1] / cell),
            math.floor(labs[colour, 2] / cell),
        )
        key = (lightness * _CELLS + a + _CELLS // 2) * _CELLS + b + _CELLS // 2
        if table[key] == 0:
            if number == len(cells):
                return number + 1
            cells[number] = key
            number += 1
            table[key] = number
        keys[colour] = key
    return number


def additions(table: Float[np.ndarray, "yarns colours"], kept: tuple[int, ...] = ()) -> Iterator[tuple[int, float]]:
    """The best yarn to add to those kept, then the best to add to these, and so on, each with the total reached."""
    chosen = list(kept)
    least = table[chosen].min(axis=0) if chosen else np.full(table.shape[1], np.inf, dtype=np.float32)
    while len(chosen) < len(table):
        totals = {
            yarn: float(np.minimum(row, least).sum(dtype=float)) for yarn, row in enumerate(table) if yarn not in chosen
        }
        best = min(totals, key=totals.__getitem__)
        chosen.append(best)
        least = np.minimum(least, table[best])
        yield best, totals[best]


@compiled
def _swap_totals(
    entering: FloatArray, best: IntArray, least: FloatArray, second: FloatArray, totals: FloatArray
) -> None:
    # totals[k]: the sum if the entering yarn replaces the chosen yarn k. Only colours of k use their second best yarn.
    shared = 0.0
    totals[:] = 0.0
    for i in range(len(entering)):
        kept = min(entering[i], least[i])
        shared += kept
        totals[best[i]] += min(entering[i], second[i]) - kept
    totals += shared


def swap_while_better(
    table: Float[np.ndarray, "yarns colours"], chosen: list[int], progress: Progress = SILENT, fixed: int = 0
) -> list[int]:
    """Exchange the best pair (one chosen, one not) while that lowers the total; the first `fixed` stay."""
    if fixed == len(chosen):
        return chosen
    totals = np.empty(len(chosen))
    for swaps in itertools.count():
        nearest_chosen, least, second = _two_least(table, chosen)
        best = (float(least.sum(dtype=float)) * (1 - 1e-9), -1, -1)
        for candidate in range(len(table)):
            if candidate not in chosen:
                progress(swaps / (swaps + len(chosen)))  # the number of swaps is not known
                _swap_totals(table[candidate], nearest_chosen, least, second, totals)
                leaving = fixed + int(totals[fixed:].argmin())
                best = min(best, (float(totals[leaving]), candidate, leaving))
        if best[1] < 0:
            return chosen
        chosen[best[2]] = best[1]
    raise AssertionError("the total falls with every swap")


def _two_least(
    table: Float[np.ndarray, "yarns colours"], chosen: list[int]
) -> tuple[Int[np.ndarray, " colours"], FloatArray, FloatArray]:
    """For each colour the index in `chosen` of its best yarn, the entry of that yarn, and the second least entry."""
    entries = table[chosen]
    order = np.argpartition(entries, 1, axis=0)[:2]
    columns = np.arange(table.shape[1])
    return order[0], entries[order[0], columns], entries[order[1], columns]
