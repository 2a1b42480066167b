/**
 * A text file of the project in the browser: its data, saved by itself.
 *
 * Requests of one file go one after the other. An edit is saved after a pause, at once when the page is hidden; until
 * the server has it, the browser keeps it. Where another program or tab changed the file too, nothing is overwritten:
 * the conflict is shown, and either state can be kept; the other one stays in the file's history.
 */
import { batch, computed, type ReadonlySignal, signal } from "@preact/signals";
import { ApiError, type FileContent, type FileError, type ProjectApi, problemOf, type State } from "./api";
import { isSame } from "./differences";
import type { Drafts } from "./drafts";

/** Pause after the last edit before it is saved [ms]. */
export const PAUSE = 300;

/** Pauses before a save that failed is tried again [ms]; the last one repeats. */
const RETRIES = [1000, 2000, 4000, 8000] as const;

/**
 * loading: not read yet; saved: the file has everything; changed: an edit waits; saving: it is sent; lost: the server
 * does not answer; refused: it could not save, see `problem`; conflict: another program changed the file;
 * missing: there is no such file.
 */
export type SaveState = "loading" | "saved" | "changed" | "saving" | "lost" | "refused" | "conflict" | "missing";

export interface Conflict {
  mine: State;
  theirs: FileContent;
}

export interface Surroundings {
  api: ProjectApi;
  drafts: Drafts;
}

/** A document whatever its data is. */
export type AnyDocument = Omit<Document<object>, "update" | "data"> & { readonly data: ReadonlySignal<object | null> };

export class Document<T extends object = Record<string, unknown>> {
  readonly #data = signal<T | null>(null);
  readonly #text = signal("");
  readonly #error = signal<FileError | null>(null);
  readonly #saved = signal<SaveState>("loading");
  readonly #problem = signal("");
  readonly #conflict = signal<Conflict | null>(null);
  readonly #history = signal({ undo: false, redo: false });

