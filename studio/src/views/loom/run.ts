/** The run of the twin that this page has started: it goes on while other views are open, and after a reload. */
import { signal } from "@preact/signals";
import type { Answer, RunNews, TwinRunEnd } from "../../api/messages";
import { ApiError, post } from "../../api/request";
import { followWork, runWork, type WorkListeners } from "../../api/work";
import { t } from "../../text";
import { toast } from "../../ui";

/** What starts a run: a recipe, and how much faster than the loom's clock goes. */
interface RunOrder {
  file: string;
  speed: number;
}

export interface Run extends RunOrder {
  going: boolean;
  news: RunNews | null;
  /** Time of the loom's clock at the last knot of the row [s]. */
  tied: number;
  /** How it ended. */
  ended: string;
}

interface Remembered extends RunOrder {
  work: number;
}

const KEY = "ilmek.loom-run";

/** The run of this page, also when it has ended; null: none. */
export const run = signal<Run | null>(null);
let control = new AbortController();

export function startRun(order: RunOrder): Promise<void> {
  return follow(order, (listeners) => runWork<TwinRunEnd, RunNews>("/loom/run", order, listeners));
}

/** Finds the run again that this page started before it was loaded anew. */
export async function findRun(): Promise<void> {
  const known = remembered();
  if (run.peek() !== null || known === null) return;
  const { work, ...order } = known;
  await follow(order, (listeners) => followWork<TwinRunEnd, RunNews>(work, listeners));
}

/** Ends a run that is being prepared. */
export function cancelRun(): void {
  control.abort();
}

/** Gives a command to the loom; a refusal is shown. */
export async function give(command: "hold" | "resume" | "stop"): Promise<void> {
  try {
    const answer = await post<Answer>("/loom/command", { command });
    if (!answer.ok) toast(t("loom.refused", { reason: answer.reason }), "warn");
  } catch (reason) {
    toast(t("loom.refused", { reason: words(reason) }), "warn");
  }
}

async function follow(
  { file, speed }: RunOrder,
  work: (listeners: WorkListeners<RunNews>) => Promise<TwinRunEnd>,
): Promise<void> {
  control = new AbortController();
  const { signal } = control;
  let now: Run = { file, speed, going: true, news: null, tied: 0, ended: "" };
  run.value = now;
  const show = (more: Partial<Run>) => {
    now = { ...now, ...more };
    run.value = now;
  };
  const onNews = (news: RunNews) =>
    show({ news, tied: news.tied < news.due || now.news === null ? news.time : now.tied });
  try {
    const onNumber = (number: number) => remember({ work: number, file, speed });
    const end = await work({ onNews, onNumber, signal });
    onNews(end.last);
    show({ going: false, ended: t("loom.done", { knots: end.knots, faults: end.faults }) });
  } catch (reason) {
    show({ going: false, ended: signal.aborted ? "" : endOf(reason) });
  }
  remember(null);
}

function endOf(reason: unknown): string {
  const gone = reason instanceof ApiError && reason.status === 404;
  return gone ? t("loom.runGone") : t("loom.runFailed", { reason: words(reason) });
}

function words(reason: unknown): string {
  return reason instanceof Error ? reason.message : String(reason);
}

function remember(known: Remembered | null): void {
  try {
    if (known === null) sessionStorage.removeItem(KEY);
    else sessionStorage.setItem(KEY, JSON.stringify(known));
  } catch {
    // a browser that keeps nothing: the run is not found again
  }
}

function remembered(): Remembered | null {
  try {
    return JSON.parse(sessionStorage.getItem(KEY) ?? "null") as Remembered | null;
  } catch {
    return null;
  }
}
