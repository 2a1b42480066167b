/** Which of many equal parts side by side are drawn: those in the picture; far away only some, wider in their stead. */

/** The odd number of neighbours that one stands for, where neighbours are nearer than so many metres of a pixel. */
export function strideFor(spacing: number, pixel: number): number {
  return oddFrom((APART * pixel) / Math.max(spacing, 1e-9));
}

/** The odd number at or next above a number, 1 at least. */
export function oddFrom(needed: number): number {
  return needed <= 1 ? 1 : 2 * Math.ceil((needed - 1) / 2) + 1;
}

/** Distance of neighbours that are drawn each [px]. */
const APART = 4;

/** Mean distance of so many matrices that stand one after the other across; infinite where they stand otherwise. */
export function spacingOf(matrices: Float32Array, count: number): number {
  const across = (k: number) => matrices[16 * k + 12] ?? 0;
  const mean = (across(count - 1) - across(0)) / (count - 1);
  for (let k = 1; k < count; k++) {
    const step = (across(k) - across(k - 1)) / mean;
    if (!(step > 1 / UNEVEN && step < UNEVEN)) return Number.POSITIVE_INFINITY;
  }
  return count > 1 ? Math.abs(mean) : Number.POSITIVE_INFINITY;
}

/** A distance of neighbours in a row over their mean distance is less than this, and more than its reciprocal. */
const UNEVEN = 10;

/**
 * Copies every `stride`-th matrix that is seen, as many times wider; the number of copies.
 *
 * backwards  the last one first        seen  whether a sphere at (x, y, z) is in the picture
 */
export function thinned(
  from: Float32Array,
  count: number,
  stride: number,
  backwards: boolean,
  into: Float32Array,
  seen: (x: number, y: number, z: number) => boolean,
): number {
  let drawn = 0;
  const steps = Math.ceil((count - (stride >> 1)) / stride);
  for (let step = 0; step < steps; step++) {
    const at = 16 * ((stride >> 1) + stride * (backwards ? steps - 1 - step : step));
    if (!seen(from[at + 12] ?? 0, from[at + 13] ?? 0, from[at + 14] ?? 0)) continue;
    const to = 16 * drawn++;
    for (let n = 0; n < 16; n++) into[to + n] = from[at + n] ?? 0;
    for (let n = 0; n < 3; n++) into[to + n] = stride * (from[at + n] ?? 0);
  }
  return drawn;
}
