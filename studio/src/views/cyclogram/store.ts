/** A cyclogram as it is shown: asked for with each change, solved as work. */
import { computed, signal } from "@preact/signals";
import { type Fault, faultOf } from "../../api/fault";
import { latest } from "../../api/latest";
import type { CyclogramSolution, CyclogramView } from "../../api/messages";
import { postPacked } from "../../api/request";
import { runWork } from "../../api/work";
import { type Shown, unpack } from "./curves";
import type { CyclogramData } from "./model";

export type Goal = "acceleration" | "period";

/** A solution beside what it was made from. */
export interface Compared {
  solution: CyclogramSolution;
  before: Shown;
  after: Shown;
}

/** The state of one view. */
export class CyclogramStore {
  readonly #shown = signal<Shown | null>(null);
  readonly fault = signal<Fault | null>(null);
  readonly solving = signal<Goal | null>(null);
  readonly share = signal(0);
  readonly compared = signal<Compared | null>(null);
  /** Time of the last answer, from the request on [ms]. */
  readonly time = signal<number | null>(null);
  /** What is drawn: the solution while it is compared, else the cyclogram. */
  readonly shown = computed(() => this.compared.value?.after ?? this.#shown.value);
  #abort: AbortController | null = null;
  #sent = 0;
  readonly #follow = latest<CyclogramData, Shown>(
    async (data, signal) => {
      this.#sent = performance.now();
      return unpack(await postPacked<CyclogramView>("/cyclogram/view", { data }, signal));
    },
    (found) => {
      this.time.value = performance.now() - this.#sent;
      this.#shown.value = found;
      this.fault.value = null;
    },
    (error) => {
      this.fault.value = faultOf(error);
    },
    2000,
  );

  /** The data changed. A solution that was compared is no longer that of the data. */
  follow(data: CyclogramData): void {
    this.compared.value = null;
    this.stop();
    this.#follow(data);
  }

  /** Solves the cyclogram for a goal; the solution is compared, not yet taken. */
  async solve(data: CyclogramData, goal: Goal): Promise<void> {
    this.stop();
    const before = this.#shown.peek();
    if (before === null) return;
    const abort = new AbortController();
    this.#abort = abort;
    this.solving.value = goal;
    this.share.value = 0;
    this.compared.value = null;
    try {
      const solution = await runWork<CyclogramSolution>(
        "/cyclogram/solve",
        { data, goal },
        {
          signal: abort.signal,
          onStep: (_, share) => {
            this.share.value = share;
          },
        },
      );
      const after = unpack(await postPacked<CyclogramView>("/cyclogram/view", { data: solution.data }, abort.signal));
      if (this.#abort !== abort) return;
      this.compared.value = { solution, before, after };
      this.fault.value = null;
    } catch (error) {
      if (this.#abort === abort) this.fault.value = faultOf(error);
    } finally {
      if (this.#abort === abort) this.stop();
    }
  }

  /** Ends a solution that runs. */
  stop(): void {
    this.#abort?.abort();
    this.#abort = null;
    this.solving.value = null;
  }

  /** Leaves the solution; the cyclogram is as before. */
  discard(): void {
    this.compared.value = null;
  }

  /** Ends everything. */
  close(): void {
    this.stop();
    this.#follow.cancel();
  }
}
