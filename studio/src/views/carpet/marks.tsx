import { useMemo } from "preact/hooks";
import { canvasPoint, type Grid, type Knot, type Size, type View } from "./geometry";
import type { CarpetModel } from "./model";
import { pictureOf, placeAbout, shownPiece } from "./placing";
import { drawsLive } from "./pointer";
import { speckPath } from "./specks";
import type { useHand } from "./use-hand";

interface MarksProps {
  model: CarpetModel;
  grid: Grid;
  view: View;
  size: Size;
  cursor: Knot | null;
  hover: Knot | null;
  hand: ReturnType<typeof useHand>;
}

/** Cursor, tile and the part that is dragged, as lines over the chart. */
export function Marks({ model, grid, view, size, cursor, hover, hand }: MarksProps) {
  const part = hand.part.value;
  const specks = model.specks.value;
  const tile = model.tool.value === "repeat" ? model.tile.value : null;
  const box = (first: Knot, last: Knot) => {
    const [left, right] = [Math.min(first.column, last.column), Math.max(first.column, last.column) + 1];
    const [top, bottom] = [Math.min(first.line, last.line), Math.max(first.line, last.line) + 1];
    const from = canvasPoint(view, grid, size, left, top);
    const to = canvasPoint(view, grid, size, right, bottom);
    return { x: from.x, y: from.y, width: to.x - from.x, height: to.y - from.y };
  };
  const line = hand.line.value;
  const axes = drawsLive(model.tool.value) || model.placing.value?.kind === "motif" ? model.symmetry.value : "none";
  const middle = canvasPoint(view, grid, size, grid.columns / 2, grid.rows / 2);
  const ends = line?.map((knot) => canvasPoint(view, grid, size, knot.column + 0.5, knot.line + 0.5));
  return (
    <svg class="carpet-marks" aria-hidden="true">
      {specks !== null && model.specksShown.value && <path class="specks" d={speckPath(specks, grid, view, size)} />}
      {(axes === "across" || axes === "both") && (
        <line class="axis" x1={middle.x} y1={0} x2={middle.x} y2={size.height} />
      )}
      {(axes === "along" || axes === "both") && (
        <line class="axis" x1={0} y1={middle.y} x2={size.width} y2={middle.y} />
      )}
      {axes === "turned" && <circle class="axis" cx={middle.x} cy={middle.y} r={8} />}
      {tile !== null && <rect class="tile" {...box(tile[0], tile[1])} />}
      {model.selection.value !== null && <rect class="part" {...box(...model.selection.value)} />}
      <Held model={model} grid={grid} view={view} size={size} about={hover ?? cursor} />
      {part !== null && <rect class="part" {...box(part[0], part[1])} />}
      {ends?.[0] && ends[1] && <line class="part" x1={ends[0].x} y1={ends[0].y} x2={ends[1].x} y2={ends[1].y} />}
      {cursor !== null && (
        <>
          <rect
            class="row"
            {...box({ column: 0, line: cursor.line }, { column: grid.columns - 1, line: cursor.line })}
          />
          <rect class="cursor" {...box(cursor, cursor)} />
        </>
      )}
    </svg>
  );
}

interface HeldProps {
  model: CarpetModel;
  grid: Grid;
  view: View;
  size: Size;
  about: Knot | null;
}

/** What is held over the chart, where it would be placed. */
function Held({ model, grid, view, size, about }: HeldProps) {
  const placing = model.placing.value;
  const piece = useMemo(() => (placing === null ? null : shownPiece(placing)), [placing]);
  const href = useMemo(() => (piece === null ? "" : pictureOf(piece)), [piece]);
  if (placing === null || piece === null || about === null) return null;
  const { column, line } = placeAbout(about, placing, grid);
  const from = canvasPoint(view, grid, size, column, line);
  const to = canvasPoint(view, grid, size, column + piece.columns, line + piece.rows);
  const box = { x: from.x, y: from.y, width: to.x - from.x, height: to.y - from.y };
  return (
    <>
      <image class="held" href={href} preserveAspectRatio="none" {...box} />
      <rect class="part" {...box} />
    </>
  );
}
