/** The loom drawn by three.js: parts, warps, yarns and carpet; drawn only when something has changed. */
import * as three from "three";
import { Camera } from "./camera";
import { Cloth } from "./cloth-mesh";
import { Light, screenColour } from "./light";
import { type Look, look } from "./look";
import { Measure, snapped } from "./measure";
import { type Angles, Frames, openShed, type Placed } from "./motion";
import { Pace } from "./pace";
import { PartMesh } from "./part-mesh";
import { drivesOf, type SceneModel } from "./scene";
import { Shadow } from "./shadow";
import { Smooth } from "./smooth";
import { floor, graphics } from "./surroundings";
import { Threads } from "./threads";
import { DIRECTIONS, SHED_CUT, type ViewName } from "./views";

/** What an exploded machine is moved to the front beside, for the factor 1 [m]. */
const FORWARD: Record<string, number> = { weaver: 0.35, shedding: -0.3 };

/** Time without a change after which a picture is drawn with edges, shadows and all pixels by a processor [ms]. */
const REST = 200;

/** What is shown around the point at which two parts come nearest [m]. */
const AROUND = 0.03;

/** Copies of a part that are drawn at most while pictures are coarse. */
const FEW = 40;

/** How much is seen of parts beside those that are chosen; behind a knot; and of the tool that stands around it. */
const OTHERS = 0.1;
const BEHIND_KNOT = 0.15;
const AROUND_KNOT = 0.55;

/** Where a knot is tied in a head whose yarn is not known [m]. */
const TIED: [low: [number, number, number], high: [number, number, number]] = [
  [-0.06, 0, -0.03],
  [0.06, 0.08, 0.12],
];

/** What a standard view leaves free around what it shows. */
const ROOM = 1.06;

/** A text in the picture, from -1 to 1. */
export interface Label {
  text: string;
  x: number;
  y: number;
}

export type SectionAxis = "x" | "y" | "z";

export class Stage {
  /** Called after each picture. */
  drawn: () => void = () => {};

  /** Whether it looks through the case of a head, at the tools that tie. */
  get looksInside(): boolean {
    return this.opened;
  }

  /** Whether a press measures, rather than chooses. */
  measures = false;

  private readonly scene = new three.Scene();
  private readonly camera: Camera;
  private readonly renderer: three.WebGLRenderer;
  private readonly light = new Light();
  private readonly floor: ReturnType<typeof floor>;
  private readonly shadow = new Shadow();
  private readonly smooth = graphics() === "card" ? null : new Smooth();
  private readonly measured = new Measure();
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
  private rests = false;
  private opened = false;
  private guarded = false;
  private size: [width: number, height: number] = [1, 1];
  private pictures = 0;
  private angles: Angles = {};
  private followed: number | null = null;
  private followedAt = new three.Vector3();
  private exploded = 0;
  private cuts: three.Plane[] = [];
  private chosen: readonly string[] = [];
  private alone = false;

  constructor(
    readonly model: SceneModel,
    private readonly canvas: HTMLCanvasElement,
  ) {
    this.renderer = new three.WebGLRenderer({
      canvas,
      antialias: graphics() === "card", // smooth edges take most of a processor's time: it smooths when nothing moves
      powerPreference: "high-performance",
    });
    this.renderer.outputColorSpace = three.LinearSRGBColorSpace; // colours are those of the screen, see `light`
    this.renderer.localClippingEnabled = true;
    this.frames = new Frames(model);
    this.frames.update(this.angles);
    for (const part of model.about.parts) {
      const placed = this.frames.byName.get(part.frame);
      if (placed !== undefined) this.parts.push(new PartMesh(part, placed, model, this.light));
    }
    this.cloth = new Cloth(model, this.light);
    this.threads = new Threads(model, this.frames);
    this.floor = floor(model.about.floor, this.light);
    this.scene.add(...this.parts.map((one) => one.mesh), this.cloth.mesh, this.threads.group);
    this.scene.add(this.floor, ...this.parts.map((one) => one.edges.lines), this.measured.line);
    for (const one of this.parts) one.arrange(0);
    this.measure();
    this.shadow.fit(this.box);
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
    this.shadow.dispose();
    this.smooth?.dispose();
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
    const fine = this.rests || this.smooth === null;
    this.rests = false;
    this.sharpen(fine ? 1 : share, fine);
    const pixel = Camera.pixelAtOne(this.canvas.height) * this.camera.distance;
    const view = this.camera.view();
    const right = this.camera.lens.position.x > 0;
    const most = share < 1 && !fine ? FEW : Number.POSITIVE_INFINITY;
    for (const one of this.parts) one.detail(pixel, view, right, most, fine);
    this.threads.setPixel(Camera.pixelAtOne(this.canvas.height), fine);
    this.threads.dye(this.cloth.colourAt(this.headAt(this.followed ?? 0)?.x ?? 0));
    if (fine) this.shadow.throw(this.renderer, this.scene, this.shadowless(), this.cuts);
    this.light.update(this.camera.lens, this.plane, pixel);
    this.shadow.light(this.light, this.camera.lens, fine);
    if (fine && this.smooth !== null) this.smooth.render(this.renderer, this.scene, this.camera.lens);
    else this.renderer.render(this.scene, this.camera.lens);
    this.pictures += 1;
    this.canvas.dataset["pictures"] = String(this.pictures);
    this.canvas.dataset["fine"] = String(fine);
    this.drawn();
  };

