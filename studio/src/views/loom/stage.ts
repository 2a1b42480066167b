/** The loom drawn by three.js: parts as instances, warps, yarns and carpet; drawn only when something has changed. */
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Cloth } from "./cloth-mesh";
import { spacingOf, strideFor, thinned } from "./crowd";
import { colourOf, type Look, look } from "./look";
import { type Angles, Frames, type Placed } from "./motion";
import type { Drive, SceneModel, ScenePart } from "./scene";
import { drawnBySoftware, floorGrid, lights } from "./surroundings";
import { Threads } from "./threads";
import { DIRECTIONS, fittingDistance, levelFor, turnOfKey, type ViewName } from "./views";

const ANGLE_OF_VIEW = 32;
const RADIANS = Math.PI / 180;

/** Copies of a part from which on only those that are needed are drawn. */
const CROWD = 64;

/** Deviation of a solid from the part that is not seen [px]. */
const COARSE = 1.3;

interface Shown {
  part: ScenePart;
  placed: Placed;
  mesh: three.InstancedMesh;
  levels: three.BufferGeometry[];
  /** Where the part is moved when the loom is exploded, for the factor 1 [m]. */
  apart: three.Vector3;
  /** The matrices of all copies of a crowd, and their distance across [m]. */
  all: Float32Array;
  spacing: number;
}

export interface Pick {
  name: string;
  point: three.Vector3;
}

export class Stage {
  readonly camera = new three.PerspectiveCamera(ANGLE_OF_VIEW, 1, 0.005, 60);
  readonly scene = new three.Scene();
  readonly frames: Frames;
  readonly parts: Shown[] = [];
  readonly cloth: Cloth;
  readonly threads: Threads;
  /** Called after each picture. */
  drawn: () => void = () => {};

  private readonly renderer: three.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly plane = new three.Plane(new three.Vector3(-1, 0, 0), 0);
  private readonly box = new three.Box3();
  private readonly selectBox = new three.Box3();
  private readonly product = new three.Matrix4();
  private readonly frustum = new three.Frustum();
  private readonly sphere = new three.Sphere();
  private look: Look = look(null);
  private waiting = 0;
  private pictures = 0;
  private angles: Angles = { row: 0, knot: 0 };
  private followed: number | null = null;
  private followedAt = new three.Vector3();
  private exploded = 0;
  private chosen = "";

  constructor(
    readonly model: SceneModel,
    private readonly canvas: HTMLCanvasElement,
  ) {
    this.renderer = new three.WebGLRenderer({
      canvas,
      antialias: !drawnBySoftware(),
      powerPreference: "high-performance",
    });
    this.renderer.localClippingEnabled = true;
    this.frames = new Frames(model);
    this.frames.update(this.angles);
    for (const part of model.about.parts) this.addPart(part);
    this.cloth = new Cloth(model);
    this.threads = new Threads(model, this.frames);
    this.scene.add(this.cloth.mesh, this.threads.group, floorGrid(model.about.floor), ...lights());
    this.place();
    this.measure();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", this.invalidate);
    this.show("iso");
  }

  /** Frees everything of the graphics processor. */
  dispose(): void {
    cancelAnimationFrame(this.waiting);
    this.controls.dispose();
    for (const { levels, mesh } of this.parts) {
      for (const level of levels) level.dispose();
      (mesh.material as three.Material).dispose();
      mesh.dispose();
    }
    this.cloth.dispose();
    this.threads.dispose();
    this.renderer.dispose();
  }

  /** Draws a picture as soon as the browser is ready, once for all changes. */
  readonly invalidate = (): void => {
    if (this.waiting === 0) this.waiting = requestAnimationFrame(this.draw);
  };

  readonly draw = (): void => {
    this.waiting = 0;
    this.chooseDetail();
    this.renderer.render(this.scene, this.camera);
    this.pictures += 1;
    this.canvas.dataset["pictures"] = String(this.pictures);
    this.drawn();
  };

  /** Fits the picture to the size of the canvas [px]. */
  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  setTheme(theme: string | null): void {
    this.look = look(theme);
    this.scene.background = new three.Color(this.look.ground);
    for (const shown of this.parts) this.paint(shown);
    this.threads.paint(this.look);
    this.invalidate();
  }

