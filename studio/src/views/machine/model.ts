/** A machine of the project under the user's hands: its settings, the design for them, and the state kept as B. */
import { batch, computed, effect, type Signal, signal } from "@preact/signals";
import { latest } from "../../api/latest";
import type {
  Comparison,
  DesignView,
  MachineFields,
  MachineFigures,
  NearestTasks,
  Sensitivities,
  Sensitivity,
} from "../../api/messages";
import { ApiError, get, post } from "../../api/request";
import { runWork } from "../../api/work";
import { remember, remembered } from "../../app/settings";
import type { Document } from "../../project";
import { firstFigures } from "./overlay";
import { change, changesTo, flat, type MachineFile, type Setting, type Settings } from "./settings";

/** Pause after the last change before what takes long is computed [ms]. */
const PAUSE = 400;

/** A design in flight is awaited this long although a newer state waits [ms]: each answer is worth being seen. */
const PATIENCE = 2000;

const forms = new Map<string, Promise<MachineFields>>();

/** The form of a machine, read once. */
export function formOf(machine: string): Promise<MachineFields> {
  const known = forms.get(machine) ?? get<MachineFields>(`/machines/${encodeURIComponent(machine)}`);
  forms.set(machine, known);
  known.catch(() => forms.delete(machine));
  return known;
}

interface State {
  machine: string;
  settings: Settings;
}

export class MachineModel {
  /** Settings that are being dragged, and not in the document yet. */
  readonly #dragged = signal<Settings>({});
  readonly machine = computed(() => this.document.data.value?.machine ?? "");
  readonly settings = computed<Settings>(() => ({
    ...flat(this.document.data.value?.settings),
    ...this.#dragged.value,
  }));
  readonly form = signal<MachineFields | null>(null);
  readonly view = signal<DesignView | null>(null);
  readonly failure = signal<ApiError | null>(null);
  readonly working = signal(false);
  readonly nearest = signal("");
  readonly figures = signal<MachineFigures | null>(null);
  readonly figuresOfB = signal<MachineFigures | null>(null);
  readonly part = signal("");
  readonly chosen = signal<readonly string[] | null>(null);
  readonly b: Signal<Settings | null>;
  readonly comparison = signal<Comparison | null>(null);
  /** Whether sensitivities are shown; what is known of them; and how many there will be. */
  readonly moving = signal(false);
  readonly sensitivities = signal<ReadonlyMap<string, Sensitivity>>(new Map());
  readonly toMove = signal<{ done: number; all: number } | null>(null);
  /** The other machine whose parameters are shown. */
  readonly shownMachine = signal("");

  readonly #ends: (() => void)[] = [];
  #timer: ReturnType<typeof setTimeout> | undefined;
  #later = new AbortController();

