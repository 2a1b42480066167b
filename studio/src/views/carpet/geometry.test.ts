import { describe, expect, it } from "vitest";
import {
  CLOSEST,
  canvasPoint,
  chartPoint,
  closeTo,
  type Grid,
  heldView,
  knotAt,
  middleKnot,
  nearestKnot,
  panned,
  showing,
  tileKnots,
  tilesOf,
  weaverNumbers,
  wholeView,
  zoomed,
} from "./geometry";

const GRID: Grid = { rows: 300, columns: 200, aspect: 1.25 };
const SIZE = { width: 500, height: 400 };

describe("the view of a chart", () => {
  it("of single knots has a knot in its middle", () => {
    const knot = { column: 150, line: 20 };
    const view = closeTo(knot, GRID, SIZE);
    expect(knotAt(view, GRID, SIZE, SIZE.width / 2, SIZE.height / 2)).toEqual(knot);
    expect(middleKnot(view)).toEqual(knot);
  });

  it("shows the whole carpet", () => {
    const view = wholeView(GRID, SIZE);
    const first = canvasPoint(view, GRID, SIZE, 0, 0);
    const last = canvasPoint(view, GRID, SIZE, GRID.columns, GRID.rows);
    expect(first.y).toBeCloseTo(16);
    expect(last.y).toBeCloseTo(SIZE.height - 16);
    expect(first.x).toBeGreaterThan(16);
    expect((last.x - first.x) / (last.y - first.y)).toBeCloseTo((200 * 1.25) / 300);
  });

  it("leads from chart to canvas and back", () => {
    const view = { x: 40.25, y: 77, scale: 9 };
    const at = canvasPoint(view, GRID, SIZE, 12.5, 99.25);
    const back = chartPoint(view, GRID, SIZE, at.x, at.y);
    expect(back.x).toBeCloseTo(12.5);
    expect(back.y).toBeCloseTo(99.25);
  });

  it("keeps the point under the pointer while it zooms", () => {
    let view = wholeView(GRID, SIZE);
    for (const factor of [3, 1.7, 4, 0.6]) {
      const before = chartPoint(view, GRID, SIZE, 230, 210);
      view = zoomed(view, GRID, SIZE, factor, 230, 210);
      const after = chartPoint(view, GRID, SIZE, 230, 210);
      expect(after.x).toBeCloseTo(before.x);
      expect(after.y).toBeCloseTo(before.y);
    }
    expect(zoomed(view, GRID, SIZE, 1e6, 230, 210).scale).toBe(CLOSEST);
  });

  it("never loses the carpet", () => {
    const view = panned(wholeView(GRID, SIZE), GRID, SIZE, 1e5, -1e5);
    expect(view).toMatchObject({ x: 0, y: 300 });
    expect(heldView({ x: 0, y: 0, scale: 0 }, GRID, SIZE).scale).toBeCloseTo(wholeView(GRID, SIZE).scale / 2);
  });

  it("brings a knot into sight", () => {
    const close = { x: 10, y: 10, scale: 30 };
    const view = showing(close, GRID, SIZE, { column: 150, line: 250 });
    const at = canvasPoint(view, GRID, SIZE, 150.5, 250.5);
    expect(at.x).toBeCloseTo(SIZE.width - 40);
    expect(at.y).toBeCloseTo(SIZE.height - 40);
    expect(showing(view, GRID, SIZE, { column: 150, line: 250 })).toEqual(view);
  });
});

describe("the knot under the pointer", () => {
  it("is counted as the weaver counts", () => {
    expect(weaverNumbers({ column: 0, line: 299 }, GRID)).toEqual({ row: 1, knot: 1 });
    expect(weaverNumbers({ column: 199, line: 0 }, GRID)).toEqual({ row: 300, knot: 200 });
  });

  it("is none outside the carpet", () => {
    const view = wholeView(GRID, SIZE);
    const middle = knotAt(view, GRID, SIZE, 251, 201);
    expect(middle).toEqual({ column: 100, line: 150 });
    expect(knotAt(view, GRID, SIZE, 2, 200)).toBeNull();
    expect(nearestKnot(view, GRID, SIZE, 2, -5)).toEqual({ column: 0, line: 0 });
  });
});

describe("tiles", () => {
  it("cover a chart once", () => {
    const tiles = tilesOf(7, 10, 4);
    expect(tiles).toHaveLength(6);
    expect(tiles.reduce((sum, tile) => sum + tile.rows * tile.columns, 0)).toBe(70);
    const knots = Uint8Array.from({ length: 70 }, (_, at) => at);
    const last = tiles[5];
    expect(last && [...tileKnots(knots, 10, last)]).toEqual([48, 49, 58, 59, 68, 69]);
    expect([...tileKnots(knots, 10, { column: 0, line: 2, columns: 10, rows: 1 })][0]).toBe(20);
  });
});
