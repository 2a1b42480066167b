import { afterEach, describe, expect, it, vi } from "vitest";
import { ApiError, get, post, postPacked, ServerLost, unpacked, upload } from "./request";

afterEach(() => vi.unstubAllGlobals());

function stubFetch(reply: () => Response | Promise<Response>) {
  const fetched = vi.fn((_address: string, _options: RequestInit) => Promise.resolve().then(reply));
  vi.stubGlobal("fetch", fetched);
  return fetched;
}

/** A packed answer as the server makes it. */
function packed(about: unknown, ...parts: number[][]): ArrayBuffer {
  let text = JSON.stringify(about);
  while ((new TextEncoder().encode(text).length + 4) % 8) text += " ";
  const head = new TextEncoder().encode(text);
  const filled = parts.map((part) => [...part, ...new Array((8 - (part.length % 8)) % 8).fill(0)]);
  const length = [head.length & 255, head.length >> 8, 0, 0];
  return new Uint8Array([...length, ...head, ...filled.flat()]).buffer;
}

describe("requests", () => {
  it("send JSON with the name of the page", async () => {
    const fetched = stubFetch(() => Response.json({ a: 1 }));
    expect(await post("/machines/beat-up/design", { settings: {} })).toEqual({ a: 1 });
    const [address, options] = fetched.mock.calls[0] ?? [];
    expect(address).toBe("/api/machines/beat-up/design");
    expect(options?.headers).toMatchObject({ "content-type": "application/json" });
    expect(new Headers(options?.headers).get("x-page")).toMatch(/^[0-9a-z]{12,}$/);
    expect(options?.body).toBe('{"settings":{}}');
  });

  it("send a file as bytes, whose type the server finds", async () => {
    const fetched = stubFetch(() => Response.json({}));
    await upload("/pictures/a.png", new Blob(["x"], { type: "image/png" }));
    expect(fetched.mock.calls[0]?.[1].headers).toMatchObject({ "content-type": "application/octet-stream" });
  });

  it("report the server's error in its three parts", async () => {
    const error = { given: "crank 1 m", allowed: "below 0.5 m", do: "shorten it" };
    stubFetch(() => Response.json({ error }, { status: 422 }));
    const failed = await get("/x").catch((reason: unknown) => reason);
    expect(failed).toBeInstanceOf(ApiError);
    expect(failed).toMatchObject({ ...error, status: 422, message: "crank 1 m; below 0.5 m; shorten it" });
  });

  it("report an error that is no JSON", async () => {
    stubFetch(() => new Response("Not allowed", { status: 401, statusText: "Unauthorized" }));
    await expect(get("/x")).rejects.toThrow("401 Unauthorized");
  });

  it("tell a lost server from an aborted request", async () => {
    stubFetch(() => Promise.reject(new TypeError("failed to fetch")));
    await expect(get("/x")).rejects.toBeInstanceOf(ServerLost);
    const abort = new AbortController();
    abort.abort();
    await expect(get("/x", abort.signal)).rejects.not.toBeInstanceOf(ServerLost);
  });

  it("unpack JSON and arrays", async () => {
    const content = packed({ text: "ç", sizes: [3, 9] }, [1, 2, 3], [1, 2, 3, 4, 5, 6, 7, 8, 9]);
    const { about, parts } = unpacked<{ text: string; sizes: number[] }>(content);
    expect(about.text).toBe("ç");
    const [first, second] = parts(about.sizes);
    expect([...(first ?? [])]).toEqual([1, 2, 3]);
    expect([...(second ?? [])].at(-1)).toBe(9);
    expect((second?.byteOffset ?? 1) % 8).toBe(0);
    stubFetch(() => new Response(content));
    expect((await postPacked("/x", {})).about).toEqual(about);
  });
});
