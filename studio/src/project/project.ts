/** The project: its files as the server lists them, and the documents that are open. */
import { computed, signal } from "@preact/signals";
import { ready } from "../app/ready";
import {
  type FileError,
  type FileSummary,
  type PictureSummary,
  type ProjectSummary,
  post,
  problemOf,
  serverApi,
  upload,
} from "./api";
import { Document } from "./document";
import { type Drafts, storedDrafts } from "./drafts";

const list = signal<ProjectSummary | null>(null);
const errors = signal<ReadonlyMap<string, FileError>>(new Map());
const documents = new Map<string, Document<object>>();
const opened = signal<readonly Document<object>[]>([]);

/** The files of the project, each with its first error as far as it is known; null before they are read. */
export const project = computed(() => list.value && { ...list.value, files: list.value.files.map(withError) });

/** The documents that were opened, in the order of opening. */
export const openDocuments = computed(() => opened.value);

/** The document that the keys for undo, redo and save act on. */
export const activeDocument = signal<Document<object> | null>(null);

/** Why the project's files could not be listed; "": they could. A server that does not answer is no reason. */
export const projectProblem = signal("");

/** Time after the first list, and after a later one, until the files are checked [ms], after the view's first content. */
const [CHECK_FIRST, CHECK_LATER] = [1500, 300] as const;

let next: Promise<void> | null = null;
let last: Promise<void> = Promise.resolve();
let checkTimer: ReturnType<typeof setTimeout> | undefined;
let checking = false;

/**
 * Reads the list of files again; calls before that begins are one. The list comes at once, and the errors of the files
 * follow: a check of all files takes seconds.
 */
export function refreshProject(): Promise<void> {
  next ??= last.then(() => {
    next = null;
    return readList();
  });
  last = next.catch(() => undefined);
  return next;
}

async function readList(): Promise<void> {
  const pause = list.peek() === null ? CHECK_FIRST : CHECK_LATER;
  try {
    list.value = await serverApi.project(false);
    projectProblem.value = "";
    checkAfter(pause);
  } catch (error) {
    projectProblem.value = problemOf(error);
    throw error;
  }
}

function checkAfter(pause: number): void {
  clearTimeout(checkTimer);
  checkTimer = setTimeout(() => void checkFiles(), pause);
}

async function checkFiles(): Promise<void> {
  if (checking || !ready.peek()) return checkAfter(CHECK_FIRST);
  checking = true;
  try {
    const { files } = await serverApi.project(true);
    errors.value = new Map(files.flatMap((file) => (file.error ? [[stateOf(file), file.error]] : [])));
  } catch {
    // the list reports what is wrong; the next one is checked again
  } finally {
    checking = false;
  }
}

function withError(file: FileSummary): FileSummary {
  return { ...file, error: file.error ?? errors.value.get(stateOf(file)) ?? null };
}

function stateOf({ path, digest }: FileSummary): string {
  return `${digest} ${path}`;
}

/** The text files of a kind: "carpet", "machine", "linkage", "synthesis", "cyclogram", "yarns". */
export function filesOf(kind: string): readonly FileSummary[] {
  const found = project.value?.files.filter((file) => file.kind === kind) ?? [];
  return found.sort((a, b) => natural.compare(a.path, b.path));
}

/** Names as people order them: copy-2 before copy-10. */
const natural = new Intl.Collator(undefined, { numeric: true });

// The drafts of different projects are kept apart, so that their names wait for the project's.
const drafts: Drafts = {
  get: (path) => ownDrafts().get(path),
  set: (path, draft) => ownDrafts().set(path, draft),
  remove: (path) => ownDrafts().remove(path),
};

function ownDrafts(): Drafts {
  return storedDrafts(list.peek()?.folder ?? "");
}

/** The document of a text file: the same one for every view that opens it. */
export function openDocument<T extends object = Record<string, unknown>>(path: string): Document<T> {
  const known = documents.get(path);
  if (known !== undefined) return known as Document<T>;
  const made = new Document<T>(path, { api: serverApi, drafts });
  documents.set(path, made as unknown as Document<object>);
  opened.value = [...documents.values()];
  const ready = list.peek() === null ? refreshProject().catch(() => undefined) : Promise.resolve();
  void ready.then(() => made.load());
  return made;
}

/** Forgets the document of a file that was renamed or deleted. */
function forget(path: string): void {
  const known = documents.get(path);
  if (known === undefined) return;
  documents.delete(path);
  opened.value = [...documents.values()];
  if (activeDocument.peek() === known) activeDocument.value = null;
}

/** Follows files that another program or tab changed. */
export function filesChanged(paths: readonly string[]): void {
  for (const path of paths) void documents.get(path)?.refresh();
  void refreshProject().catch(() => undefined);
}

/** Follows whatever changed while the server was lost, and sends what waits. */
export function serverIsBack(): void {
  for (const document of documents.values()) {
    if (document.saved.peek() === "loading" || document.saved.peek() === "missing") void document.load();
    else void document.flush().then(() => document.refresh());
  }
  void refreshProject().catch(() => undefined);
}

/** Saves everything now. */
export function saveAll(): Promise<unknown> {
  return Promise.all([...documents.values()].map((document) => document.flush()));
}

/** Creates a text file, of a text, of plain data or as a copy of another one. Throws ApiError. */
export async function newFile(
  path: string,
  { data, ...content }: { text?: string; source?: string; data?: unknown } = {},
): Promise<void> {
  if (content.source !== undefined) await documents.get(content.source)?.flush();
  forget(path);
  await post("/project/new", { path, ...content });
  if (data !== undefined) await serverApi.save(path, (await serverApi.read(path)).digest, { data });
  await refreshProject();
}

/** Does what takes a file away; its document does not follow it any more. */
async function leave(path: string, work: () => Promise<void>): Promise<void> {
  await (documents.get(path)?.leave(work) ?? work());
  forget(path);
}

/** Renames a text file. Throws ApiError. */
export async function renameFile(path: string, to: string): Promise<void> {
  await leave(path, () => post("/project/rename", { path, new: to }));
  forget(to);
  await refreshProject();
}

/** Deletes a text file; `undoDelete` brings it back. Throws ApiError. */
export async function deleteFile(path: string): Promise<void> {
  await leave(path, () => post("/project/delete", { path }));
  await refreshProject();
}

/** Brings a deleted file back. Throws ApiError. */
export async function undoDelete(path: string): Promise<void> {
  await serverApi.undo(path);
  forget(path);
  await refreshProject();
}

/** Puts a picture into the project. Throws ApiError. */
export async function uploadPicture(file: File): Promise<PictureSummary> {
  const made = await upload<PictureSummary>(`/project/pictures?name=${encodeURIComponent(file.name)}`, file);
  await refreshProject();
  return made;
}

/** A name that no file of the folder has yet: "cam", "cam-2". */
export function freePath(folder: string, stem: string): string {
  const taken = new Set(list.peek()?.files.map((file) => file.path));
  const path = (number: number) => `${folder === "" ? "" : `${folder}/`}${stem}${number > 1 ? `-${number}` : ""}.toml`;
  let number = 1;
  while (taken.has(path(number))) number += 1;
  return path(number);
}
