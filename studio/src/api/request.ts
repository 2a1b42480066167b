/** Requests to the studio's server. Paths are those of the API, below /api. */

import { language } from "../text";

/** What the server refuses: what was given, what is allowed, what to do. */
export class ApiError extends Error {
  readonly do: string;

  constructor(
    readonly status: number,
    readonly given: string,
    readonly allowed = "",
    advice = "",
  ) {
    super([given, allowed, advice].filter(Boolean).join("; "));
    this.name = "ApiError";
    this.do = advice;
  }
}

/** The server does not answer; the request may be sent again when it is back. */
export class ServerLost extends Error {
  constructor() {
    super("the server does not answer");
    this.name = "ServerLost";
  }
}

/** JSON with arrays behind it. */
export interface Packed<T> {
  about: T;
  parts: (lengths: readonly number[]) => Uint8Array<ArrayBuffer>[];
}

/**
 * Name of this page, the same after it is loaded again: the works that it starts report to it alone, and end some time
 * after it has gone.
 */
export const page: string = named();

function named(): string {
  const fresh = Array.from(crypto.getRandomValues(new Uint8Array(12)), (n) => n.toString(36)).join("");
  try {
    const known = sessionStorage.getItem("ilmek.page") ?? fresh;
    sessionStorage.setItem("ilmek.page", known);
    return known;
  } catch {
    return fresh;
  }
}

export async function get<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await answered("GET", path, undefined, signal)).json() as Promise<T>;
}

export async function post<T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> {
  return (await answered("POST", path, json(body), signal)).json() as Promise<T>;
}

export async function put<T>(path: string, body: unknown, signal?: AbortSignal): Promise<T> {
  return (await answered("PUT", path, json(body), signal)).json() as Promise<T>;
}

export async function remove(path: string, signal?: AbortSignal): Promise<void> {
  await answered("DELETE", path, undefined, signal);
}

/** Send a file as it is; the server tells its type by its content: names and browsers are not relied on. */
export async function upload<T>(path: string, file: Blob, signal?: AbortSignal): Promise<T> {
  return (await answered("POST", path, { body: file, type: "application/octet-stream" }, signal)).json() as Promise<T>;
}

export async function postPacked<T>(path: string, body: unknown, signal?: AbortSignal): Promise<Packed<T>> {
  return unpacked<T>(await (await answered("POST", path, json(body), signal)).arrayBuffer());
}

/** The JSON and the arrays of a packed answer: see `packed` in the server's answers.py. */
export function unpacked<T>(content: ArrayBuffer): Packed<T> {
  const length = new DataView(content).getUint32(0, true);
  const about = JSON.parse(new TextDecoder().decode(new Uint8Array(content, 4, length))) as T;
  return {
    about,
    parts: (lengths) => {
      let begin = 4 + length;
      return lengths.map((size) => {
        const part = new Uint8Array(content, begin, size);
        begin += Math.ceil(size / 8) * 8;
        return part;
      });
    },
  };
}

interface Content {
  body: BodyInit;
  type: string;
}

function json(body: unknown): Content {
  return { body: JSON.stringify(body), type: "application/json" };
}

/** The answer of the server, where it is good. Raises ApiError, ServerLost, or AbortError where `signal` came. */
export async function answered(method: string, path: string, content?: Content, signal?: AbortSignal) {
  const headers: Record<string, string> = { "x-page": page, "x-language": language.peek() };
  if (content) headers["content-type"] = content.type;
  let response: Response;
  try {
    response = await fetch(`/api${path}`, {
      method,
      headers,
      ...(content ? { body: content.body } : {}),
      ...(signal ? { signal } : {}),
    });
  } catch (error) {
    if (signal?.aborted) throw error;
    throw new ServerLost();
  }
  if (!response.ok) throw await errorOf(response);
  return response;
}

async function errorOf(response: Response): Promise<ApiError> {
  try {
    const { error } = (await response.json()) as { error: { given: string; allowed: string; do: string } };
    return new ApiError(response.status, error.given, error.allowed, error.do);
  } catch {
    return new ApiError(response.status, `${response.status} ${response.statusText}`.trim());
  }
}
