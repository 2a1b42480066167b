/** What a run shows in the picture: woven rows, where the heads stand, and the angles of row and knot. */
import type { RunNews } from "../../api/messages";
import { type Angles, TURN } from "./motion";
import type { Run } from "./run";
import type { SceneModel } from "./scene";

export interface Live {
  /** The run turns the loom, nobody else. */
  going: boolean;
  rows: number;
  heads: number[];
  angles: Angles;
}

/**
 * The picture of a run at an instant; before: that of the instant before, for heads without a knot.
 *
 * While knots are tied the row stands at its beginning and each knot turns by the loom's clock; while wefts are laid and
 * beaten, from the instant `tied` on at which the last knot was tied, the row turns.
 */
export function liveOf(model: SceneModel, { going, tied }: Run, news: RunNews, before: Live | null): Live {
  const { carpet, periods, frames, heads } = model.about;
  const rest = model.floats(frames.find((one) => one.name === heads)?.origins ?? [0, 0]);
  const across = (column: number) => (column + 0.5) * carpet.columnPitch - (carpet.columns * carpet.columnPitch) / 2;
  const at = Array.from({ length: rest.length / 3 }, (_, head) => {
    const column = news.columns[head];
    return column === null || column === undefined ? (before?.heads[head] ?? rest[3 * head] ?? 0) : across(column);
  });
  const tying = news.tied < news.due;
  return {
    going,
    rows: Math.min(news.row + (tying ? 0 : 1), news.rows),
    heads: at,
    angles: {
      knot: tying && periods.knot ? ((news.time % periods.knot) / periods.knot) * TURN : 0,
      row: tying ? 0 : Math.min(Math.max(news.time - tied, 0) / (periods.row ?? 1), 1) * TURN,
    },
  };
}
