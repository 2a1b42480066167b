import { useMemo } from "preact/hooks";
import type { ShownFourBar, SynthesisAnswer } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button } from "../../ui";
import { type At, fitted } from "./camera";
import { Canvas } from "./canvas";
import { reach, rowPath } from "./drawing";
import { generatedRow, requiredRow, samplesOf } from "./function-scene";
import type { Handle, Scene } from "./handles";
import { isRemovable, LISTS, type SynthesisData, type TaskPoint, withPoints, withSetting } from "./task";
import { MovingLinks } from "./thumbnail";

interface FunctionProps {
  data: SynthesisData;
  points: TaskPoint[];
  answer: SynthesisAnswer | null;
  chosen: ShownFourBar | null;
  point: number;
  onPoint: (index: number) => void;
  onChange: (data: SynthesisData, settled: boolean) => void;
}

const plain = (value: number) => formatNumber(value, 6);
const AXES = { x: plain, y: plain };

/** The plot of a function: required, generated, its samples to be dragged; beside it the four-bar in motion. */
export function FunctionCanvas(props: FunctionProps) {
  const { data, points, answer, chosen, onChange } = props;
  const required = useMemo(() => (answer ? requiredRow(answer, points) : []), [answer, points]);
  const generated = useMemo(
    () => (answer && chosen ? generatedRow(answer, chosen, points) : []),
    [answer, chosen, points],
  );
  const scene = useMemo<Scene>(() => ({ points, regions: {} }), [points]);
  const content = useMemo(() => [...points, ...atRow(required)], [points, required]);
  const list = LISTS["function-four-bar"];
  const change = (next: Scene, settled: boolean) => {
    if (new Set(next.points.map((one) => one.x)).size === next.points.length)
      onChange(withPoints(data, next.points), settled);
    else if (settled) onChange(data, true);
  };
  const toSamples = () => {
    const free = ["start", "stop", "function"].reduce<SynthesisData>(
      (made, name) => withSetting(made, name, undefined),
      data,
    );
    if (answer) onChange(withPoints(free, samplesOf(answer)), true);
  };
  const add = (at: At) => {
    if (!points.some((one) => one.x === at.x)) onChange(withPoints(data, [...points, at]), true);
  };
  const remove = (handle: Handle) => {
    if (isRemovable("function-four-bar", points.length))
      onChange(
        withPoints(
          data,
          points.filter((_, index) => index !== handle.index),
        ),
        true,
      );
  };
  return (
    <div class="ui-stack">
      <div class="ui-row">
        {points.length === 0 ? (
          <Button icon="pencil" disabled={answer?.required == null} onClick={toSamples}>
            {t("synthesis.asSamples")}
          </Button>
        ) : (
          <Button icon="reset" onClick={() => onChange(withSetting(data, "samples", undefined), true)}>
            {t("synthesis.asNamed")}
          </Button>
        )}
        <span class="ui-muted synthesis-hint">
          {t(points.length ? "synthesis.samplesHint" : "synthesis.namedHint")}
        </span>
      </div>
      <Canvas
        label={t("synthesis.functionCanvas")}
        scene={scene}
        content={content}
        nameOf={(handle) => {
          const one = points[handle.index];
          return t("synthesis.sampleName", {
            number: handle.index + 1,
            at: `${plain(one?.x ?? 0)}, ${plain(one?.y ?? 0)}`,
          });
        }}
        axes={AXES}
        stretched
        drawing={null}
        canAdd={points.length > 0 && points.length < list.most}
        chosen={props.point}
        onChoose={props.onPoint}
        onScene={change}
        onAdd={add}
        onRemove={remove}
        behind={(camera) => (
          <g class="behind">
            <path class="required" d={rowPath(camera, required)} />
            <path class="curve" d={rowPath(camera, generated)} />
          </g>
        )}
      />
      <p class="ui-help synthesis-legend">
        <span class="required">{t("synthesis.required")}</span>{" "}
        <span class="generated">{t("synthesis.generated")}</span>
      </p>
      {chosen && <Moving one={chosen} />}
    </div>
  );
}

function atRow(row: readonly number[]): At[] {
  return Array.from({ length: row.length / 2 }, (_, index) => ({ x: row[2 * index] ?? 0, y: row[2 * index + 1] ?? 0 }));
}

function Moving({ one }: { one: ShownFourBar }) {
  const camera = useMemo(() => fitted(reach(one), { width: 520, height: 240 }, 24), [one]);
  return (
    <svg
      class="synthesis-moving"
      viewBox="0 0 520 240"
      role="img"
      aria-label={t("synthesis.inMotion", { number: one.number })}
    >
      <MovingLinks one={one} camera={camera} />
    </svg>
  );
}
