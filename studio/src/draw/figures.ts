/** Figures as the server sends them, see `ilmek.jobs.studio.figure_answers`. Values are SI. */

export type Numbers = (number | null)[];

export interface ShownAxis {
  label: string;
  unit: string;
}

export interface ShownCurve {
  label: string;
  look: number;
  dashed: boolean;
  x: Numbers;
  y: Numbers;
}

export interface ShownMark {
  x: number;
  label: string;
}

export interface ShownPlot {
  x: ShownAxis;
  y: ShownAxis;
  curves: ShownCurve[];
  marks: ShownMark[];
}

export interface ShownStroke {
  points: Numbers;
  role: string;
  label: string;
  closed: boolean;
  filled: boolean;
  look: number;
}

export interface ShownDot {
  at: [number, number];
  label: string;
  role: string;
}

export interface ShownDrawing {
  strokes: ShownStroke[];
  dots: ShownDot[];
  unit: string;
}

export interface MovingShape {
  tracks: number[];
  shape: Numbers;
  role: string;
  label: string;
  closed: boolean;
  look: number;
}

export interface MovingPoint {
  track: number;
  ahead: number;
  label: string;
  role: string;
}

export interface ShownReading {
  label: string;
  unit: string;
  values: Numbers;
}

export interface ShownAnimation {
  still: ShownDrawing;
  drive: ShownAxis;
  at: Numbers;
  tracks: Numbers[];
  shapes: MovingShape[];
  points: MovingPoint[];
  readings: ShownReading[];
  closes: boolean;
  start: number;
  period: number | null;
}

export interface ShownMove {
  name: string;
  start: number;
  end: number;
  begin: number;
  finish: number;
  law: string;
}

export interface ShownShade {
  start: number;
  end: number;
  label: string;
  bad: boolean;
}

export interface ShownLane {
  name: string;
  actuator: string;
  unit: string;
  look: number;
  angle: Numbers;
  position: Numbers;
  events: ShownMark[];
  moves: ShownMove[];
  shades: ShownShade[];
}

export interface ShownLink {
  first: [number, number];
  then: [number, number];
  label: string;
  ok: boolean;
}

export interface ShownTiming {
  drive: ShownAxis;
  period: number;
  lanes: ShownLane[];
  links: ShownLink[];
}

export interface ShownSpans {
  name: string;
  starts: Numbers;
  ends: Numbers;
  kinds: number[];
}

export interface ShownGantt {
  x: ShownAxis;
  lanes: ShownSpans[];
  kinds: string[];
  looks: number[];
  pale: number;
}

export interface ShownBars {
  x: ShownAxis;
  bars: string[];
  kinds: string[];
  looks: number[];
  values: Numbers[];
}

export interface ShownFigure {
  name: string;
  title: string;
  note: string;
  plot?: ShownPlot | null;
  drawing?: ShownDrawing | null;
  animation?: ShownAnimation | null;
  timing?: ShownTiming | null;
  gantt?: ShownGantt | null;
  bars?: ShownBars | null;
}

export interface ShownTable {
  name: string;
  title: string;
  columns: { heading: string; unit: string; digits: number }[];
  rows: (number | string | null)[][];
}

export interface ShownSection {
  machine: string;
  title: string;
  lead: string;
  depth: number;
  figures?: ShownFigure[];
  tables?: ShownTable[];
}
