/** The curves of B, in colours and marks of their own, dashed over those of A. */
import type { ShownFigure } from "../../api/messages";
import { aboutOf } from "../../draw/figures";

/** The figures of A with the curves of the figures of B that have the same name and the same axes. */
export function overlaid(a: readonly ShownFigure[], b: readonly ShownFigure[]): ShownFigure[] {
  const others = new Map(b.map((figure) => [aboutOf(figure).name, figure]));
  return a.map((figure) => {
    const [mine, theirs] = [figure.plot, others.get(aboutOf(figure).name)?.plot];
    if (!mine || !theirs || mine.x.label !== theirs.x.label || mine.y.unit !== theirs.y.unit) return figure;
    const looks = 1 + Math.max(...mine.series.map((curve) => curve.look));
    const dashed = theirs.series.map((curve) => {
      return { ...curve, label: `B: ${curve.label}`, look: looks + curve.look, dashed: true };
    });
    return { ...figure, plot: { ...mine, series: [...mine.series, ...dashed] } };
  });
}

/** The figures that are shown at first: what moves, else a drawing, and the first two curves; without curves both. */
export function firstFigures(known: readonly { name: string; kind: string }[]): string[] {
  const of = (kind: string) => known.filter((figure) => figure.kind === kind).map((figure) => figure.name);
  const [drawn, plots] = [[...of("animation").slice(0, 1), ...of("drawing").slice(0, 1)], of("plot").slice(0, 2)];
  return plots.length > 0 ? [...drawn.slice(0, 1), ...plots] : drawn;
}
