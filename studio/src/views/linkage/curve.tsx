/** Curves over the drive, with the cursor of the drawing: a press moves the drive there. */
import { useMemo } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { fromSi, shownUnit } from "../../ui";
import type { Editor } from "./editor";
import { between, range, sampleAt, wrapped } from "./figure";

interface Props {
  editor: Editor;
  title: string;
  unit: string;
  series: Readonly<Record<string, readonly (number | null)[]>>;
  /** A level drawn across [SI]. */
  limit?: number;
}

const [WIDTH, HEIGHT, LEFT, TOP, BOTTOM] = [340, 150, 42, 10, 24];

export function Curve({ editor, title, unit, series, limit }: Props) {
  const motion = editor.answer.value?.motion;
  const names = Object.keys(series);
  const low = Math.min(0, ...names.flatMap((name) => finite(series[name])));
  const high = Math.max(limit ?? 0, ...names.flatMap((name) => finite(series[name])));
  const [first, last] = motion ? range(motion) : [0, 1];
  const span = high - low || 1;
  const x = (value: number) => LEFT + ((value - first) / (last - first || 1)) * (WIDTH - LEFT - 8);
  const y = (value: number) => TOP + (1 - (value - low) / span) * (HEIGHT - TOP - BOTTOM);
  const paths = useMemo(
    () => names.map((name) => pathOf(motion?.values ?? [], series[name] ?? [], x, y)),
    [motion, series],
  );
  if (!motion || names.length === 0) return null;
  const turning = motion.kind === "rotation";
  const drive = turning ? "deg" : "mm";
  const value = wrapped(motion, editor.value.value);
  const sample = sampleAt(motion.values, value);
  const go = (event: PointerEvent & { currentTarget: SVGSVGElement }) => {
    if (event.type !== "pointerdown" && event.buttons !== 1) return;
    const { left, width } = event.currentTarget.getBoundingClientRect();
    const at = ((event.clientX - left) / width) * WIDTH;
    editor.isPlaying.value = false;
    editor.value.value =
      first + (Math.min(Math.max(at - LEFT, 0), WIDTH - LEFT - 8) / (WIDTH - LEFT - 8)) * (last - first);
  };
  return (
    <figure class="linkage-curve">
      <figcaption>{`${title} [${shownUnit(unit)}]`}</figcaption>
      <svg
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        role="img"
        aria-label={t("linkage.curveOf", { title, names: names.join(", ") })}
        onPointerDown={go}
        onPointerMove={go}
      >
        {[low, (low + high) / 2, high].map((level) => (
          <g key={level} class="level">
            <path d={`M${LEFT} ${y(level)}H${WIDTH - 8}`} />
            <text x={LEFT - 5} y={y(level) + 4}>
              {formatNumber(fromSi(level, unit), 3)}
            </text>
          </g>
        ))}
        {[first, (first + last) / 2, last].map((at) => (
          <text key={at} class="tick" x={x(at)} y={HEIGHT - 7}>
            {`${formatNumber(fromSi(at, drive), 4)}${turning ? "°" : ""}`}
          </text>
        ))}
        {limit !== undefined && <path class="limit" d={`M${LEFT} ${y(limit)}H${WIDTH - 8}`} />}
        {paths.map((d, index) => (
          <path key={names[index]} class={`line line-${index % 8}`} d={d} />
        ))}
        <path class="cursor" d={`M${x(value)} ${TOP}V${HEIGHT - BOTTOM}`} />
      </svg>
      <ul>
        {names.map((name, index) => {
          const now = between(series[name] ?? [], sample);
          return (
            <li key={name}>
              <svg viewBox="0 0 18 8" aria-hidden="true">
                <path class={`line line-${index % 8}`} d="M0 4H18" />
              </svg>
              {`${name}: ${now === null ? "–" : formatNumber(fromSi(now, unit), 4)}${shownUnit(unit) === "°" ? "°" : ` ${shownUnit(unit)}`}`}
            </li>
          );
        })}
      </ul>
    </figure>
  );
}

function finite(series: readonly (number | null)[] | undefined): number[] {
  return (series ?? []).filter((value): value is number => value !== null && Number.isFinite(value));
}

/** A curve with gaps where it has no value. */
export function pathOf(
  values: readonly (number | null)[],
  series: readonly (number | null)[],
  x: (value: number) => number,
  y: (value: number) => number,
): string {
  let open = true;
  return series
    .map((value, index) => {
      const at = values[index];
      if (value === null || at == null) {
        open = true;
        return "";
      }
      const part = `${open ? "M" : "L"}${x(at).toFixed(1)} ${y(value).toFixed(1)}`;
      open = false;
      return part;
    })
    .join("");
}
