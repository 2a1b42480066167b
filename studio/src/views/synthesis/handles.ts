/** What can be dragged on the canvas, and what a drag or a key does to it. */
import { type At, type Camera, niceStep, snapped, toPlane, toScreen } from "./camera";
import type { Region, TaskPoint } from "./task";

/** A region of the canvas: where pivots may be, or what the links keep clear of. */
export type RegionKind = "pivots" | "keepOut";

export type Handle =
  | { kind: "point"; index: number }
  | { kind: "angle"; index: number }
  | { kind: "corner"; region: RegionKind; index: number };

/** Everything on the canvas that the user changes. */
export interface Scene {
  points: TaskPoint[];
  regions: Partial<Record<RegionKind, Region>>;
}

/** Distance of the direction handle of a pose from its point [px]. */
export const ARM = 46;

/** Screen position of a handle; null where it is not there. */
export function handleAt(scene: Scene, camera: Camera, handle: Handle): At | null {
  if (handle.kind === "corner") {
    const corner = scene.regions[handle.region]?.[handle.index];
    return corner === undefined ? null : toScreen(camera, corner);
  }
  const point = scene.points[handle.index];
  if (point === undefined) return null;
  const at = toScreen(camera, point);
  if (handle.kind === "point") return at;
  if (point.angle === undefined) return null;
  return { x: at.x + ARM * Math.cos(point.angle), y: at.y - ARM * Math.sin(point.angle) };
}

/** All handles, those drawn last first: they are taken first. */
export function handlesOf(scene: Scene): Handle[] {
  const points = scene.points.map((_, index): Handle => ({ kind: "point", index }));
  const angles = scene.points.flatMap((one, index): Handle[] =>
    one.angle === undefined ? [] : [{ kind: "angle", index }],
  );
  const corners = (Object.keys(scene.regions) as RegionKind[]).flatMap((region) =>
    (scene.regions[region] ?? []).map((_, index): Handle => ({ kind: "corner", region, index })),
  );
  return [...points.reverse(), ...angles.reverse(), ...corners];
}

/** The handle nearest to a place on the screen, within a distance [px]. */
export function nearest(scene: Scene, camera: Camera, at: At, within: number): Handle | null {
  let best: { handle: Handle; distance: number } | null = null;
  for (const handle of handlesOf(scene)) {
    const own = handleAt(scene, camera, handle);
    if (own === null) continue;
    const distance = Math.hypot(own.x - at.x, own.y - at.y);
    if (distance <= within && (best === null || distance < best.distance)) best = { handle, distance };
  }
  return best?.handle ?? null;
}

/** Steps to which dragged positions are rounded: about three pixels. */
export function steps(camera: Camera): At {
  return { x: niceStep(3 / camera.sx), y: niceStep(3 / camera.sy) };
}

const DEGREE = Math.PI / 180;

/** The scene with a handle dragged to a place on the screen. */
export function dragged(scene: Scene, camera: Camera, handle: Handle, to: At): Scene {
  if (handle.kind === "angle") {
    const point = scene.points[handle.index];
    if (point === undefined) return scene;
    const at = toScreen(camera, point);
    const angle = Math.atan2(at.y - to.y, to.x - at.x);
    return withAngle(scene, handle.index, nearTurn(snapped(angle / DEGREE, 1) * DEGREE, point.angle ?? 0));
  }
  return movedTo(scene, handle, snappedToPlane(camera, to));
}

/** A position of the screen in the plane, rounded. */
export function snappedToPlane(camera: Camera, at: At): At {
  const [step, plane] = [steps(camera), toPlane(camera, at)];
  return { x: snapped(plane.x, step.x), y: snapped(plane.y, step.y) };
}

/** A pose at a place: its direction is that from the pose before, in whole degrees; the first one has 0. */
export function poseAt(poses: readonly TaskPoint[], at: At): TaskPoint {
  const last = poses.at(-1);
  if (last === undefined) return { ...at, angle: 0 };
  const angle = snapped(Math.atan2(at.y - last.y, at.x - last.x) / DEGREE, 1) * DEGREE;
  return { ...at, angle: nearTurn(angle, last.angle ?? 0) };
}

/** The same angle, less than half a turn from another one. */
export function nearTurn(angle: number, other: number): number {
  return angle + 2 * Math.PI * Math.round((other - angle) / (2 * Math.PI));
}

function withAngle(scene: Scene, index: number, angle: number): Scene {
  return { ...scene, points: scene.points.map((one, at) => (at === index ? { ...one, angle } : one)) };
}

/** The scene with a point, or a corner, at a place of the plane. */
export function movedTo(scene: Scene, handle: Handle, to: At): Scene {
  if (handle.kind === "corner") {
    const region = scene.regions[handle.region];
    if (region === undefined) return scene;
    return { ...scene, regions: { ...scene.regions, [handle.region]: withCorner(region, handle.index, to) } };
  }
  return { ...scene, points: scene.points.map((one, at) => (at === handle.index ? { ...one, ...to } : one)) };
}

/** A region with one corner moved; a rectangle stays one. */
export function withCorner(region: Region, index: number, to: At): Region {
  const opposite = region[(index + 2) % 4];
  const own = region[index];
  const upright = region.length === 4 && own && opposite && region.every((one) => [own.x, opposite.x].includes(one.x));
  if (!upright) return region.map((one, at) => (at === index ? to : one));
  const [before, after] = [(index + 3) % 4, (index + 1) % 4];
  const shared = region[before]?.x === own.x;
  return region.map((one, at) => {
    if (at === index) return to;
    if (at === before) return shared ? { x: to.x, y: one.y } : { x: one.x, y: to.y };
    if (at === after) return shared ? { x: one.x, y: to.y } : { x: to.x, y: one.y };
    return one;
  });
}

const ARROWS: Record<string, At> = {
  ArrowLeft: { x: -1, y: 0 },
  ArrowRight: { x: 1, y: 0 },
  ArrowUp: { x: 0, y: 1 },
  ArrowDown: { x: 0, y: -1 },
};

/** The scene after an arrow key on a handle; null for another key. With Shift ten times as far. */
export function nudged(scene: Scene, camera: Camera, handle: Handle, key: string, shift: boolean): Scene | null {
  const by = ARROWS[key];
  if (by === undefined) return null;
  const times = shift ? 10 : 1;
  if (handle.kind === "angle") {
    const angle = scene.points[handle.index]?.angle ?? 0;
    return withAngle(scene, handle.index, angle + (by.y - by.x || by.y) * times * DEGREE);
  }
  const at = handle.kind === "point" ? scene.points[handle.index] : scene.regions[handle.region]?.[handle.index];
  if (at === undefined) return null;
  const step = steps(camera);
  return movedTo(scene, handle, {
    x: Number((at.x + by.x * step.x * times).toPrecision(10)),
    y: Number((at.y + by.y * step.y * times).toPrecision(10)),
  });
}
