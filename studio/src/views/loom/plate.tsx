/** The drawing of a plate: its outline with its holes, and its sizes. */
import { useEffect, useState } from "preact/hooks";
import { post } from "../../api/request";
import { t } from "../../text";
import { formatQuantity } from "../../ui";

export interface PlateDrawing {
  title: string;
  lines: number[][];
  holes: [number, number, number][];
  thickness: number;
  material: string;
  number: number;
  notes: string[];
}

/** The box of a closed line, x and y in turn: left, low, width, height. */
export function boxOf(line: readonly number[]): [left: number, low: number, wide: number, high: number] {
  const x = line.filter((_, k) => k % 2 === 0);
  const y = line.filter((_, k) => k % 2 === 1);
  const [left, low] = [Math.min(...x), Math.min(...y)];
  return [left, low, Math.max(...x) - left, Math.max(...y) - low];
}

/** Closed lines as a path of SVG, y up. */
export function pathOf(lines: readonly (readonly number[])[]): string {
  const number = (value: number) => value.toFixed(6);
  return lines
    .map((line) => {
      const corners = [];
      for (let k = 0; k + 1 < line.length; k += 2)
        corners.push(`${number(line[k] ?? 0)} ${number(-(line[k + 1] ?? 0))}`);
      return `M${corners.join("L")}Z`;
    })
    .join("");
}

export function PlateSketch({ file, plate }: { file: string; plate: string }) {
  const [drawing, setDrawing] = useState<PlateDrawing | null>(null);
  const [error, setError] = useState("");
  useEffect(() => {
    const control = new AbortController();
    setDrawing(null);
    setError("");
    post<PlateDrawing>("/loom/plate", { file, plate }, control.signal).then(setDrawing, (reason: unknown) => {
      if (!control.signal.aborted) setError(reason instanceof Error ? reason.message : String(reason));
    });
    return () => control.abort();
  }, [file, plate]);
  if (error !== "") return <p class="ui-callout bad">{t("loom.drawingFailed", { reason: error })}</p>;
  if (drawing === null) return null;
  const [left, low, wide, high] = boxOf(drawing.lines[0] ?? [0, 0]);
  const margin = 0.06 * Math.max(wide, high);
  const view = [left - margin, -(low + high) - margin, wide + 2 * margin, high + 2 * margin].join(" ");
  const words = t("loom.drawingText", {
    title: drawing.title,
    wide: formatQuantity(wide, "mm"),
    high: formatQuantity(high, "mm"),
    thickness: formatQuantity(drawing.thickness, "mm"),
    number: drawing.number,
  });
  return (
    <figure class="loom-plate">
      <h3>{t("loom.drawing")}</h3>
      <svg viewBox={view} role="img" aria-label={words}>
        <path d={pathOf(drawing.lines)} fill-rule="evenodd" vector-effect="non-scaling-stroke" />
        {drawing.holes.map(([x, y, radius]) => (
          <circle key={`${x} ${y}`} cx={x} cy={-y} r={radius} vector-effect="non-scaling-stroke" />
        ))}
      </svg>
      <figcaption>{[words, drawing.material, ...drawing.notes].join("; ")}</figcaption>
    </figure>
  );
}
