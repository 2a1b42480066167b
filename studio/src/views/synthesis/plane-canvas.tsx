import { useMemo, useState } from "preact/hooks";
import type { ShownFourBar, SynthesisAnswer } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button, formatQuantity, Segments } from "../../ui";
import type { At, Camera } from "./camera";
import { Canvas } from "./canvas";
import { reach, rowPath } from "./drawing";
import { type Handle, poseAt, type RegionKind, type Scene } from "./handles";
import {
  LISTS,
  type Machine,
  type Region,
  readBounds,
  readRegion,
  rectangle,
  type SynthesisData,
  type TaskPoint,
  withPoints,
  withSetting,
  writeBounds,
  writeRegion,
} from "./task";
import { MovingLinks } from "./thumbnail";

interface PlaneProps {
  data: SynthesisData;
  points: TaskPoint[];
  answer: SynthesisAnswer | null;
  chosen: ShownFourBar | null;
  point: number;
  onPoint: (index: number) => void;
  onChange: (data: SynthesisData, settled: boolean) => void;
}

const mm = (value: number) => formatNumber(value * 1000, 6);
const AXES = { x: mm, y: mm };

/** The plane of points or poses, regions, and the chosen four-bar in motion. */
export function PlaneCanvas(props: PlaneProps) {
  const { data, points, answer, chosen, onChange } = props;
  const machine = data.machine as Machine;
  const [tool, setTool] = useState<"points" | RegionKind>("points");
  const scene = useMemo<Scene>(() => ({ points, regions: regionsOf(data) }), [data, points]);
  const content = useMemo(() => contentOf(scene, chosen), [scene, chosen]);
  const poses = machine === "motion-four-bar";
  const change = (next: Scene, settled: boolean) => {
    onChange(withScene(data, next), settled);
    if (settled && tool !== "points") setTool("points");
  };
  const add = (at: At) => {
    onChange(withPoints(data, [...points, poses ? poseAt(points, at) : at]), true);
    props.onPoint(points.length);
  };
  const remove = (handle: Handle) => {
    if (handle.kind === "corner")
      onChange(withScene(data, { ...scene, regions: { ...scene.regions, [handle.region]: undefined } }), true);
    else
      onChange(
        withPoints(
          data,
          points.filter((_, at) => at !== handle.index),
        ),
        true,
      );
  };
  return (
    <div class="ui-stack">
      <div class="ui-row">
        <Segments
          label={t("synthesis.tool")}
          labelHidden
          value={tool}
          choices={[
            { value: "points", label: t(poses ? "synthesis.poses" : "synthesis.points") },
            { value: "pivots", label: t("synthesis.pivotRegion") },
            ...(poses ? [{ value: "keepOut" as const, label: t("synthesis.keepOut") }] : []),
          ]}
          onChange={setTool}
        />
        {(Object.keys(scene.regions) as RegionKind[]).map((kind) => (
          <Button
            key={kind}
            size="small"
            icon="remove"
            onClick={() => remove({ kind: "corner", region: kind, index: 0 })}
          >
            {t(kind === "pivots" ? "synthesis.removePivots" : "synthesis.removeKeepOut")}
          </Button>
        ))}
        <span class="ui-muted synthesis-hint">
          {t(tool !== "points" ? "synthesis.regionHint" : poses ? "synthesis.posesHint" : "synthesis.pointsHint")}
        </span>
      </div>
      <Canvas
        label={t("synthesis.canvas")}
        scene={scene}
        content={content}
        nameOf={nameOf(scene, poses)}
        axes={AXES}
        drawing={tool === "points" ? null : tool}
        canAdd={points.length < LISTS[machine].most}
        poseAt={poses ? (at) => poseAt(points, at) : null}
        chosen={props.point}
        onChoose={props.onPoint}
        onScene={change}
        onAdd={add}
        onRemove={remove}
        behind={(camera) => <Behind camera={camera} answer={answer} chosen={chosen} />}
      />
    </div>
  );
}

