/** Curves over the drive: their cursor is the position of the mechanism. */
import { useSignalEffect } from "@preact/signals";
import { useContext, useMemo } from "preact/hooks";
import type { MotionAnswer } from "../../api/messages";
import { CursorContext, type Cursors, cursorOf, Plot } from "../../draw";
import type { Mark, ShownPlot } from "../../draw/figures";
import { t } from "../../text";
import type { Editor } from "./editor";
import { wrapped } from "./figure";

type Numbers = readonly (number | null)[];

interface Props {
  motion: MotionAnswer;
  title: string;
  unit: string;
  series: Readonly<Record<string, Numbers>>;
  /** A level drawn across [SI]. */
  limit?: { value: number; label: string };
}

/** One cursor for all curves over the drive, tied to the position of the mechanism. */
export function useDriveCursor(editor: Editor): Cursors {
  const cursors = useMemo<Cursors>(() => new Map(), [editor]);
  useSignalEffect(() => {
    const motion = editor.answer.value?.motion;
    if (!motion) return;
    const cursor = cursorOf(cursors, driveLabel(motion));
    cursor.player.value = editor.isPlaying.value || editor.isDragging.value ? editor : null;
    cursor.at.value = wrapped(motion, editor.value.value);
  });
  useSignalEffect(() => {
    const motion = editor.answer.value?.motion;
    if (!motion) return;
    const cursor = cursorOf(cursors, driveLabel(motion));
    const at = cursor.at.value;
    if (at === null || Math.abs(at - wrapped(motion, editor.value.peek())) < 1e-12) return;
    if (cursor.player.peek() === null) editor.isPlaying.value = false;
    editor.value.value = at;
  });
  return cursors;
}

function driveLabel(motion: MotionAnswer): string {
  return motion.driving;
}

export function Curve({ motion, title, unit, series, limit }: Props) {
  const cursors = useContext(CursorContext);
  const plot = useMemo(() => plotOf(motion, title, unit, series, limit), [motion, title]);
  if (plot.series.length === 0) return null;
  cursorOf(cursors, plot.x.label);
  return (
    <Plot
      plot={plot}
      title={`${t("linkage.curveOf", { title, names: Object.keys(series).join(", ") })}`}
      height={150}
    />
  );
}

/** Curves over the drive, with a limit across and the dead centres as marks. */
export function plotOf(
  motion: MotionAnswer,
  title: string,
  unit: string,
  series: Readonly<Record<string, Numbers>>,
  limit?: { value: number; label: string },
): ShownPlot {
  const curves = Object.entries(series).map(([label, y], look) => ({
    label,
    look,
    dashed: false,
    x: motion.values,
    y: [...y],
  }));
  const ends = [motion.values[0] ?? 0, motion.values.at(-1) ?? 0];
  if (limit && curves.length > 0) {
    curves.push({ label: limit.label, look: 7, dashed: true, x: ends, y: [limit.value, limit.value] });
  }
  const marks: Mark[] = motion.dead_centres.map((one) => ({ x: one.value, label: one.bodies.join(", ") }));
  const drive = motion.kind === "rotation" ? "deg" : "mm";
  return { x: { label: driveLabel(motion), unit: drive }, y: { label: title, unit: unit }, series: curves, marks };
}
