/** Figures as the server sends them. Values are SI. */
export type {
  Mark,
  MovingPoint,
  MovingShape,
  ShownAnimation,
  ShownAxis,
  ShownBars,
  ShownCloud,
  ShownCurve,
  ShownDot,
  ShownDrawing,
  ShownFigure,
  ShownGantt,
  ShownLane,
  ShownPlot,
  ShownStroke,
  ShownTable,
  ShownTiming,
} from "../api/messages";

export type Numbers = (number | null)[];