function Behind({
  camera,
  answer,
  chosen,
}: {
  camera: Camera;
  answer: SynthesisAnswer | null;
  chosen: ShownFourBar | null;
}) {
  return (
    <g class="behind">
      {answer?.curves?.pivots.map((row, index) => (
        <path key={`c${index}`} class="pivot-curve" d={rowPath(camera, row)} />
      ))}
      {answer?.candidates.map((one) =>
        one === chosen ? null : <path key={one.number} class="curve other" d={rowPath(camera, one.curve)} />,
      )}
      {chosen && (
        <>
          <path class="curve" d={rowPath(camera, chosen.curve)} />
          <MovingLinks one={chosen} camera={camera} />
        </>
      )}
    </g>
  );
}

/** The regions of a task: of a motion those of the file, of a path the bounds of the crank's pivot. */
export function regionsOf(data: SynthesisData): Scene["regions"] {
  const settings = data.settings ?? {};
  const found: Scene["regions"] = {};
  const pivots = data.machine === "motion-four-bar" ? readRegion(settings["pivot_region"]) : ofBounds(settings);
  const keepOut = data.machine === "motion-four-bar" ? readRegion(settings["keep_out"]) : null;
  if (pivots) found.pivots = pivots;
  if (keepOut) found.keepOut = keepOut;
  return found;
}

function ofBounds(settings: NonNullable<SynthesisData["settings"]>): Region | null {
  const [x, y] = [readBounds(settings["pivot_x"], "mm"), readBounds(settings["pivot_y"], "mm")];
  if (x === null || y === null || ![...x, ...y].every(Number.isFinite)) return null;
  return rectangle({ x: x[0], y: y[0] }, { x: x[1], y: y[1] });
}

/** The data with the points and regions of a scene. */
export function withScene(data: SynthesisData, scene: Scene): SynthesisData {
  let next = withPoints(data, scene.points);
  const before = regionsOf(data);
  const { pivots, keepOut } = scene.regions;
  if (data.machine === "motion-four-bar") {
    if (JSON.stringify(pivots) !== JSON.stringify(before.pivots))
      next = withSetting(next, "pivot_region", pivots && writeRegion(pivots));
    if (JSON.stringify(keepOut) !== JSON.stringify(before.keepOut))
      next = withSetting(next, "keep_out", keepOut && writeRegion(keepOut));
    return next;
  }
  if (JSON.stringify(pivots) === JSON.stringify(before.pivots)) return next;
  const [low, high] = [pivots?.[0], pivots?.[2]];
  next = withSetting(
    next,
    "pivot_x",
    low && high && writeBounds([Math.min(low.x, high.x), Math.max(low.x, high.x)], "mm"),
  );
  return withSetting(
    next,
    "pivot_y",
    low && high && writeBounds([Math.min(low.y, high.y), Math.max(low.y, high.y)], "mm"),
  );
}

/** What is to be in sight: points, regions, and the chosen four-bar in motion. */
function contentOf(scene: Scene, chosen: ShownFourBar | null): At[] {
  const regions = Object.values(scene.regions).flatMap((region) => [...(region ?? [])]);
  return [...scene.points, ...regions, ...(chosen ? reach(chosen) : [])];
}

function nameOf(scene: Scene, poses: boolean): (handle: Handle) => string {
  return (handle) => {
    if (handle.kind === "corner") {
      const corner = scene.regions[handle.region]?.[handle.index];
      const at = `${formatQuantity(corner?.x ?? 0, "mm")}, ${formatQuantity(corner?.y ?? 0, "mm")}`;
      return t("synthesis.cornerName", { number: handle.index + 1, at });
    }
    const point = scene.points[handle.index];
    const number = handle.index + 1;
    if (handle.kind === "angle")
      return t("synthesis.angleName", { number, angle: formatQuantity(point?.angle ?? 0, "deg") });
    const at = `${formatQuantity(point?.x ?? 0, "mm")}, ${formatQuantity(point?.y ?? 0, "mm")}`;
    return poses ? t("synthesis.poseName", { number, at }) : t("synthesis.pointName", { number, at });
  };
}
