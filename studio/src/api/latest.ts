/** One request at a time, and always the newest state: what a drag needs. */

export interface Latest<State> {
  /** Send a state; one that waits is replaced, one in flight is aborted if it takes long. */
  (state: State): void;
  /** Abort what is in flight and forget what waits. */
  cancel(): void;
}

/** Time after which a request in flight is aborted for a newer state [ms]; a shorter one is worth its answer. */
const PATIENCE = 250;

/**
 * A function that sends states one after the other and leaves out those that are no longer the newest.
 *
 * send   sends a state; its answer goes to `take`, in order
 * fail   receives an error; an aborted request is none
 */
export function latest<State, Reply>(
  send: (state: State, signal: AbortSignal) => Promise<Reply>,
  take: (reply: Reply, state: State) => void,
  fail: (error: unknown, state: State) => void = () => {},
  patience = PATIENCE,
): Latest<State> {
  let flight: { abort: AbortController; began: number; timer?: ReturnType<typeof setTimeout> } | undefined;
  let waiting: { state: State } | undefined;

  async function start(state: State): Promise<void> {
    const own = { abort: new AbortController(), began: performance.now() };
    flight = own;
    try {
      const reply = await send(state, own.abort.signal);
      if (!own.abort.signal.aborted) take(reply, state);
    } catch (error) {
      if (!own.abort.signal.aborted) fail(error, state);
    } finally {
      finish(own);
    }
  }

  function finish(own: typeof flight): void {
    if (flight !== own) return;
    clearTimeout(flight?.timer);
    flight = undefined;
    const next = waiting;
    waiting = undefined;
    if (next) void start(next.state);
  }

  function request(state: State): void {
    if (!flight) {
      void start(state);
      return;
    }
    waiting = { state };
    const own = flight;
    own.timer ??= setTimeout(
      () => {
        own.abort.abort();
        finish(own);
      },
      Math.max(0, own.began + patience - performance.now()),
    );
  }

  function cancel(): void {
    waiting = undefined;
    const own = flight;
    own?.abort.abort();
    finish(own);
  }

  return Object.assign(request, { cancel });
}