  /** Turns row and knot to angles [rad]. */
  turn(angles: Angles): void {
    const changed = (["row", "knot"] as Drive[]).filter((drive) => angles[drive] !== this.angles[drive]);
    this.angles = { ...angles };
    for (const drive of changed) this.frames.update(angles, drive);
    for (const shown of this.parts) if (changed.some((drive) => shown.placed.moves[drive])) this.arrange(shown);
    this.threads.update(angles);
    this.follow();
    this.invalidate();
  }

  /** Puts the heads at positions across [m]. */
  putHeads(x: readonly number[]): void {
    const heads = this.frames.byName.get(this.model.about.heads);
    if (heads === undefined) return;
    x.forEach((value, index) => {
      if (3 * index < heads.origins.length) heads.origins[3 * index] = value;
    });
    this.place();
    this.threads.update(this.angles);
    this.follow();
    this.invalidate();
  }

  /** Rows that are woven; a part of one too. */
  weave(rows: number): void {
    this.cloth.weave(rows);
    this.invalidate();
  }

  show(name: ViewName): void {
    this.camera.aspect ||= 1;
    const box = this.boxOf(name);
    const target = box.getCenter(new three.Vector3());
    const corners = { low: box.min.toArray(), high: box.max.toArray() };
    const far = fittingDistance(corners, ANGLE_OF_VIEW * RADIANS, this.camera.aspect);
    const away = new three.Vector3(...DIRECTIONS[name]).normalize().multiplyScalar(far);
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(away);
    this.controls.update();
    this.invalidate();
  }

  /** Moves the camera as a key says; whether it does anything. */
  key(key: string, shift: boolean): boolean {
    const by = turnOfKey(key, shift);
    if (by === null) return false;
    const target = this.controls.target;
    const from = new three.Spherical().setFromVector3(this.camera.position.clone().sub(target));
    from.theta += by.turn;
    from.phi = Math.min(Math.max(from.phi - by.tilt, 0.01), Math.PI - 0.01);
    from.radius *= by.zoom;
    const right = new three.Vector3().setFromMatrixColumn(this.camera.matrix, 0).multiplyScalar(by.right * from.radius);
    const up = new three.Vector3().setFromMatrixColumn(this.camera.matrix, 1).multiplyScalar(by.up * from.radius);
    target.add(right).add(up);
    this.camera.position.setFromSpherical(from).add(target);
    this.controls.update();
    this.invalidate();
    return true;
  }

  /** Keeps the camera beside a head; null: it stands. */
  followHead(number: number | null): void {
    this.followed = number;
    const at = this.headAt(number ?? 0);
    if (number === null || at === null) return;
    this.followedAt.copy(at);
    this.show("head");
  }

  /** Cuts away what lies beyond a share of the loom along an axis; null: nothing. */
  section(axis: "x" | "y" | "z" | null, share: number): void {
    const planes = axis === null ? [] : [this.plane];
    if (axis !== null) {
      this.plane.normal.set(axis === "x" ? -1 : 0, axis === "y" ? -1 : 0, axis === "z" ? -1 : 0);
      this.plane.constant = this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
    }
    for (const { mesh } of this.parts) this.clip(mesh.material as three.Material, planes);
    for (const material of [this.cloth.material, ...this.threads.materials]) this.clip(material, planes);
    this.invalidate();
  }

  /** Moves the parts apart: 0 as they are. */
  explode(factor: number): void {
    this.exploded = factor;
    for (const shown of this.parts) this.arrange(shown);
    this.invalidate();
  }

  /** Marks a part; "": none. */
  choose(name: string): void {
    this.chosen = name;
    for (const shown of this.parts) this.paint(shown);
    this.invalidate();
  }