  constructor(readonly document: Document<MachineFile>) {
    this.b = signal(this.#remembered("b") as Settings | null);
    this.#ends.push(
      effect(() => this.#formFor(this.machine.value)),
      effect(() => this.#settingsChanged({ machine: this.machine.value, settings: this.settings.value })),
      effect(() => this.#figuresChanged(this.part.value, this.chosen.value)),
      effect(() => this.#bChanged(this.b.value)),
      effect(() => this.#movingChanged(this.moving.value, this.shownMachine.value)),
    );
  }

  /** Ends what is under way. */
  close(): void {
    this.drop();
    for (const end of this.#ends) end();
    clearTimeout(this.#timer);
    this.#later.abort();
    this.#redesign.cancel();
    this.#redraw.cancel();
    this.#redrawB.cancel();
  }

  /** Shows a setting while it is dragged; it is in the document when the drag has ended. */
  drag(name: string, setting: Setting): void {
    this.#dragged.value = { ...this.#dragged.peek(), [name]: setting };
  }

  /** Puts settings into the document; undefined takes one out. */
  set(changes: Readonly<Record<string, Setting | undefined>>): void {
    batch(() => {
      this.document.update((file) => {
        change(file, { ...this.#dragged.peek(), ...changes });
      });
      this.#dragged.value = {};
    });
  }

  /** Puts what was dragged into the document. */
  drop(): void {
    if (Object.keys(this.#dragged.peek()).length > 0) this.set({});
  }

  keepAsB(): void {
    this.b.value = this.settings.peek();
  }

  forgetB(): void {
    this.b.value = null;
  }

  /** A becomes B, and B becomes A. */
  switchWithB(): void {
    const [a, b] = [this.settings.peek(), this.b.peek()];
    if (b === null) return;
    this.b.value = a;
    this.set(changesTo(flat(this.document.data.peek()?.settings), b));
  }

  /** Shows the figures of a machine in the machine; "": of the machine itself. */
  showPart(part: string): void {
    batch(() => {
      this.part.value = part;
      this.chosen.value = null;
      this.figures.value = this.figures.peek() && { ...(this.figures.peek() as MachineFigures), figures: [] };
      this.figuresOfB.value = null;
    });
  }

  chooseFigures(names: readonly string[]): void {
    this.chosen.value = names;
    remember(`machine.figures.${this.machine.peek()}.${this.part.peek()}`, JSON.stringify(names));
  }

  readonly #redesign = latest<State, DesignView>(
    (state, abort) => post<DesignView>(path(state.machine, "view"), { settings: state.settings }, abort),
    (view, state) => {
      this.view.value = view;
      this.failure.value = null;
      this.#answered(state);
    },
    (error, state) => {
      if (error instanceof ApiError) this.failure.value = error;
      this.#answered(state);
    },
    PATIENCE,
  );

  readonly #redraw = latest<State & { part: string; names: readonly string[] | null }, MachineFigures>(
    ({ machine, settings, part, names }, abort) =>
      post<MachineFigures>(path(machine, "figures"), { settings, part, names: names ?? [] }, abort),
    (figures, { part, names }) => {
      if (part !== this.part.peek()) return;
      this.figures.value = figures;
      if (names === null && this.chosen.peek() === null) this.chosen.value = this.#rememberedFigures(figures, part);
    },
    () => undefined,
    PATIENCE,
  );

  readonly #redrawB = latest<State & { part: string; names: readonly string[] }, MachineFigures>(
    ({ machine, settings, part, names }, abort) => post(path(machine, "figures"), { settings, part, names }, abort),
    (figures) => {
      this.figuresOfB.value = figures;
    },
    () => {
      this.figuresOfB.value = null;
    },
    PATIENCE,
  );

  #formFor(machine: string): void {
    if (machine === "" || machine === this.form.peek()?.machine) return;
    this.form.value = null;
    this.view.value = null;
    this.figures.value = null;
    this.part.value = "";
    this.chosen.value = null;
    this.shownMachine.value = "";
    formOf(machine).then(
      (form) => {
        if (machine === this.machine.peek()) this.form.value = form;
      },
      (error: unknown) => {
        if (error instanceof ApiError) this.failure.value = error;
      },
    );
  }

  #settingsChanged(state: State): void {
    if (state.machine === "") return;
    this.working.value = true;
    this.#redesign(state);
    clearTimeout(this.#timer);
    this.#later.abort();
    this.sensitivities.value = new Map();
    this.toMove.value = null;
  }

  /** The view of a state is there: draws it, and when nothing follows computes what takes long. */
  #answered(state: State): void {
    const newest = state.settings === this.settings.peek() && state.machine === this.machine.peek();
    if (newest) this.working.value = false;
    if (this.failure.peek() === null) this.#redraw({ ...state, part: this.part.peek(), names: this.chosen.peek() });
    if (!newest) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#settled(state), PAUSE);
  }

  #settled(state: State): void {
    this.#later.abort();
    this.#later = new AbortController();
    this.nearest.value = "";
    this.comparison.value = null;
    if (this.failure.peek() !== null) return;
    if (this.view.peek()?.pending === true) this.#compareInSpace(state);
    else this.#findNearest(state);
    this.#compare(state);
    if (this.figuresOfB.peek() === null) this.#drawB();
    this.#move(state);
  }

  /** The parts against each other in space take some seconds: the view is whole when they are there. */
  #compareInSpace(state: State): void {
    post<DesignView>(path(state.machine, "space"), { settings: state.settings }, this.#later.signal).then(
      (view) => {
        this.view.value = view;
        this.#findNearest(state);
      },
      () => undefined,
    );
  }

  #findNearest(state: State): void {
    if (state.machine !== "automated-loom" || this.view.peek()?.holds !== false) return;
    post<NearestTasks>(path(state.machine, "nearest"), { settings: state.settings }, this.#later.signal).then(
      (found) => {
        this.nearest.value = found.text;
      },
      () => undefined,
    );
  }

  #compare(state: State): void {
    const b = this.b.peek();
    if (b === null) return;
    post<Comparison>(path(state.machine, "comparison"), { a: state.settings, b }, this.#later.signal).then(
      (found) => {
        this.comparison.value = found;
      },
      () => undefined,
    );
  }

  #move(state: State): void {
    if (!this.moving.peek()) return;
    const shown = this.shownMachine.peek();
    const names = (this.form.peek()?.fields ?? [])
      .filter((field) => field.machine === shown)
      .map((field) => field.name);
    const known = new Map<string, Sensitivity>();
    this.sensitivities.value = known;
    this.toMove.value = { done: 0, all: names.length };
    const take = (one: Sensitivity) => {
      known.set(one.parameter, one);
      this.sensitivities.value = new Map(known);
      this.toMove.value = { done: known.size, all: names.length };
    };
    const body = { settings: state.settings, parameters: names };
    runWork<Sensitivities, Sensitivity>(path(state.machine, "sensitivities"), body, {
      onNews: take,
      signal: this.#later.signal,
    }).then(
      (all) => {
        all.sensitivities.forEach(take);
        this.toMove.value = null;
      },
      () => {
        this.toMove.value = null;
      },
    );
  }

  #figuresChanged(part: string, names: readonly string[] | null): void {
    const state = { machine: this.machine.peek(), settings: this.settings.peek() };
    if (state.machine === "" || this.view.peek() === null) return;
    this.#redraw({ ...state, part, names });
    this.#drawB();
  }

