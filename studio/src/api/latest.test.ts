import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { latest } from "./latest";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A server that answers each state after a time, with a list of what happened. */
function slow(time: number, fails = false) {
  const log: string[] = [];
  const send = latest(
    (state: number, signal) =>
      new Promise<number>((resolve, reject) => {
        log.push(`send ${state}`);
        signal.addEventListener("abort", () => {
          log.push(`abort ${state}`);
          reject(new DOMException("aborted", "AbortError"));
        });
        setTimeout(() => (fails ? reject(new Error("no")) : resolve(state)), time);
      }),
    (reply) => log.push(`take ${reply}`),
    (error) => log.push(String(error)),
  );
  return { log, send };
}

it("has one request in flight and sends the newest state after it", async () => {
  const { log, send } = slow(20);
  for (const state of [1, 2, 3, 4]) send(state);
  await vi.advanceTimersByTimeAsync(100);
  expect(log).toEqual(["send 1", "take 1", "send 4", "take 4"]);
});

it("aborts a request that takes long for a newer state", async () => {
  const { log, send } = slow(1000);
  send(1);
  await vi.advanceTimersByTimeAsync(100);
  send(2);
  send(3);
  await vi.advanceTimersByTimeAsync(149);
  expect(log).toEqual(["send 1"]);
  await vi.advanceTimersByTimeAsync(2000);
  expect(log).toEqual(["send 1", "abort 1", "send 3", "take 3"]);
});

it("leaves a long request alone where nothing newer comes", async () => {
  const { log, send } = slow(5000);
  send(1);
  await vi.advanceTimersByTimeAsync(6000);
  expect(log).toEqual(["send 1", "take 1"]);
});

it("goes on after an error", async () => {
  const { log, send } = slow(10, true);
  send(1);
  send(2);
  await vi.advanceTimersByTimeAsync(100);
  expect(log).toEqual(["send 1", "Error: no", "send 2", "Error: no"]);
});

it("forgets everything when it is cancelled", async () => {
  const { log, send } = slow(10);
  send(1);
  send(2);
  send.cancel();
  await vi.advanceTimersByTimeAsync(100);
  expect(log).toEqual(["send 1", "abort 1"]);
  send(3);
  await vi.advanceTimersByTimeAsync(100);
  expect(log.at(-1)).toBe("take 3");
});
