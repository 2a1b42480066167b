/** Changes of the project's files by the view: what went wrong, and what was deleted and can be brought back. */
import { signal } from "@preact/signals";
import { deleteFile, freePath, newFile, renameFile, undoDelete } from "../../project";
import { FOLDERS, type Kind, renamed, STARTS, stemOf } from "./names";

/** Why the last change failed; "": it did not. */
export const problem = signal("");

/** Files that were deleted since the page was opened, the newest first. */
export const deleted = signal<readonly string[]>([]);

/** Does a change; a failure is kept in `problem`. Returns whether it was done. */
export async function attempt(change: () => Promise<void>): Promise<boolean> {
  problem.value = "";
  try {
    await change();
    return true;
  } catch (error) {
    problem.value = error instanceof Error ? error.message : String(error);
    return false;
  }
}

/** A new file of a kind with a first content; its path, "" where it failed. */
export async function create(kind: Kind): Promise<string> {
  const path = freePath(FOLDERS[kind], kind === "carpet" ? "carpet" : "new");
  return (await attempt(() => newFile(path, { text: STARTS[kind] }))) ? path : "";
}

/** A copy of a file beside it; its path, "" where it failed. */
export async function duplicate(kind: Kind, path: string): Promise<string> {
  const copy = freePath(FOLDERS[kind], `${stemOf(path)}-copy`);
  return (await attempt(() => newFile(copy, { source: path }))) ? copy : "";
}

/** Gives a file another name in its folder; the path it has then. */
export async function giveName(path: string, stem: string): Promise<string> {
  const to = renamed(path, stem);
  if (stem.trim() === "" || to === path) return path;
  return (await attempt(() => renameFile(path, to))) ? to : path;
}

/** Deletes a file; `bringBack` undoes it. Returns whether it was done. */
export async function remove(path: string): Promise<boolean> {
  const done = await attempt(() => deleteFile(path));
  if (done) deleted.value = [path, ...deleted.peek().filter((one) => one !== path)];
  return done;
}

/** Brings a deleted file back. Returns whether it was done. */
export async function bringBack(path: string): Promise<boolean> {
  const done = await attempt(() => undoDelete(path));
  if (done) deleted.value = deleted.peek().filter((one) => one !== path);
  return done;
}