  /** Plain data of the file; null before it is read, and where its text is no TOML. Never change it in place. */
  readonly data: ReadonlySignal<T | null> = computed(() => this.#data.value);
  /** The text as it was saved last. */
  readonly text: ReadonlySignal<string> = computed(() => this.#text.value);
  /** The first error of the file, found by its reader; null: it can be used. */
  readonly error: ReadonlySignal<FileError | null> = computed(() => this.#error.value);
  readonly saved: ReadonlySignal<SaveState> = computed(() => this.#saved.value);
  /** Why the file could not be read or saved. */
  readonly problem: ReadonlySignal<string> = computed(() => this.#problem.value);
  readonly conflict: ReadonlySignal<Conflict | null> = computed(() => this.#conflict.value);
  readonly canUndo: ReadonlySignal<boolean> = computed(() => this.#history.value.undo || this.#isDirty.value);
  readonly canRedo: ReadonlySignal<boolean> = computed(() => this.#history.value.redo && !this.#isDirty.value);

  readonly #isDirty = computed(() => ["changed", "saving", "lost", "refused"].includes(this.#saved.value));
  readonly #around: Surroundings;
  #base = "";
  #pending: State | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #failures = 0;
  #left = false;
  #queue: Promise<void> = Promise.resolve();

  constructor(
    readonly path: string,
    around: Surroundings,
  ) {
    this.#around = around;
  }

  /** Reads the file, and takes up an edit that was not saved when the page was closed. */
  load(): Promise<void> {
    return this.#next(async () => {
      try {
        const file = await this.#around.api.read(this.path);
        const draft = this.#pending === null ? this.#around.drafts.get(this.path) : null;
        if (this.#pending === null) this.#take(file);
        if (draft !== null) this.#resume(draft, file);
      } catch (error) {
        if (error instanceof ApiError) {
          this.#problem.value = problemOf(error);
          this.#saved.value = "missing";
        } else {
          this.#saved.value = "lost";
          this.#later(() => void this.load());
        }
      }
    });
  }

  /**
   * Changes the data: `change` gets a copy that it may change, or returns other data. Saved after a pause.
   *
   * Returns whether there was data to change.
   */
  update(change: (data: T) => T | undefined): boolean {
    const before = this.#data.peek();
    if (before === null) return false;
    const copy = structuredClone(before);
    const data = change(copy) ?? copy;
    if (!isSame(data, before)) {
      this.#data.value = data;
      this.#edit({ data });
    }
    return true;
  }

  /** Changes the whole text. Saved after a pause; the data follows then. */
  setText(text: string): void {
    if (text !== this.#text.peek() || this.#pending !== null) this.#edit({ text });
  }

  /** Saves now what waits; resolves when that was tried. */
  flush(): Promise<void> {
    clearTimeout(this.#timer);
    return this.#next(() => this.#send());
  }

  /**
   * Does what takes the file away, after all that waits; then the document asks the server for nothing any more.
   *
   * Throws what `work` throws; the document then goes on.
   */
  leave(work: () => Promise<void>): Promise<void> {
    void this.flush();
    const left = this.#queue.then(work).then(() => {
      this.#left = true;
      clearTimeout(this.#timer);
    });
    this.#queue = left.catch(() => undefined);
    return left;
  }

  /** Brings back the state before; what waits is saved first. */
  undo(): Promise<void> {
    return this.#step((path) => this.#around.api.undo(path));
  }

  /** Brings back the state that was undone last. */
  redo(): Promise<void> {
    return this.#step((path) => this.#around.api.redo(path));
  }

  /** Follows a change of another program or tab, where nothing waits here. */
  refresh(): Promise<void> {
    return this.#next(async () => {
      if (this.#pending !== null || this.#conflict.peek() !== null) return;
      try {
        const file = await this.#around.api.read(this.path);
        if (this.#pending === null && file.digest !== this.#base) this.#take(file);
        else if (this.#pending === null) this.#error.value = errorOf(file);
      } catch (error) {
        if (error instanceof ApiError && this.#pending === null) {
          this.#problem.value = problemOf(error);
          this.#saved.value = "missing";
        }
      }
    });
  }

  /** Ends a conflict: keeps this state, or takes the one on the disc; undo brings the other one back. */
  resolve(choice: "mine" | "theirs"): Promise<void> {
    const conflict = this.#conflict.peek();
    if (conflict === null) return Promise.resolve();
    const mine = this.#pending ?? conflict.mine;
    if (choice === "theirs") return this.#next(() => this.#setAside(mine));
    this.#conflict.value = null;
    this.#base = conflict.theirs.digest;
    this.#pending = mine;
    return this.flush();
  }

  /** Takes the state on the disc, once the server has this one in the file's history. */
  async #setAside(mine: State): Promise<void> {
    try {
      const { file } = await this.#around.api.save(this.path, "", { ...mine, aside: true });
      this.#conflict.value = null;
      this.#take(file);
    } catch (error) {
      this.#problem.value = problemOf(error);
    }
  }

  #edit(state: State): void {
    this.#pending = state;
    this.#around.drafts.set(this.path, { base: this.#base, ...state });
    if (this.#conflict.peek() !== null) return;
    if (this.#saved.peek() !== "lost") this.#saved.value = "changed";
    this.#failures = 0;
    this.#later(() => void this.flush(), PAUSE);
  }

  async #send(): Promise<void> {
    const state = this.#pending;
    if (state === null || this.#conflict.peek() !== null) return;
    if (this.#saved.peek() !== "lost") this.#saved.value = "saving";
    try {
      const answer = await this.#around.api.save(this.path, this.#base, state);
      this.#failures = 0;
      this.#problem.value = "";
      if (answer.saved || isEqual(state, answer.file)) this.#wasSaved(state, answer.file);
      else this.#disagree(this.#pending ?? state, answer.file);
    } catch (error) {
      this.#problem.value = problemOf(error);
      this.#saved.value = error instanceof ApiError ? "refused" : "lost";
      this.#later(() => void this.flush());
    }
  }

  #wasSaved(state: State, file: FileContent): void {
    this.#base = file.digest;
    if (this.#pending === state) {
      this.#take(file, state.data !== undefined);
    } else if (this.#pending !== null) {
      this.#history.value = { undo: true, redo: false };
      this.#saved.value = "changed";
      this.#around.drafts.set(this.path, { base: this.#base, ...this.#pending });
    }
  }

  /** Takes a state of the disc, data and text of a file that has gone aside; `own`: it is what was sent. */
  #take(file: FileContent, own = false): void {
    this.#pending = null;
    this.#base = file.digest;
    batch(() => {
      if (file.digest !== "") {
        if (!own || !isSame(this.#data.peek(), file.data)) this.#data.value = (file.data ?? null) as T | null;
        this.#text.value = file.text;
      }
      this.#error.value = errorOf(file);
      this.#history.value = { undo: file.undo ?? false, redo: file.redo ?? false };
      this.#problem.value = "";
      this.#saved.value = file.digest === "" ? "missing" : "saved";
    });
    this.#around.drafts.remove(this.path);
  }

  #resume(draft: State & { base: string }, file: FileContent): void {
    const state: State = draft.data === undefined ? { text: draft.text ?? "" } : { data: draft.data };
    if (isEqual(state, file)) return;
    this.#pending = state;
    if (state.data !== undefined) this.#data.value = state.data as T;
    this.#around.drafts.set(this.path, draft);
    if (draft.base === file.digest) {
      this.#saved.value = "changed";
      this.#later(() => void this.flush(), 0);
    } else {
      this.#disagree(state, file);
    }
  }

  #disagree(mine: State, theirs: FileContent): void {
    this.#pending = mine;
    this.#conflict.value = { mine, theirs };
    this.#saved.value = "conflict";
  }

  #step(request: (path: string) => Promise<FileContent>): Promise<void> {
    clearTimeout(this.#timer);
    return this.#next(async () => {
      await this.#send();
      if (this.#pending !== null) return;
      try {
        const file = await request(this.path);
        if (this.#pending === null) this.#take(file);
      } catch (error) {
        this.#problem.value = problemOf(error);
        if (!(error instanceof ApiError)) this.#saved.value = "lost";
        this.#later(() => void this.refresh().then(() => this.flush()));
      }
    });
  }

  #next(work: () => Promise<void>): Promise<void> {
    this.#queue = this.#queue.then(() => (this.#left ? undefined : work()));
    return this.#queue;
  }

  #later(work: () => void, pause?: number): void {
    clearTimeout(this.#timer);
    const retry = RETRIES[Math.min(this.#failures, RETRIES.length - 1)] ?? 1000;
    if (pause === undefined) this.#failures += 1;
    this.#timer = setTimeout(work, pause ?? retry);
  }
}

/** The first error of a file; what is only unfinished is named by its view. */
function errorOf({ error }: FileContent): FileError | null {
  return error == null || error.unfinished ? null : error;
}

function isEqual(state: State, file: FileContent): boolean {
  return state.data === undefined ? state.text === file.text : isSame(state.data, file.data);
}
