/** Figures as the server sends them. Values are SI. */
import type { Drawing, Plot, ShownFigure } from "../api/messages";

export type {
  Gantt as ShownGantt,
  Lane as ShownLane,
  Mark,
  MovingShape,
  ShownAnimation,
  ShownFigure,
  StackedBars as ShownBars,
  Table as ShownTable,
  Timing as ShownTiming,
} from "../api/messages";

export type Numbers = (number | null)[];

/** Name, title and note of a figure. */
export function aboutOf({ plot, drawing, animation, timing, gantt, bars }: ShownFigure) {
  return plot ?? drawing ?? animation?.still ?? timing ?? gantt ?? bars ?? { name: "", title: "", note: "" };
}

/** What is drawn of a plot, and of a drawing. */
export type ShownPlot = Pick<Plot, "x" | "y" | "series" | "marks">;
export type ShownDrawing = Pick<Drawing, "strokes" | "dots" | "unit">;
