import { expect, test } from "vitest";
import type { ShownFigure } from "../../api/messages";
import { firstFigures, overlaid } from "./overlay";

function plot(name: string, label: string, y: number[], unit = "N"): ShownFigure {
  const series = [{ label, look: 0, dashed: false, x: [0, 1], y }];
  const axes = { x: { label: "crank angle", unit: "deg" }, y: { label: "force", unit: unit } };
  const other = { drawing: null, animation: null, timing: null, gantt: null, bars: null };
  return { plot: { name, title: name, note: "", ...axes, series, marks: [] }, ...other };
}

test("curves of B are dashed over those of A, where the axes are the same", () => {
  const a = [plot("pin-forces", "A0", [1, 2]), plot("torque", "M", [1, 2]), plot("alone", "x", [0, 0])];
  const b = [plot("pin-forces", "A0", [3, 4]), plot("torque", "M", [5, 6], "N*m")];
  const found = overlaid(a, b);
  expect(found[0]?.plot?.series.map((curve) => [curve.label, curve.dashed, curve.look, curve.y])).toEqual([
    ["A0", false, 0, [1, 2]],
    ["B: A0", true, 1, [3, 4]],
  ]);
  expect(found[1]).toBe(a[1]);
  expect(found[2]).toBe(a[2]);
  expect(a[0]?.plot?.series.length).toBe(1);
});

test("what moves and two curves are shown at first", () => {
  const known = ["d1 drawing", "m1 animation", "p1 plot", "p2 plot", "p3 plot"].map((text) => {
    const [name = "", kind = ""] = text.split(" ");
    return { name, kind };
  });
  expect(firstFigures(known)).toEqual(["m1", "p1", "p2"]);
  expect(firstFigures(known.filter((one) => one.kind !== "animation"))).toEqual(["d1", "p1", "p2"]);
  expect(firstFigures([])).toEqual([]);
});