  #bChanged(b: Settings | null): void {
    this.#rememberState("b", b);
    this.comparison.value = null;
    this.figuresOfB.value = null;
    const state = { machine: this.machine.peek(), settings: this.settings.peek() };
    if (b === null || state.machine === "") return;
    this.#compare(state);
    this.#drawB();
  }

  #drawB(): void {
    const [settings, names] = [this.b.peek(), this.chosen.peek()];
    if (settings === null || names === null || names.length === 0) return;
    this.#redrawB({ machine: this.machine.peek(), settings, part: this.part.peek(), names });
  }

  #movingChanged(moving: boolean, _shown: string): void {
    this.#later.abort();
    this.#later = new AbortController();
    this.toMove.value = null;
    if (!moving) this.sensitivities.value = new Map();
    else if (this.view.peek() !== null) this.#settled({ machine: this.machine.peek(), settings: this.settings.peek() });
  }

  #rememberedFigures(figures: MachineFigures, part: string): readonly string[] {
    const known = new Set(figures.known.map((figure) => figure.name));
    const kept = parsed(remembered(`machine.figures.${this.machine.peek()}.${part}`));
    const names = Array.isArray(kept) ? kept.filter((name): name is string => known.has(name)) : [];
    return names.length > 0 ? names : firstFigures(figures.known);
  }

  #remembered(what: string): unknown {
    return parsed(remembered(`machine.${what}.${this.document.path}`));
  }

  #rememberState(what: string, value: unknown): void {
    remember(`machine.${what}.${this.document.path}`, JSON.stringify(value));
  }
}

function path(machine: string, what: string): string {
  return `/machines/${encodeURIComponent(machine)}/${what}`;
}

function parsed(text: string | null): unknown {
  try {
    return JSON.parse(text ?? "null");
  } catch {
    return null;
  }
}