  /** What throws no shadow. */
  private shadowless(): three.Object3D[] {
    const lines = this.parts.map((one) => one.edges.lines);
    const clear = this.parts.filter((one) => !one.solid || one.hidden).map((one) => one.mesh);
    return [this.floor, this.threads.group, this.measured.line, ...lines, ...clear];
  }

  /** Fits the picture to the size of the canvas [px]. */
  resize(width: number, height: number): void {
    if (width < 1 || height < 1) return;
    this.size = [width, height];
    this.camera.setAspect(width / height);
    this.invalidate();
  }

  /** Draws with a share of the screen's pixels; what is not fine is drawn finely when nothing moves. */
  private sharpen(share: number, fine: boolean): void {
    clearTimeout(this.resting);
    if (!fine) this.resting = setTimeout(this.rest, REST);
    const ratio = share * Math.min(devicePixelRatio, 2);
    const [width, height] = this.size.map((one) => Math.floor(one * ratio)) as [number, number];
    if (this.canvas.width === width && this.canvas.height === height) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(...this.size, false);
  }

  private readonly rest = (): void => {
    this.rests = true;
    this.invalidate();
  };

  setTheme(theme: string | null): void {
    this.look = look(theme);
    const ground = new three.Color();
    screenColour(this.look.ground, ground);
    this.scene.background = ground;
    const { uniforms } = this.floor.material;
    screenColour(this.look.ground, uniforms["ground"]?.value);
    screenColour(this.look.line, uniforms["line"]?.value);
    this.threads.paint(this.look);
    this.choose(this.chosen, this.alone);
  }

  /** Turns all drives to angles. */
  turn(angles: Angles): void {
    const changed = drivesOf(this.model.about).filter((drive) => (angles[drive] ?? 0) !== (this.angles[drive] ?? 0));
    this.angles = { ...angles };
    for (const drive of changed) this.frames.update(angles, drive);
    for (const one of this.parts) if (changed.some((drive) => one.placed.drives.has(drive))) one.arrange(this.exploded);
    this.threads.update(angles);
    this.follow();
    this.changed();
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
    this.changed();
  }

  /** Rows that are woven; a part of one too. */
  weave(rows: number): void {
    this.cloth.weave(rows);
    this.changed();
  }

  /** Something has moved: shadows too. */
  private changed(): void {
    this.shadow.stale = true;
    this.invalidate();
  }

  /** A standard view; that of a head looks through its case. */
  show(name: ViewName): void {
    this.opened = name === "head";
    this.choose(this.chosen, this.alone);
    this.hide();
    const box = this.boxOf(name);
    this.camera.look(box === this.box ? this.boxes() : [box], DIRECTIONS[name], ROOM);
    if (this.opened) this.shadow.fit(box.clone().expandByVector(box.getSize(new three.Vector3())));
    else this.shadow.fit(this.box);
    this.threads.mark(this.opened ? this.headAt(this.followed ?? 0) : null);
    this.invalidate();
  }

  /** Shows the guards with room for them in the picture, or leaves them out. */
  guard(shown: boolean): void {
    const fits = this.guarded || !shown;
    this.guarded = shown;
    this.hide();
    if (!fits) this.camera.look(this.boxes(), undefined, ROOM);
  }

