/** Colours, dashes and markers of looks, in the theme that is shown. */
import { dark } from "../app/settings";

export interface Colours {
  curves: readonly string[];
  paper: string;
  ink: string;
  muted: string;
  axis: string;
  grid: string;
  steel: string;
  yarn: string;
  bad: string;
  good: string;
  accent: string;
}

const known = new Map<boolean, Colours>();

/** The element whose custom properties are the colours of figures. */
export const tokens: { of: Element } = { of: document.documentElement };

/** The colours of figures in the theme shown. */
export function colours(): Colours {
  const kept = known.get(dark.peek());
  if (kept !== undefined) return kept;
  const style = getComputedStyle(tokens.of);
  const of = (name: string) => style.getPropertyValue(`--${name}`).trim();
  const made: Colours = {
    curves: Array.from({ length: 8 }, (_, number) => of(`fig-${number}`)),
    paper: of("paper"),
    ink: of("fig-ink"),
    muted: of("fig-muted"),
    axis: of("fig-axis"),
    grid: of("fig-grid"),
    steel: of("fig-steel"),
    yarn: of("fig-yarn"),
    bad: of("fig-bad"),
    good: of("good"),
    accent: of("accent"),
  };
  if (made.paper !== "") known.set(dark.peek(), made);
  return made;
}

const DASHED = [
  [4.5, 2],
  [2.4, 1.4],
  [7.5, 2.2],
] as const;
const DOTTED = [
  [1.2, 1.6],
  [6, 1.8, 1.2, 1.8],
] as const;

/** The colour of a look. */
export function colourOf(look: number, from: Colours = colours()): string {
  return from.curves[look % 8] ?? from.ink;
}

/** The colour of a look as CSS, which follows the theme. */
export function cssColour(look: number): string {
  return `var(--fig-${look % 8})`;
}

/** Dash, gap, dash … in line widths: of dashed curves, and of looks beyond the palette. */
export function dashesOf(look: number, dashed = false): readonly number[] {
  const rounds = Math.floor(look / 8);
  if (dashed) return DASHED[rounds % DASHED.length] ?? [];
  return rounds === 0 ? [] : (DOTTED[(rounds - 1) % DOTTED.length] ?? []);
}

const ring = (count: number, from: number, radius: number): [number, number][] =>
  Array.from({ length: count }, (_, k) => {
    const angle = 2 * Math.PI * (from + k / count);
    return [radius * Math.cos(angle), -radius * Math.sin(angle)];
  });
const cross = (turn: number): [number, number][] => {
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const corners: [number, number][] = [];
  for (const [x, y] of [
    [3, -1],
    [3, 1],
    [1, 1],
  ] as const)
    corners.push([x / 2.7, y / 2.7]);
  return [0, 1, 2, 3].flatMap((k) =>
    corners.map(([x, y]): [number, number] => {
      const [qx, qy] = [
        [x, y],
        [-y, x],
        [-x, -y],
        [y, -x],
      ][k] as [number, number];
      return [qx * c - qy * s, qx * s + qy * c];
    }),
  );
};
const MARKERS: readonly [number, number][][] = [
  ring(14, 0, 0.9),
  ring(4, 1 / 8, 1.13),
  ring(3, 1 / 4, 1.2),
  ring(4, 0, 1.2),
  ring(3, -1 / 4, 1.2),
  [
    [0.35, 1.2],
    [-0.35, 1.2],
    [-0.35, -1.2],
    [0.35, -1.2],
  ],
  cross(0),
  cross(Math.PI / 4),
];

/** The corners of the marker of a look, of a radius of about 1; looks of one colour have different ones. */
export function markerOf(look: number): readonly [number, number][] {
  return MARKERS[(look + Math.floor(look / 8)) % MARKERS.length] ?? [];
}

/** The marker as an SVG path about a point. */
export function markerPath(look: number, x: number, y: number, radius: number): string {
  const corners = markerOf(look).map(([dx, dy]) => `${(x + radius * dx).toFixed(2)} ${(y + radius * dy).toFixed(2)}`);
  return `M${corners.join("L")}Z`;
}
