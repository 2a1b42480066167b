/** The camera of the picture: standard views, keys, what is brought near, what is followed. */
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { framed, turnOfKey } from "./views";

const ANGLE_OF_VIEW = (32 * Math.PI) / 180;
const NEAREST = 0.08;

export class Camera {
  readonly lens = new three.PerspectiveCamera((ANGLE_OF_VIEW * 180) / Math.PI, 1, 0.005, 60);
  private readonly controls: OrbitControls;
  private readonly product = new three.Matrix4();
  private readonly frustum = new three.Frustum();

  constructor(canvas: HTMLCanvasElement, changed: () => void) {
    this.controls = new OrbitControls(this.lens, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", changed);
  }

  dispose(): void {
    this.controls.dispose();
  }

  /** Width over height of the picture. */
  setAspect(aspect: number): void {
    this.lens.aspect = aspect;
    this.lens.updateProjectionMatrix();
  }

  /** Size of a pixel of a picture so many pixels high, at a distance of 1. */
  static pixelAtOne(height: number): number {
    return (2 * Math.tan(ANGLE_OF_VIEW / 2)) / Math.max(height, 1);
  }

  /** Distance from what the camera looks at [m]. */
  get distance(): number {
    return this.lens.position.distanceTo(this.controls.target);
  }

  /** What the camera sees now. */
  view(): three.Frustum {
    this.lens.updateMatrixWorld();
    this.product.multiplyMatrices(this.lens.projectionMatrix, this.lens.matrixWorldInverse);
    return this.frustum.setFromProjectionMatrix(this.product);
  }

  /** Looks at boxes from a direction, from where they fit the picture; without a direction from where it stands. */
  look(boxes: readonly three.Box3[], direction?: readonly [number, number, number], room = 1): void {
    const away = direction ? new three.Vector3(...direction) : this.lens.position.clone().sub(this.controls.target);
    const middle = boxes.reduce((all, one) => all.union(one), new three.Box3()).getCenter(new three.Vector3());
    const points = boxes.flatMap((box) => corners(box).map((one) => one.sub(middle).toArray()));
    const { target, distance } = framed(points, away.toArray(), ANGLE_OF_VIEW, this.lens.aspect);
    this.controls.target.set(...target).add(middle);
    this.lens.position.copy(this.controls.target).addScaledVector(away.normalize(), Math.max(room * distance, NEAREST));
    this.controls.update();
  }

  /** Moves with what is followed [m]. */
  shift(by: three.Vector3): void {
    this.controls.target.add(by);
    this.lens.position.add(by);
  }

  /** Moves as a key says; whether it does anything. */
  key(key: string, shift: boolean): boolean {
    const by = turnOfKey(key, shift);
    if (by === null) return false;
    const target = this.controls.target;
    const from = new three.Spherical().setFromVector3(this.lens.position.clone().sub(target));
    from.theta += by.turn;
    from.phi = Math.min(Math.max(from.phi - by.tilt, 0.01), Math.PI - 0.01);
    from.radius *= by.zoom;
    const axis = (column: number) => new three.Vector3().setFromMatrixColumn(this.lens.matrix, column);
    target.addScaledVector(axis(0), by.right * from.radius).addScaledVector(axis(1), by.up * from.radius);
    this.lens.position.setFromSpherical(from).add(target);
    this.controls.update();
    return true;
  }
}

/** The corners of a box. */
function corners({ min, max }: three.Box3): three.Vector3[] {
  const end = (corner: number, bit: number) => ((corner >> bit) & 1 ? max : min);
  return Array.from({ length: 8 }, (_, k) => new three.Vector3(end(k, 0).x, end(k, 1).y, end(k, 2).z));
}