  /** Leaves out the guards, and the case of a head whose tools are looked at. */
  private hide(): void {
    const heads = this.frames.byName.get(this.model.about.heads) ?? null;
    for (const one of this.parts) {
      const isCase = isOf(one.placed, heads) && one.tool === undefined;
      one.hidden = (this.isGuard(one) && !this.guarded) || (isCase && this.opened);
    }
    this.changed();
  }

  private isGuard({ placed }: PartMesh): boolean {
    return this.model.about.guards.some((name) => isOf(placed, this.frames.byName.get(name) ?? null));
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
    if (axis !== null) {
      this.plane.normal.set(axis === "x" ? -1 : 0, axis === "y" ? -1 : 0, axis === "z" ? -1 : 0);
      this.plane.constant = this.box.min[axis] + share * (this.box.max[axis] - this.box.min[axis]);
    }
    this.cuts = axis === null ? [] : [this.plane];
    for (const { mesh, edges } of this.parts) {
      mesh.material.clippingPlanes = this.cuts;
      mesh.material.side = axis === null ? three.FrontSide : three.DoubleSide;
      edges.lines.material.clippingPlanes = this.cuts;
    }
    for (const material of [this.cloth.material, ...this.threads.materials]) material.clippingPlanes = this.cuts;
    this.changed();
  }

  /** Where the view of the shed cuts, as a share of the loom across. */
  get shedCut(): number {
    return (SHED_CUT * this.model.about.carpet.width - this.box.min.x) / (this.box.max.x - this.box.min.x);
  }

  /** Moves the parts apart, and the camera away from them: 0 as they are. */
  explode(factor: number): void {
    if (factor === this.exploded) return;
    this.exploded = factor;
    for (const one of this.parts) one.arrange(factor);
    this.camera.look(this.boxes(), undefined, ROOM);
    this.changed();
  }

  /** Marks the first of some parts; alone: all others are looked through, and the cloth is left out. */
  choose(names: readonly string[], alone = false): void {
    this.chosen = names;
    this.alone = alone;
    this.cloth.mesh.visible = this.threads.group.visible = !alone;
    for (const one of this.parts) {
      const { name } = one.part;
      const inHead = one.tool === undefined ? BEHIND_KNOT : one.tool.number === 0 ? AROUND_KNOT : 1;
      const share = alone && !names.includes(name) ? OTHERS : this.opened ? inHead : 1;
      one.paint(this.look, name === names[0], share);
    }
    this.changed();
  }

  /** Brings parts into the middle of the picture: of several what is between them, or what they share. */
  lookAt(...names: string[]): void {
    const boxes = this.parts.filter((one) => names.includes(one.part.name)).map((one) => one.boxed(new three.Box3()));
    const [first, ...others] = boxes;
    if (first === undefined) return;
    for (const box of others) meeting(first, box);
    first.expandByScalar(AROUND);
    this.camera.look([first], undefined, 1.3);
    this.invalidate();
  }

  /** Puts the heads beside the middles of their shares of the row [m]. */
  shiftHeads(shift: number): void {
    const { about } = this.model;
    const heads = about.frames.find((one) => one.name === about.heads);
    if (heads === undefined) return;
    const origins = this.model.floats(heads.origins);
    this.putHeads([...origins].filter((_, k) => k % 3 === 0).map((x) => x + shift));
  }

  /** The name of the part under a point of the picture, from -1 to 1; "": none. */
  pick(x: number, y: number): string {
    return this.hit(x, y)?.object.name ?? "";
  }

  /** Measures from or to the point of a part under a point of the picture, or its corner that is near. */
  mark(x: number, y: number): void {
    const hit = this.hit(x, y);
    if (hit?.face == null) return;
    const mesh = hit.object as three.InstancedMesh;
    const copy = new three.Matrix4();
    mesh.getMatrixAt(hit.instanceId ?? 0, copy);
    const position = mesh.geometry.getAttribute("position") as three.BufferAttribute;
    const corners = [hit.face.a, hit.face.b, hit.face.c].map((k) =>
      new three.Vector3().fromBufferAttribute(position, k).applyMatrix4(copy),
    );
    this.measured.take(snapped(hit.point, corners, Camera.pixelAtOne(this.canvas.height) * hit.distance));
    this.invalidate();
  }

  /** Measures, or chooses, by a press from now on. */
  measureByPress(on: boolean): void {
    this.measures = on;
    if (!on) this.measured.clear();
    this.invalidate();
  }