  /** Brings a part into the middle of the picture. */
  lookAt(name: string): void {
    const shown = this.parts.find((one) => one.part.name === name);
    if (shown === undefined) return;
    const box = this.boxOfPart(shown, this.selectBox);
    const target = box.getCenter(new three.Vector3());
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const far = fittingDistance(
      { low: box.min.toArray(), high: box.max.toArray() },
      ANGLE_OF_VIEW * RADIANS,
      this.camera.aspect,
    );
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction, Math.max(1.6 * far, 0.08));
    this.controls.update();
    this.invalidate();
  }

  /** The part under a point of the picture, from -1 to 1. */
  pick(x: number, y: number): Pick | null {
    const ray = new three.Raycaster();
    ray.setFromCamera(new three.Vector2(x, y), this.camera);
    const meshes = this.parts.filter((one) => one.mesh.visible).map((one) => one.mesh);
    for (const hit of ray.intersectObjects(meshes, false)) {
      const cut = (hit.object as three.Mesh).material as three.Material;
      if ((cut.clippingPlanes ?? []).some((plane) => plane.distanceToPoint(hit.point) < 0)) continue;
      return { name: hit.object.name, point: hit.point };
    }
    return null;
  }

  /** Positions in the picture, from -1 to 1, of the middles of parts; those behind the camera are left out. */
  labels(names: readonly string[]): { name: string; x: number; y: number }[] {
    const found = [];
    for (const name of names) {
      const shown = this.parts.find((one) => one.part.name === name);
      if (shown === undefined) continue;
      const middle = this.boxOfPart(shown, this.selectBox).getCenter(new three.Vector3());
      const cut = (shown.mesh.material as three.Material).clippingPlanes ?? [];
      if (cut.some((plane) => plane.distanceToPoint(middle) < 0)) continue;
      const at = middle.project(this.camera);
      if (at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1) found.push({ name, x: at.x, y: at.y });
    }
    return found;
  }

  private addPart(part: ScenePart): void {
    const placed = this.frames.byName.get(part.frame);
    if (placed === undefined) return;
    const levels = part.solids.map((solid) => {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", new three.BufferAttribute(this.model.floats(solid.points), 3));
      geometry.setIndex(new three.BufferAttribute(this.model.integers(solid.triangles), 1));
      geometry.computeBoundingSphere();
      geometry.computeBoundingBox();
      return geometry;
    });
    const material = new three.MeshLambertMaterial({ flatShading: true });
    if (part.envelope) Object.assign(material, { transparent: true, opacity: 0.3, depthWrite: false });
    const mesh = new three.InstancedMesh(levels[levels.length - 1], material, placed.count);
    mesh.name = part.name;
    mesh.frustumCulled = false;
    const spacing = spacingOf(placed.matrices, placed.count);
    this.parts.push({ part, placed, mesh, levels, apart: new three.Vector3(), all: placed.matrices.slice(), spacing });
    this.scene.add(mesh);
  }

  /** All parts where their frames are. */
  private place(): void {
    this.frames.update(this.angles);
    for (const shown of this.parts) this.arrange(shown);
  }

  /** Writes where the copies of a part are; of a crowd that is chosen for each picture. */
  private arrange(shown: Shown): void {
    const crowd = shown.placed.count > CROWD;
    const target = crowd ? shown.all : (shown.mesh.instanceMatrix.array as Float32Array);
    target.set(shown.placed.matrices);
    if (this.exploded > 0) {
      const { x, y, z } = shown.apart;
      for (let k = 0; k < shown.placed.count; k++) {
        target[16 * k + 12] = (target[16 * k + 12] ?? 0) + this.exploded * x;
        target[16 * k + 13] = (target[16 * k + 13] ?? 0) + this.exploded * y;
        target[16 * k + 14] = (target[16 * k + 14] ?? 0) + this.exploded * z;
      }
    }
    shown.mesh.instanceMatrix.needsUpdate = true;
    shown.mesh.boundingSphere = null;
  }

  /** The loom's box, and where each part goes when it is exploded: away from the middle, machines apart. */
  private measure(): void {
    for (const shown of this.parts) if (!shown.part.envelope) this.box.union(this.boxOfPart(shown, this.selectBox));
    const middle = this.box.getCenter(new three.Vector3());
    for (const shown of this.parts) {
      const at = this.boxOfPart(shown, this.selectBox).getCenter(new three.Vector3());
      shown.apart.copy(at).sub(middle).multiplyScalar(1.2);
      if (shown.part.machine === "weaver") shown.apart.z += 0.35;
      if (shown.part.machine === "shedding") shown.apart.z -= 0.3;
    }
  }

  private boxOfPart(shown: Shown, box: three.Box3): three.Box3 {
    box.makeEmpty();
    const [matrix, own] = [new three.Matrix4(), new three.Box3()];
    const steps = Math.max(1, Math.floor(shown.placed.count / 8));
    for (
      let k = 0;
      k < shown.placed.count;
      k = k + 1 === shown.placed.count ? k + 1 : Math.min(k + steps, shown.placed.count - 1)
    ) {
      matrix.fromArray(shown.placed.count > CROWD ? shown.all : shown.mesh.instanceMatrix.array, 16 * k);
      const bounds = shown.levels[0]?.boundingBox;
      if (bounds) box.union(own.copy(bounds).applyMatrix4(matrix));
    }
    return box;
  }

  private boxOf(name: ViewName): three.Box3 {
    const half = this.model.about.carpet.width / 2;
    if (name === "fell")
      return new three.Box3(new three.Vector3(-half, -0.1, -0.1), new three.Vector3(half, 0.35, 0.2));
    const at = name === "head" ? this.headAt(this.followed ?? 0) : null;
    if (at === null) return this.box;
    return new three.Box3(new three.Vector3(-0.06, -0.03, -0.02).add(at), new three.Vector3(0.06, 0.11, 0.13).add(at));
  }

  private headAt(number: number): three.Vector3 | null {
    const heads = this.frames.byName.get(this.model.about.heads);
    if (heads === undefined || number >= heads.count) return null;
    return new three.Vector3().fromArray(heads.matrices, 16 * number + 12);
  }

  private follow(): void {
    const at = this.followed === null ? null : this.headAt(this.followed);
    if (at === null) return;
    const by = at.clone().sub(this.followedAt);
    this.followedAt.copy(at);
    this.controls.target.add(by);
    this.camera.position.add(by);
  }

  /** Of each part the coarsest solid whose deviation is less than a pixel where the camera looks; of crowds, the copies. */
  private chooseDetail(): void {
    const far = this.camera.position.distanceTo(this.controls.target);
    const pixel = (2 * far * Math.tan((ANGLE_OF_VIEW * RADIANS) / 2)) / Math.max(this.canvas.height, 1);
    this.camera.updateMatrixWorld();
    this.product.multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    this.frustum.setFromProjectionMatrix(this.product);
    for (const shown of this.parts) {
      const { part, mesh, levels } = shown;
      const level =
        levels[
          levelFor(
            part.solids.map((solid) => solid.deviation),
            COARSE * pixel,
          )
        ];
      if (level !== undefined && mesh.geometry !== level) mesh.geometry = level;
      if (shown.placed.count > CROWD) this.gather(shown, pixel);
    }
  }

  private gather(shown: Shown, pixel: number): void {
    const stride = strideFor(shown.spacing, pixel);
    this.sphere.radius = (shown.levels[0]?.boundingSphere?.radius ?? 1) + stride * shown.spacing;
    const center = shown.levels[0]?.boundingSphere?.center ?? new three.Vector3();
    this.sphere.radius += center.length();
    const into = shown.mesh.instanceMatrix.array as Float32Array;
    shown.mesh.count = thinned(shown.all, shown.placed.count, stride, into, (x, y, z) => {
      this.sphere.center.set(x, y, z);
      return this.frustum.intersectsSphere(this.sphere);
    });
    shown.mesh.instanceMatrix.needsUpdate = true;
    shown.mesh.boundingSphere = null;
  }

  private paint(shown: Shown): void {
    const material = shown.mesh.material as three.MeshLambertMaterial;
    const chosen = shown.part.name === this.chosen;
    material.color.set(chosen ? this.look.chosen : colourOf(shown.part, this.look));
    if (shown.part.envelope) material.opacity = chosen ? 0.55 : 0.25;
  }

  private clip(material: three.Material, planes: three.Plane[]): void {
    const before = material.clippingPlanes?.length ?? 0;
    material.clippingPlanes = planes;
    material.side = planes.length > 0 ? three.DoubleSide : three.FrontSide;
    if (before !== planes.length) material.needsUpdate = true;
  }
}
