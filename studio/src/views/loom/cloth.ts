/** The carpet's surface as a ribbon with the chart on it. */
import type { SceneModel } from "./scene";

export interface Ribbon {
  /** (x, y, z) in turn, two for each point of the line. */
  points: Float32Array;
  /** Across 0 to 1, and distance below the fell [m]. */
  uv: Float32Array;
  triangles: Uint32Array;
}

/** A ribbon along the carpet's line, `front` in front of its ground [m]. */
export function ribbon(model: SceneModel, front: number): Ribbon {
  const { carpet } = model.about;
  const line = model.floats(carpet.line);
  const count = line.length / 2;
  const [points, uv] = [new Float32Array(6 * count), new Float32Array(4 * count)];
  let far = 0;
  for (let k = 0; k < count; k++) {
    const [z = 0, y = 0] = [line[2 * k], line[2 * k + 1]];
    const after = Math.min(k + 1, count - 1);
    const before = after - 1;
    const along = [
      (line[2 * after] ?? 0) - (line[2 * before] ?? 0),
      (line[2 * after + 1] ?? 0) - (line[2 * before + 1] ?? 0),
    ];
    const size = Math.hypot(along[0] ?? 0, along[1] ?? 0) || 1;
    const out = [(-(along[1] ?? 0) / size) * front, ((along[0] ?? 0) / size) * front];
    if (k > 0) far += Math.hypot(z - (line[2 * k - 2] ?? 0), y - (line[2 * k - 1] ?? 0));
    for (const side of [0, 1]) {
      const at = 3 * (2 * k + side);
      points.set([(side - 0.5) * carpet.width, y + (out[1] ?? 0), z + (out[0] ?? 0)], at);
      uv.set([side, far], 2 * (2 * k + side));
    }
  }
  const triangles = new Uint32Array(6 * (count - 1));
  for (let k = 0; k + 1 < count; k++)
    triangles.set([2 * k, 2 * k + 2, 2 * k + 1, 2 * k + 1, 2 * k + 2, 2 * k + 3], 6 * k);
  return { points, uv, triangles };
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
