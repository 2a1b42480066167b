/** Long work: started by a request, reported by events, cancelled by a signal. */
import { onEvent, type ServerEvent } from "./events";
import { ApiError, get, post, remove } from "./request";

export interface WorkListeners<News> {
  onStep?: (stage: string, share: number) => void;
  onNews?: (news: News) => void;
  /** The number of the work, as soon as it is known: by it the work is followed again after the page was loaded anew. */
  onNumber?: (number: number) => void;
  signal?: AbortSignal;
}

/** Events that came before the number of their work was known. */
const early: ServerEvent[] = [];
const MOST_EARLY = 200;
let starting = 0;

onEvent((event) => {
  if (starting > 0 && "work" in event) {
    early.push(event);
    if (early.length > MOST_EARLY) early.shift();
  }
});

/**
 * The answer of a long work. It survives a lost connection; where the server was started anew the work is gone, and the
 * promise fails. Raises ApiError, or AbortError after `signal`.
 */
export async function runWork<Reply, News = unknown>(
  path: string,
  body: unknown,
  listeners: WorkListeners<News> = {},
): Promise<Reply> {
  starting += 1;
  let number: number;
  let before: ServerEvent[];
  try {
    number = (await post<{ work: number }>(path, body, listeners.signal)).work;
  } finally {
    starting -= 1;
    before = starting === 0 ? early.splice(0) : [...early];
  }
  listeners.onNumber?.(number);
  return follow<Reply, News>(number, before, listeners);
}

/** The answer of a work that this page started before it was loaded anew. Raises as `runWork`. */
export function followWork<Reply, News = unknown>(number: number, listeners: WorkListeners<News> = {}): Promise<Reply> {
  return follow<Reply, News>(number, null, listeners);
}

/** before: the events that have come; null: not known. */
function follow<Reply, News>(
  number: number,
  before: readonly ServerEvent[] | null,
  { onStep, onNews, signal }: WorkListeners<News>,
): Promise<Reply> {
  const path = `/work/${number}`;
  return new Promise<Reply>((resolve, reject) => {
    const end = onEvent(take);
    signal?.addEventListener("abort", abort, { once: true });
    if (before === null) look();
    else for (const event of before) take(event);
    if (signal?.aborted) abort();

    function close(): void {
      end();
      signal?.removeEventListener("abort", abort);
    }

    function abort(): void {
      close();
      void remove(path).catch(() => {});
      reject(new DOMException("cancelled", "AbortError"));
    }

    function fetchAnswer(): void {
      close();
      get<Reply>(path).then(resolve, reject);
    }

    /** After the connection was lost: is the work still there, and has it ended meanwhile? */
    function look(): void {
      get<Reply | { work: number; stage: string }>(path).then(
        (state) => {
          if (!isRunning(state, number)) {
            close();
            resolve(state as Reply);
          }
        },
        (error: unknown) => {
          close();
          reject(error);
        },
      );
    }

    function take(event: ServerEvent): void {
      if (event.type === "hello") look();
      if (!("work" in event) || event.work !== number) return;
      if (event.type === "step") onStep?.(event.stage, event.share);
      if (event.type === "news") onNews?.(event.news as News);
      if (event.type === "done") fetchAnswer();
      if (event.type === "cancelled") {
        close();
        reject(new DOMException("cancelled", "AbortError"));
      }
      if (event.type === "failed") {
        close();
        const { given = "", allowed = "", do: advice = "" } = event.error ?? {};
        reject(new ApiError(500, given, allowed, advice));
      }
    }
  });
}

function isRunning(state: unknown, number: number): boolean {
  const fields = state as Record<string, unknown>;
  return Boolean(fields) && fields["work"] === number && "stage" in fields && "share" in fields;
}
