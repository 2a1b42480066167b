/** The loom drawn by three.js: parts, warps, yarns and carpet; drawn only when something has changed. */
import * as three from "three";
import { Camera } from "./camera";
import { Cloth } from "./cloth-mesh";
import { Light } from "./light";
import { type Look, look } from "./look";
import { type Angles, Frames } from "./motion";
import { Pace } from "./pace";
import { PartMesh } from "./part-mesh";
import type { Drive, SceneModel } from "./scene";
import { floorGrid, graphics } from "./surroundings";
import { Threads } from "./threads";
import { DIRECTIONS, type ViewName } from "./views";

/** What an exploded machine is moved to the front beside, for the factor 1 [m]. */
const FORWARD: Record<string, number> = { weaver: 0.35, shedding: -0.3 };

/** Time without a change after which a coarse picture is drawn finely [ms]. */
const REST = 200;

/** Copies of a part that are drawn at most while pictures are coarse. */
const FEW = 40;

export type SectionAxis = "x" | "y" | "z";

export class Stage {
  /** Called after each picture. */
  drawn: () => void = () => {};

  private readonly scene = new three.Scene();
  private readonly camera: Camera;
  private readonly renderer: three.WebGLRenderer;
  private readonly light = new Light();
  private readonly pace = new Pace();
  private readonly frames: Frames;
  private readonly parts: PartMesh[] = [];
  private readonly cloth: Cloth;
  private readonly threads: Threads;
  private readonly plane = new three.Plane(new three.Vector3(-1, 0, 0), 0);
  private readonly box = new three.Box3();
  private look: Look = look(null);
  private waiting = 0;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private size: [width: number, height: number] = [1, 1];
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
      antialias: graphics() === "card", // smooth edges take most of a processor's time
      powerPreference: "high-performance",
    });
    this.renderer.localClippingEnabled = true;
    this.frames = new Frames(model);
    this.frames.update(this.angles);
    for (const part of model.about.parts) {
      const placed = this.frames.byName.get(part.frame);
      if (placed !== undefined) this.parts.push(new PartMesh(part, placed, model, this.light));
    }
    this.cloth = new Cloth(model, this.light);
    this.threads = new Threads(model, this.frames);
    this.scene.add(...this.parts.map((one) => one.mesh), this.cloth.mesh, this.threads.group);
    this.scene.add(floorGrid(model.about.floor));
    for (const one of this.parts) one.arrange(0);
    this.measure();
    this.camera = new Camera(canvas, this.invalidate);
    canvas.addEventListener("webglcontextrestored", this.invalidate);
  }

  /** Frees everything of the graphics processor. */
  dispose(): void {
    cancelAnimationFrame(this.waiting);
    clearTimeout(this.resting);
    this.canvas.removeEventListener("webglcontextrestored", this.invalidate);
    this.camera.dispose();
    this.scene.traverse((one) => {
      const { geometry, material } = one as Partial<three.Mesh>;
      geometry?.dispose();
      for (const own of [material ?? []].flat()) own.dispose();
    });
    for (const one of this.parts) one.dispose();
    this.cloth.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  /** Draws a picture as soon as the browser is ready, once for all changes. */
  readonly invalidate = (): void => {
    if (this.waiting !== 0) return;
    this.pace.wanted(performance.now());
    this.waiting = requestAnimationFrame(this.draw);
  };

  private readonly draw = (): void => {
    this.waiting = 0;
    const share = this.pace.drawn(performance.now());
    this.sharpen(share);
    const pixel = Camera.pixelAtOne(this.canvas.height) * this.camera.distance;
    const view = this.camera.view();
    const right = this.camera.lens.position.x > 0;
    for (const one of this.parts) one.detail(pixel, view, right, share < 1 ? FEW : Number.POSITIVE_INFINITY);
    this.light.update(this.camera.lens);
    this.renderer.render(this.scene, this.camera.lens);
    this.pictures += 1;
    this.canvas.dataset["pictures"] = String(this.pictures);
    this.drawn();
  };

  /** Fits the picture to the size of the canvas [px]. */
  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.size = [width, height];
    this.camera.setAspect(width / height);
    this.invalidate();
  }

  /** Draws with a share of the screen's pixels; where that is less than all, with all of them when nothing moves. */
  private sharpen(share: number): void {
    clearTimeout(this.resting);
    if (share < 1) this.resting = setTimeout(this.invalidate, REST);
    const ratio = share * Math.min(devicePixelRatio, 2);
    const [width, height] = this.size.map((one) => Math.floor(one * ratio)) as [number, number];
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(...this.size, false);
    this.threads.setPixel(Camera.pixelAtOne(height));
  }

  setTheme(theme: string | null): void {
    this.look = look(theme);
    this.scene.background = new three.Color(this.look.ground);
    this.threads.paint(this.look);
    this.choose(this.chosen);
  }

  /** Turns row and knot to angles [rad]. */
  turn(angles: Angles): void {
    const changed = (["row", "knot"] as Drive[]).filter((drive) => angles[drive] !== this.angles[drive]);
    this.angles = { ...angles };
    for (const drive of changed) this.frames.update(angles, drive);
    for (const one of this.parts) if (changed.some((drive) => one.placed.moves[drive])) one.arrange(this.exploded);
    this.threads.update(angles);
    this.follow();
    this.invalidate();
  }

  /** Puts the heads at positions across [m]. */
  putHeads(x: readonly number[]): void {
    const heads = this.frames.byName.get(this.model.about.heads);
    if (heads === undefined) return;
    x.slice(0, heads.origins.length / 3).forEach((value, index) => {
      heads.origins[3 * index] = value;
    });
    this.frames.update(this.angles);
    for (const one of this.parts) one.arrange(this.exploded);
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
    this.camera.look(this.boxOf(name), DIRECTIONS[name]);
    this.invalidate();
  }

  /** Moves the camera as a key says; whether it does anything. */
  key(key: string, shift: boolean): boolean {
    if (!this.camera.key(key, shift)) return false;
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
  section(axis: SectionAxis | null, share: number): void {
    const planes = axis === null ? [] : [this.plane];
    if (axis !== null) {
      this.plane.normal.set(axis === "x" ? -1 : 0, axis === "y" ? -1 : 0, axis === "z" ? -1 : 0);
      this.plane.constant = this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
    }
    for (const { mesh } of this.parts) {
      mesh.material.clippingPlanes = planes;
      mesh.material.side = planes.length > 0 ? three.DoubleSide : three.FrontSide;
    }
    for (const material of [this.cloth.material, ...this.threads.materials]) material.clippingPlanes = planes;
    this.invalidate();
  }

  /** Moves the parts apart: 0 as they are. */
  explode(factor: number): void {
    this.exploded = factor;
    for (const one of this.parts) one.arrange(factor);
    this.invalidate();
  }

  /** Marks a part; "": none. */
  choose(name: string): void {
    this.chosen = name;
    for (const one of this.parts) one.paint(this.look, one.part.name === name);
    this.invalidate();
  }

  /** Brings a part into the middle of the picture. */
  lookAt(name: string): void {
    const found = this.parts.find((one) => one.part.name === name);
    if (found === undefined) return;
    this.camera.look(found.boxed(new three.Box3()), undefined, 1.6);
    this.invalidate();
  }

  /** The name of the part under a point of the picture, from -1 to 1; "": none. */
  pick(x: number, y: number): string {
    const ray = new three.Raycaster();
    ray.setFromCamera(new three.Vector2(x, y), this.camera.lens);
    const hits = ray.intersectObjects(
      this.parts.map((one) => one.mesh),
      false,
    );
    return hits.find((hit) => !this.isCut(hit.point))?.object.name ?? "";
  }

  /** Positions in the picture, from -1 to 1, of parts; those behind the camera are left out. */
  labels(): { name: string; x: number; y: number }[] {
    return this.parts.flatMap((one) => {
      const at = one.shownAt();
      if (this.isCut(at)) return [];
      at.project(this.camera.lens);
      const seen = at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
      return seen ? [{ name: one.part.name, x: at.x, y: at.y }] : [];
    });
  }

  private isCut(point: three.Vector3): boolean {
    return (this.cloth.material.clippingPlanes ?? []).some((plane) => plane.distanceToPoint(point) < 0);
  }

  /** The loom's box, and where each part goes when it is exploded: away from the middle, machines apart. */
  private measure(): void {
    const own = new three.Box3();
    for (const one of this.parts) if (!one.part.envelope) this.box.union(one.boxed(own));
    const middle = this.box.getCenter(new three.Vector3());
    for (const one of this.parts) {
      one.boxed(own).getCenter(one.apart).sub(middle).multiplyScalar(1.2);
      one.apart.z += FORWARD[one.part.machine] ?? 0;
    }
  }

  private boxOf(name: ViewName): three.Box3 {
    const { carpet, warps } = this.model.about;
    const [half, lifted] = [carpet.width / 2, this.model.floats(warps.line)[2 * (warps.lifted[0] ?? 0) + 1] ?? 0.2];
    const box = (low: [number, number, number], high: [number, number, number]) =>
      new three.Box3(new three.Vector3(...low), new three.Vector3(...high));
    if (name === "fell") return box([-half, -0.1, -0.1], [half, 0.35, 0.2]);
    if (name === "shed") return box([half - 0.05, 0, -0.05], [half, lifted, 0.1]);
    const at = name === "head" ? this.headAt(this.followed ?? 0) : null;
    return at === null ? this.box : box([-0.035, -0.02, -0.01], [0.035, 0.06, 0.07]).translate(at);
  }

  private headAt(number: number): three.Vector3 | null {
    const heads = this.frames.byName.get(this.model.about.heads);
    if (heads === undefined || number >= heads.count) return null;
    return new three.Vector3().fromArray(heads.matrices, 16 * number + 12);
  }

  private follow(): void {
    const at = this.followed === null ? null : this.headAt(this.followed);
    if (at === null) return;
    this.camera.shift(at.clone().sub(this.followedAt));
    this.followedAt.copy(at);
  }
}
