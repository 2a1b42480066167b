/** What is being written, kept while another view is shown. */
import { signal } from "@preact/signals";
import { onEvent } from "../../api/events";
import type { OutList, WrittenProduct } from "../../api/messages";
import { ApiError, get, post } from "../../api/request";
import { runWork } from "../../api/work";
import { openDocuments } from "../../project";

export interface Writing {
  share?: number;
  stage: string;
  abort?: AbortController;
  done?: WrittenProduct;
  problem?: string;
}

/** By file and product. */
export const writings = signal<Readonly<Record<string, Writing>>>({});
export const out = signal<OutList | null>(null);

export function keyOf(path: string, product: string): string {
  return `${product} ${path}`;
}

function note(key: string, writing: Writing): void {
  writings.value = { ...writings.peek(), [key]: writing };
}

/** Why the list of what was written cannot be read; "": it can. */
export const outProblem = signal("");

/** Reads the list of what was written again; the last one stays where it cannot be read. */
export async function refreshOut(): Promise<void> {
  try {
    out.value = await get<OutList>("/project/out");
    outProblem.value = "";
  } catch (error) {
    if (error instanceof ApiError) outProblem.value = error.message;
    out.value ??= { entries: [] };
  }
}

/** Keeps the list of what was written up to date; returns what ends it. */
export function followOut(): () => void {
  void refreshOut();
  return onEvent((event) => {
    if (event.type === "changed" || event.type === "hello") void refreshOut();
  });
}

/** Writes a product of a file, as it is now; ends where it is cancelled, or what it is a part of. */
export async function write(path: string, product: string, signal?: AbortSignal): Promise<void> {
  const key = keyOf(path, product);
  if (writings.peek()[key]?.abort !== undefined) return;
  const abort = new AbortController();
  signal?.addEventListener("abort", () => abort.abort(), { once: true });
  note(key, { stage: "", abort });
  try {
    await openDocuments
      .peek()
      .find((document) => document.path === path)
      ?.flush();
    const done = await runWork<WrittenProduct>(
      "/project/write",
      { path, product },
      { onStep: (stage, share) => note(key, { stage, share, abort }), signal: abort.signal },
    );
    note(key, { stage: "", done });
  } catch (error) {
    if (abort.signal.aborted) note(key, { stage: "" });
    else note(key, { stage: "", problem: error instanceof Error ? error.message : String(error) });
  }
  await refreshOut();
}

/** Deletes a file or folder of out/; returns the problem, "" for none. */
export async function removeWritten(path: string): Promise<string> {
  try {
    await post("/project/out/delete", { path });
    await refreshOut();
    return "";
  } catch (error) {
    return error instanceof ApiError ? error.message : "";
  }
}
