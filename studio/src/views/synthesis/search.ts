/** The candidates of a task: a short search while it is dragged, the full one as work once it rests. */
import { signal } from "@preact/signals";
import { type Fault, faultOf } from "../../api/fault";
import { latest } from "../../api/latest";
import type { SynthesisAnswer } from "../../api/messages";
import { post } from "../../api/request";
import { runWork } from "../../api/work";
import type { SynthesisData } from "./task";

/** quick: a short search runs; full: the full one; done: the answer is that of the full search. */
export type SearchState = "idle" | "quick" | "full" | "done" | "stopped" | "failed";

/** Pause after the last change before the full search begins [ms]. */
export const PAUSE = 500;

/** Time after which a short search is given up for a newer state [ms]: nine points met exactly take seconds. */
const PATIENCE = 15_000;

/** The search of one view. */
export class CandidateSearch {
  readonly state = signal<SearchState>("idle");
  readonly answer = signal<SynthesisAnswer | null>(null);
  readonly error = signal<Fault | null>(null);
  readonly share = signal(0);
  /** Time of the last short search, from the request to the answer [ms]. */
  readonly quickTime = signal<number | null>(null);
  #sent = 0;
  readonly #quick = latest<SynthesisData, SynthesisAnswer>(
    (data, signal) => {
      this.#sent = performance.now();
      return post<SynthesisAnswer>("/synthesis/candidates", { data, quick: true }, signal);
    },
    (found) => {
      this.quickTime.value = performance.now() - this.#sent;
      // A short search may answer after the full one, or after a stop: what they left stays.
      if (!["quick", "failed"].includes(this.state.peek())) return;
      if (!found.quick) clearTimeout(this.#timer);
      this.#take(found, found.quick ? "quick" : "done");
    },
    (error) => this.#fail(error),
    PATIENCE,
  );
  #full: AbortController | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #key = "";

  /** The task changed: a short search at once, unless one runs (then after it), the full one after a pause. */
  follow(data: SynthesisData, settled = true): void {
    const key = JSON.stringify([data.machine, data.settings]);
    if (key === this.#key && (!settled || this.#full !== null || this.state.peek() === "done")) return;
    const changed = key !== this.#key;
    this.#key = key;
    this.#stopFull();
    if (changed) {
      this.state.value = "quick";
      this.#quick(data);
    }
    if (settled) this.#timer = setTimeout(() => void this.search(data), changed ? PAUSE : 0);
  }

  /** The full search, now. */
  async search(data: SynthesisData): Promise<void> {
    this.#stopFull();
    const abort = new AbortController();
    this.#full = abort;
    this.state.value = "full";
    this.share.value = 0;
    try {
      const found = await runWork<SynthesisAnswer>(
        "/synthesis/search",
        { data, quick: false },
        {
          signal: abort.signal,
          onStep: (_, share) => {
            this.share.value = share;
          },
        },
      );
      if (this.#full === abort) this.#take(found, "done");
    } catch (error) {
      if (this.#full === abort) this.#fail(error);
    } finally {
      if (this.#full === abort) this.#full = null;
    }
  }

  /** Ends the full search; the candidates of the short one stay. */
  stop(): void {
    this.#stopFull();
    this.state.value = "stopped";
  }

  /** Ends everything and forgets the answer: the task cannot be searched yet. */
  clear(): void {
    this.close();
    this.answer.value = null;
    this.error.value = null;
    this.state.value = "idle";
  }

  /** Ends everything. */
  close(): void {
    this.#stopFull();
    this.#quick.cancel();
    this.#key = "";
  }

  #stopFull(): void {
    clearTimeout(this.#timer);
    this.#full?.abort();
    this.#full = null;
  }

  #take(found: SynthesisAnswer, state: SearchState): void {
    this.answer.value = found;
    this.error.value = null;
    this.state.value = state;
  }

  #fail(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    this.#key = "";
    const fault = faultOf(error);
    this.state.value = fault === null ? "stopped" : "failed";
    if (fault !== null) this.error.value = fault;
  }
}
