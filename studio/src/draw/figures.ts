/** Figures as the server sends them. Values are SI. */
export type {
  MovingPoint,
  MovingShape,
  ShownAnimation,
  ShownAxis,
  ShownBars,
  ShownCurve,
  ShownDot,
  ShownDrawing,
  ShownFigure,
  ShownGantt,
  ShownLane,
  ShownMark,
  ShownPlot,
  ShownStroke,
  ShownTable,
  ShownTiming,
} from "../api/messages";

export type Numbers = (number | null)[];