  /** What is measured, and where it is written, from -1 to 1. */
  distance(): Label | null {
    const label = this.measured.label();
    if (label === null) return null;
    label.at.project(this.camera.lens);
    return { text: label.text, x: label.at.x, y: label.at.y };
  }

  private hit(x: number, y: number): three.Intersection | undefined {
    const ray = new three.Raycaster();
    ray.setFromCamera(new three.Vector2(x, y), this.camera.lens);
    const hits = ray.intersectObjects(
      this.parts.filter((one) => !one.hidden && (one.solid || !this.opened)).map((one) => one.mesh),
      false,
    );
    return hits.find((one) => !this.isCut(one.point));
  }

  /** Names of parts with their positions in the picture, the heaviest first; in a head those of its tools. */
  labels(): Label[] {
    if (this.opened) return this.toolLabels();
    const parts = this.parts.filter((one) => !one.hidden).sort((a, b) => b.weight - a.weight);
    return parts.flatMap((one) => {
      const warning = one.failed ? "⚠ " : "";
      return this.labelAt(one.shownAt(), warning + (one.part.title.split(/[:,]/)[0] ?? ""));
    });
  }

  /** The tools of the head that is shown, each at that of its parts which is farthest behind: its tip. */
  private toolLabels(): Label[] {
    const tips = new Map<string, { z: number; label: Label }>();
    const heads = this.frames.byName.get(this.model.about.heads)?.count ?? 1;
    for (const one of this.parts) {
      const { tool, placed } = one;
      if (tool === undefined) continue;
      const copy = Math.floor(((this.followed ?? 0) * placed.count) / heads);
      const at = one.shownAt(copy);
      const { z } = at;
      for (const label of this.labelAt(at, tool.name))
        if (z < (tips.get(tool.name)?.z ?? Number.POSITIVE_INFINITY)) tips.set(tool.name, { z, label });
    }
    return [...tips.values()].map((one) => one.label);
  }

  /** A text at a point in space; none where it is not seen. */
  private labelAt(at: three.Vector3, text: string): Label[] {
    if (this.isCut(at)) return [];
    at.project(this.camera.lens);
    return at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1 ? [{ text, x: at.x, y: at.y }] : [];
  }

  private isCut(point: three.Vector3): boolean {
    return this.cuts.some((plane) => plane.distanceToPoint(point) < 0);
  }

  /** The loom's box, and where each part goes when it is exploded: away from the middle, machines apart. */
  private measure(): void {
    const own = new three.Box3();
    for (const one of this.boxes()) this.box.union(one);
    const middle = this.box.getCenter(new three.Vector3());
    for (const one of this.parts) {
      one.boxed(own).getCenter(one.apart).sub(middle).multiplyScalar(1.2);
      one.apart.z += FORWARD[one.part.machine] ?? 0;
    }
  }

  /** The boxes of all parts; of the guards where they are shown. */
  private boxes(): three.Box3[] {
    return this.parts.filter((one) => this.guarded || !this.isGuard(one)).map((one) => one.boxed(new three.Box3()));
  }

  private boxOf(name: ViewName): three.Box3 {
    const { carpet } = this.model.about;
    const [half, lifted] = [carpet.width / 2, openShed(this.model).height];
    const box = (low: [number, number, number], high: [number, number, number]) =>
      new three.Box3(new three.Vector3(...low), new three.Vector3(...high));
    if (name === "fell") return box([-half, -0.1, -0.1], [half, 0.35, 0.2]);
    const cut = SHED_CUT * carpet.width;
    if (name === "shed") return box([cut - 0.1, -0.12, -0.1], [cut, lifted + 0.12, 0.15]);
    const at = name === "head" ? this.headAt(this.followed ?? 0) : null;
    if (at === null) return this.box;
    const knot = this.threads.knot();
    return (knot.isEmpty() ? box(...TIED) : knot).translate(at);
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
    if (this.opened) this.threads.mark(at);
  }
}

/** What two boxes share, or what lies between them. */
function meeting(first: three.Box3, other: three.Box3): void {
  for (const axis of ["x", "y", "z"] as const) {
    const low = Math.max(first.min[axis], other.min[axis]);
    const high = Math.min(first.max[axis], other.max[axis]);
    [first.min[axis], first.max[axis]] = [Math.min(low, high), Math.max(low, high)];
  }
}

/** Whether a frame is another, or stands on it. */
function isOf(placed: Placed, other: Placed | null): boolean {
  return placed === other || (placed.parent !== null && isOf(placed.parent, other));
}
