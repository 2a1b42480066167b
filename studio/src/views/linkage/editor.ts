/** The state of the linkage editor: the document, what the server computed of it, tool, selection, drive, drag. */
import { computed, effect, signal } from "@preact/signals";
import { latest } from "../../api/latest";
import type { LinkageFault, MechanismAnswer, QualityAnswer } from "../../api/messages";
import { ApiError, post, ServerLost } from "../../api/request";
import type { Document } from "../../project";
import { type Figure, figureAt, range, type Shift, valueNear, wrapped } from "./figure";
import { type Camera, type Pose, STILL, toLocal, type Vec, vec } from "./geometry";
import { apply, GROUND, type MechanismData, setPoint } from "./mechanism";
import { connected, shiftBodies } from "./moving";

export const TOOLS = [
  "select",
  "link",
  "body",
  "pin",
  "pivot",
  "slide",
  "gears",
  "drive",
  "point",
  "force",
  "mass",
] as const;
export type Tool = (typeof TOOLS)[number];

/** What is chosen: bodies, joints, and points "body.point". */
export interface Selection {
  readonly bodies: readonly string[];
  readonly joints: readonly string[];
  readonly points: readonly string[];
}

export const NOTHING: Selection = { bodies: [], joints: [], points: [] };

/** How the mechanism is moved, as texts with units. */
export interface Drive {
  readonly fixed: Readonly<Record<string, string>>;
  readonly over: string;
  readonly speed: string;
}

export interface Shown {
  readonly paths: boolean;
  readonly names: boolean;
  readonly velocities: boolean;
  readonly accelerations: boolean;
  readonly forces: boolean;
  readonly grid: boolean;
}

interface Request {
  mechanism: MechanismData;
  fixed: Readonly<Record<string, string>>;
  over: string;
  speed: string;
  steps: number;
  poses: Record<string, [number, number, number]>;
  drag?: { joint: string; x: number; y: number };
  rates: boolean;
  forces: boolean;
}

interface Dragging {
  readonly joint: string;
  readonly base: MechanismData;
  readonly poses: Record<string, [number, number, number]>;
  last: Vec;
  ended: boolean;
}

/** Name of the browser's measures of a drag. */
const MEASURE = "linkage-drag";

const STEPS = 360;

/** Pause after which circuits and checks are computed [ms]. */
const QUALITY_PAUSE = 300;

export class Editor {
  readonly tool = signal<Tool>("select");
  readonly selection = signal<Selection>(NOTHING);
  readonly answer = signal<MechanismAnswer | null>(null);
  readonly quality = signal<QualityAnswer | null>(null);
  readonly refused = signal<LinkageFault | null>(null);
  readonly value = signal(0);
  readonly isPlaying = signal(false);
  readonly camera = signal<Camera>({ centre: vec(0, 0), scale: 1500 });
  readonly drive = signal<Drive>({ fixed: {}, over: "", speed: "" });
  readonly shown = signal<Shown>({
    paths: true,
    names: true,
    velocities: false,
    accelerations: false,
    forces: false,
    grid: true,
  });
  /** Time from the pointer's event to the painted drawing, of the newest state of a drag [ms]. */
  readonly roundTrip = signal(0);
  readonly isDragging = signal(false);
  /** Bodies that are being moved as a whole. */
  readonly shift = signal<Shift | null>(null);
  readonly figure = computed<Figure | null>(() => {
    const answer = this.answer.value;
    return answer === null ? null : figureAt(answer, this.value.value, this.#poses, this.shift.value);
  });

  #poses: Readonly<Record<string, Pose>> = {};
  #dragging: Dragging | null = null;
  #changes: readonly { path: readonly string[]; value?: unknown }[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;
  #judging: AbortController | undefined;
  readonly #begun = new WeakMap<Request, number>();
  readonly #stop: () => void;
  readonly #send = latest<Request, MechanismAnswer>(
    (request, signal) => post<MechanismAnswer>("/mechanism", request, signal),
    (reply, request) => this.#take(reply, request),
    (error, request) => this.#fail(error, request),
  );

