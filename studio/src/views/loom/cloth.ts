/** The carpet's surface as a ribbon with the chart on it. */
import type { SceneModel } from "./scene";

export interface Ribbon {
  /** (x, y, z) in turn, two for each point of the line. */
  points: Float32Array;
  /** Across 0 to 1, and distance below the fell [m]. */
  uv: Float32Array;
  triangles: Uint32Array;
}

/** A ribbon along the carpet's line, `front` in front of its ground [m], where it begins: the last row is seen from above. */
export function ribbon(model: SceneModel, front: number): Ribbon {
  const { carpet } = model.about;
  const line = model.floats(carpet.line);
  const count = line.length / 2 + 1;
  const [points, uv] = [new Float32Array(6 * count), new Float32Array(4 * count)];
  const point = (k: number): [number, number] => [line[2 * k] ?? 0, line[2 * k + 1] ?? 0];
  const put = (number: number, [z, y]: [number, number], far: number) => {
    for (const side of [0, 1]) {
      points.set([(side - 0.5) * carpet.width, y, z], 3 * (2 * number + side));
      uv.set([side, far], 2 * (2 * number + side));
    }
  };
  put(0, point(0), carpet.rowPitch / 2);
  let far = 0;
  for (let k = 0; k + 1 < count; k++) {
    const [z, y] = point(k);
    const [before, after] = [point(Math.min(k, count - 3)), point(Math.min(k + 1, count - 2))];
    const along = [after[0] - before[0], after[1] - before[1]] as const;
    const size = Math.hypot(...along) || 1;
    if (k > 0) far += Math.hypot(z - point(k - 1)[0], y - point(k - 1)[1]);
    put(k + 1, [z - (along[1] / size) * front, y + (along[0] / size) * front], far);
  }
  const triangles = new Uint32Array(6 * (count - 1));
  for (let k = 0; k + 1 < count; k++)
    triangles.set([2 * k, 2 * k + 2, 2 * k + 1, 2 * k + 1, 2 * k + 2, 2 * k + 3], 6 * k);
  return { points, uv, triangles };
}

/** The colour of the yarn that is tied after so many rows, at a distance from the middle [m]; null: it is not known. */
export function yarnColour(model: SceneModel, rows: number, x: number): string | null {
  const { carpet, chart } = model.about;
  if (chart === null || model.knots === null) return null;
  const row = Math.min(Math.floor(rows), chart.rows - 1);
  const column = Math.floor(x / carpet.columnPitch + chart.columns / 2);
  const kept = Math.min(Math.max(column, 0), chart.columns - 1);
  return chart.colours[model.knots[(chart.rows - 1 - row) * chart.columns + kept] ?? 0] ?? null;
}

/** The colours of the carpet's yarns that it needs, in the order of the list; none without a chart. */
export function dyes({ about, knots }: SceneModel): string[] {
  const needed = new Set(knots ?? []);
  return (about.chart?.colours ?? []).filter((_, number) => needed.has(number));
}

/** The chart as RGBA, a byte a channel, the row that is woven first at the beginning. */
export function chartPixels(model: SceneModel): Uint8Array {
  const { chart } = model.about;
  if (chart === null || model.knots === null) return new Uint8Array([150, 140, 120, 255]);
  const palette = chart.colours.map((hex) => Number.parseInt(hex.slice(1), 16));
  const pixels = new Uint8Array(4 * chart.rows * chart.columns);
  for (let row = 0; row < chart.rows; row++)
    for (let column = 0; column < chart.columns; column++) {
      const colour = palette[model.knots[(chart.rows - 1 - row) * chart.columns + column] ?? 0] ?? 0;
      pixels.set([colour >> 16, (colour >> 8) & 255, colour & 255, 255], 4 * (row * chart.columns + column));
    }
  return pixels;
}
