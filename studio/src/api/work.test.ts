import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { connection } from "./connection";
import { connect, now, onEvent, type ServerEvent } from "./events";
import { runWork } from "./work";

class FakeSocket {
  static all: FakeSocket[] = [];
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: (() => void) | null = null;
  constructor(readonly address: string) {
    FakeSocket.all.push(this);
  }
  static get last(): FakeSocket {
    const last = FakeSocket.all.at(-1);
    if (!last) throw new Error("no socket");
    return last;
  }
}

function receive(event: ServerEvent): void {
  FakeSocket.last.onmessage?.({ data: JSON.stringify(event) });
}

const hello: ServerEvent = { type: "hello", version: "1", start: 1 };
const replies: Record<string, () => Response> = {};
const requests: string[] = [];

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("fetch", async (address: string, { method }: RequestInit) => {
    requests.push(`${method} ${address}`);
    return (replies[`${method} ${address}`] ?? (() => Response.json({ error: null }, { status: 404 })))();
  });
  requests.length = 0;
  replies["POST /api/long"] = () => Response.json({ work: 7 }, { status: 202 });
  connect();
  receive(hello);
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

it("connects again, later each time, and at once when somebody asks", async () => {
  expect(connection.value).toBe("connected");
  const before = FakeSocket.all.length;
  FakeSocket.last.onclose?.();
  expect(connection.value).toBe("lost");
  await vi.advanceTimersByTimeAsync(100);
  expect(FakeSocket.all.length).toBe(before + 1);
  FakeSocket.last.onclose?.();
  await vi.advanceTimersByTimeAsync(100);
  expect(FakeSocket.all.length).toBe(before + 1);
  now();
  expect(FakeSocket.all.length).toBe(before + 2);
  receive(hello);
  expect(connection.value).toBe("connected");
});

it("gives events to listeners until they end", () => {
  const seen: string[] = [];
  const end = onEvent((event) => void seen.push(event.type));
  receive({ type: "changed", paths: ["carpet.toml"] });
  end();
  receive({ type: "changed", paths: ["carpet.toml"] });
  expect(seen).toEqual(["changed"]);
});

it("reports a work and fetches its answer", async () => {
  replies["GET /api/work/7"] = () => Response.json({ answer: 42 });
  const seen: unknown[] = [];
  const work = runWork("/long", {}, { onStep: (stage, share) => seen.push(stage, share), onNews: (n) => seen.push(n) });
  await vi.advanceTimersByTimeAsync(0);
  receive({ type: "step", work: 7, stage: "chart", share: 0.5 });
  receive({ type: "step", work: 8, stage: "other", share: 0.5 });
  receive({ type: "news", work: 7, news: { row: 3 } });
  receive({ type: "done", work: 7, time: 1 });
  await expect(work).resolves.toEqual({ answer: 42 });
  expect(seen).toEqual(["chart", 0.5, { row: 3 }]);
});

it("loses no event that comes before the number of the work", async () => {
  replies["GET /api/work/7"] = () => Response.json({ answer: 42 });
  const news: unknown[] = [];
  const work = runWork("/long", {}, { onNews: (one) => news.push(one) });
  receive({ type: "news", work: 7, news: "early" });
  receive({ type: "done", work: 7, time: 1 });
  await expect(work).resolves.toEqual({ answer: 42 });
  expect(news).toEqual(["early"]);
});

it("fails with the server's error", async () => {
  const work = runWork("/long", {});
  const failed = expect(work).rejects.toThrow("too short; lengthen it");
  await vi.advanceTimersByTimeAsync(0);
  receive({ type: "failed", work: 7, error: { given: "too short", allowed: "", do: "lengthen it" } });
  await failed;
});

it("cancels by its signal", async () => {
  const abort = new AbortController();
  const work = runWork("/long", {}, { signal: abort.signal });
  const failed = expect(work).rejects.toMatchObject({ name: "AbortError" });
  await vi.advanceTimersByTimeAsync(0);
  abort.abort();
  await failed;
  expect(requests).toContain("DELETE /api/work/7");
});

it("looks after a lost connection whether the work goes on, has ended or is gone", async () => {
  replies["GET /api/work/7"] = () => Response.json({ work: 7, stage: "", share: 0 }, { status: 202 });
  const one = runWork("/long", {});
  await vi.advanceTimersByTimeAsync(0);
  receive(hello);
  await vi.advanceTimersByTimeAsync(0);
  replies["GET /api/work/7"] = () => Response.json({ answer: 1 });
  receive(hello);
  await expect(one).resolves.toEqual({ answer: 1 });
  delete replies["GET /api/work/7"];
  const two = runWork("/long", {});
  const failed = expect(two).rejects.toThrow("404");
  await vi.advanceTimersByTimeAsync(0);
  receive(hello);
  await failed;
});