  constructor(readonly document: Document<MechanismData>) {
    this.#stop = effect(() => {
      const data = document.data.value;
      const drive = this.drive.value;
      const { velocities, accelerations, forces } = this.shown.value;
      if (data === null || this.#dragging !== null) return;
      this.#send(this.#request(data, drive, velocities || accelerations, forces));
    });
  }

  /** Ends everything that goes on. */
  dispose(): void {
    this.#stop();
    this.#send.cancel();
    this.#judging?.abort();
    clearTimeout(this.#timer);
    this.isPlaying.value = false;
  }

  /** Changes the mechanism. */
  edit(change: (data: MechanismData) => void): void {
    this.document.update((data) => {
      change(data);
      return undefined;
    });
  }

  /** The data of the file; empty before it is read. */
  get data(): MechanismData {
    return this.document.data.peek() ?? {};
  }

  select(selection: Partial<Selection>): void {
    this.selection.value = { ...NOTHING, ...selection };
  }

  /** Chooses everything that is drawn. */
  selectAll(): void {
    const { bodies, joints = {} } = this.data;
    const points = this.figure.peek()?.points.filter((point) => point.joint === undefined) ?? [];
    this.select({
      bodies: Object.keys(bodies ?? {}).filter((body) => body !== GROUND),
      joints: Object.keys(joints),
      points: points.map((point) => `${point.body}.${point.name}`),
    });
  }

  /** The bodies that move with a chosen one: all, where all are chosen; those joined to it, where none is pivoted. */
  movable(body: string): readonly string[] {
    const all = Object.keys(this.data.bodies ?? {});
    const { bodies } = this.selection.peek();
    if (all.length > 1 && all.every((one) => one === GROUND || bodies.includes(one))) return [...all];
    const { bodies: joined, grounded } = connected(this.data, body);
    return grounded ? [] : joined;
  }

  /** Moves bodies as a whole. */
  moveBodies(bodies: readonly string[], by: Vec): void {
    const figure = this.figure.peek();
    const solved = new Set(
      figure?.bodies.filter((body) => body.solved && body.name !== GROUND).map(({ name }) => name),
    );
    const own = bodies.filter((body) => !solved.has(body));
    if (figure) this.edit((data) => shiftBodies(data, own, by, figure));
  }

  /** Moves the mechanism by hand: a point of a body goes towards a position. */
  turnTowards(body: string, local: Vec, to: Vec): void {
    const motion = this.answer.peek()?.motion;
    if (motion) this.value.value = valueNear(motion, body, local, to, this.value.peek());
  }

  /** Begins to drag a joint of the file. */
  beginDrag(joint: string): void {
    this.isPlaying.value = false;
    performance.clearMeasures(MEASURE);
    this.#changes = [];
    this.#dragging = {
      joint,
      base: structuredClone(this.data),
      poses: this.#sentPoses(),
      last: vec(0, 0),
      ended: false,
    };
    this.isDragging.value = true;
  }

  /** Drags it to a position. */
  drag(to: Vec): void {
    const dragging = this.#dragging;
    if (dragging === null || dragging.ended) return;
    dragging.last = to;
    const request = this.#dragRequest(dragging);
    this.#begun.set(request, performance.now());
    this.#send(request);
  }

  /** Ends the drag: what changed goes into the document when the last answer is here. */
  endDrag(): void {
    const dragging = this.#dragging;
    if (dragging === null) return;
    dragging.ended = true;
    this.#send(this.#dragRequest(dragging));
  }

  /** Ends the drag and changes nothing. */
  cancelDrag(): void {
    if (this.#dragging === null) return;
    this.#dragging = null;
    this.isDragging.value = false;
    this.#send.cancel();
    this.resend();
  }

  /** Moves a joint at once, as the arrow keys and typed coordinates do. */
  moveJoint(joint: string, to: Vec): void {
    this.beginDrag(joint);
    if (this.#dragging) this.#dragging.last = to;
    this.endDrag();
  }

  /** Moves a point that is no joint. */
  movePoint(body: string, point: string, to: Vec): void {
    const pose = this.figure.peek()?.poses[body] ?? STILL;
    this.edit((data) => setPoint(data, body, point, toLocal(pose, to)));
  }

  /** Computes again what is shown. */
  resend(): void {
    const { velocities, accelerations, forces } = this.shown.peek();
    this.#send(this.#request(this.data, this.drive.peek(), velocities || accelerations, forces));
  }

  #request(data: MechanismData, drive: Drive, rates: boolean, forces: boolean): Request {
    return { mechanism: data, ...drive, steps: STEPS, poses: this.#sentPoses(), rates, forces };
  }

  #dragRequest(dragging: Dragging): Request {
    const { velocities, accelerations, forces } = this.shown.peek();
    const request = this.#request(dragging.base, this.drive.peek(), velocities || accelerations, forces);
    return {
      ...request,
      poses: dragging.poses,
      drag: { joint: dragging.joint, x: dragging.last.x, y: dragging.last.y },
    };
  }

  #sentPoses(): Record<string, [number, number, number]> {
    const poses = this.figure.peek()?.poses ?? {};
    const known = new Set(Object.keys(this.data.bodies ?? {}));
    return Object.fromEntries(
      Object.entries(poses)
        .filter(([body]) => body !== GROUND && known.has(body))
        .map(([body, pose]) => [body, [pose.x, pose.y, pose.angle]]),
    );
  }

  #take(reply: MechanismAnswer, request: Request): void {
    const dragging = this.#dragging;
    if (request.drag && dragging === null) return;
    this.#measure(request);
    this.refused.value = reply.refused ?? null;
    const ended = dragging?.ended && request.drag?.x === dragging.last.x && request.drag.y === dragging.last.y;
    if (request.drag && reply.refused) {
      if (ended) this.#commit();
      return;
    }
    this.#poses = this.figure.peek()?.poses ?? {};
    const motion = reply.motion;
    if (motion && request.drag) {
      const value = reply.values[motion.driving];
      if (value !== undefined) this.value.value = wrapped(motion, value);
    } else if (motion) {
      const [low, high] = range(motion);
      const now = wrapped(motion, this.value.peek());
      this.value.value = Math.min(Math.max(now, low), high);
    }
    this.answer.value = reply;
    if (request.drag) this.#changes = reply.changes;
    if (ended) this.#commit();
    else if (!request.drag && reply.changes.length > 0) this.#adopt(reply.changes);
    this.#judgeLater(request);
  }

  /** Measures a drag when the frame with its answer is painted. */
  #measure(request: Request): void {
    const start = this.#begun.get(request);
    if (start === undefined) return;
    requestAnimationFrame(() => {
      const painted = new MessageChannel();
      painted.port1.onmessage = () => {
        this.roundTrip.value = performance.measure(MEASURE, { start, end: performance.now() }).duration;
        painted.port1.close();
      };
      painted.port2.postMessage(null);
    });
  }

  #commit(): void {
    this.#dragging = null;
    this.isDragging.value = false;
    this.#adopt(this.#changes);
  }

  #adopt(changes: readonly { path: readonly string[]; value?: unknown }[]): void {
    this.edit((data) => apply(data, changes as readonly { path: readonly string[]; value: unknown }[]));
  }

  #fail(error: unknown, request: Request): void {
    if (error instanceof ApiError) {
      this.refused.value = { given: error.given, allowed: error.allowed, do: error.do };
    } else if (!(error instanceof ServerLost)) {
      this.refused.value = { given: String(error), allowed: "", do: "" };
    }
    if (request.drag && this.#dragging?.ended) this.#commit();
  }

  /** Circuits and checks take longer than a drag: they follow where it pauses. */
  #judgeLater(request: Request): void {
    clearTimeout(this.#timer);
    this.#judging?.abort();
    const pause = request.drag ? QUALITY_PAUSE / 2 : QUALITY_PAUSE;
    this.#timer = setTimeout(() => {
      const own = new AbortController();
      this.#judging = own;
      post<QualityAnswer>("/mechanism/quality", request, own.signal).then(
        (found) => {
          this.quality.value = found;
        },
        () => undefined,
      );
    }, pause);
  }
}
