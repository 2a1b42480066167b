/** The measuring tool: two points of the picture, the line between them, their distance. */
import * as three from "three";
import { formatNumber, t } from "../../text";

/** A corner of a part is taken where it is nearer to the point that was shown than this [px]. */
const SNAP = 9;

export class Measure {
  readonly line: three.Line<three.BufferGeometry, three.LineBasicMaterial>;
  private readonly points: three.Vector3[] = [];

  constructor() {
    const material = new three.LineBasicMaterial({ color: 0xd22f27, depthTest: false, transparent: true });
    this.line = new three.Line(new three.BufferGeometry(), material);
    this.line.renderOrder = 2;
    this.line.frustumCulled = false;
    this.line.visible = false;
  }

  /** Takes a point; the third begins again. */
  take(point: three.Vector3): void {
    if (this.points.length === 2) this.points.length = 0;
    this.points.push(point);
    const [from, to = from] = this.points;
    if (from && to) this.line.geometry.setFromPoints([from, to]);
    this.line.visible = this.points.length === 2;
  }

  clear(): void {
    this.points.length = 0;
    this.line.visible = false;
  }

  /** What is written in the picture, and where in space; null: nothing is measured. */
  label(): { text: string; at: three.Vector3 } | null {
    const [from, to] = this.points;
    if (!from) return null;
    if (!to) return { text: t("loom.measureOn"), at: from.clone() };
    return { text: distanceText(from.toArray(), to.toArray()), at: from.clone().lerp(to, 0.5) };
  }
}

/** Distance of two points, and its shares across, up and to the front [mm]. */
export function distanceText(from: readonly number[], to: readonly number[]): string {
  const shares = [0, 1, 2].map((k) => (to[k] ?? 0) - (from[k] ?? 0));
  const [all, x, y, z] = [Math.hypot(...shares), ...shares].map((one) => formatNumber(Math.round(1e5 * one) / 100));
  return t("loom.distance", { all: all ?? "", x: x ?? "", y: y ?? "", z: z ?? "" });
}

/** The corner of a triangle that is nearest to a point in it, where it is nearer than so many metres; else the point. */
export function snapped(point: three.Vector3, corners: readonly three.Vector3[], pixel: number): three.Vector3 {
  const near = corners.filter((one) => one.distanceTo(point) < SNAP * pixel);
  near.sort((a, b) => a.distanceTo(point) - b.distanceTo(point));
  return (near[0] ?? point).clone();
}
