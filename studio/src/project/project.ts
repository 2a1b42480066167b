/** The project: its files as the server lists them, and the documents that are open. */
import { computed, signal } from "@preact/signals";
import { type FileSummary, type PictureSummary, type ProjectSummary, post, problemOf, serverApi, upload } from "./api";
import { Document } from "./document";
import { type Drafts, storedDrafts } from "./drafts";

const summary = signal<ProjectSummary | null>(null);
const documents = new Map<string, Document<object>>();
const opened = signal<readonly Document<object>[]>([]);

/** The files of the project; null before they are read. */
export const project = computed(() => summary.value);

/** The documents that were opened, in the order of opening. */
export const openDocuments = computed(() => opened.value);

/** The document that the keys for undo, redo and save act on. */
export const activeDocument = signal<Document<object> | null>(null);

/** Time after the first list until the files are checked [ms]: the first view comes before. */
const CHECK_AFTER = 1500;

/** Why the project's files could not be listed; "": they could. A server that does not answer is no reason. */
export const projectProblem = signal("");

let reading: Promise<void> | null = null;

/**
 * Reads the list of files again; several calls while it is read are one. The first list comes without the errors of the
 * files, which follow: a check of all files takes longer than a page may.
 */
export function refreshProject(): Promise<void> {
  const first = summary.peek() === null;
  reading ??= serverApi
    .project(!first)
    .then(
      (found) => {
        summary.value = found;
        projectProblem.value = "";
      },
      (error: unknown) => {
        projectProblem.value = problemOf(error);
        throw error;
      },
    )
    .finally(() => {
      reading = null;
      if (first && summary.peek() !== null) setTimeout(() => void refreshProject().catch(() => undefined), CHECK_AFTER);
    });
  return reading;
}

/** The text files of a kind: "carpet", "machine", "linkage", "synthesis", "cyclogram", "yarns". */
export function filesOf(kind: string): readonly FileSummary[] {
  return summary.value?.files.filter((file) => file.kind === kind) ?? [];
}

// The drafts of different projects are kept apart, so that their names wait for the project's.
const drafts: Drafts = {
  get: (path) => ownDrafts().get(path),
  set: (path, draft) => ownDrafts().set(path, draft),
  remove: (path) => ownDrafts().remove(path),
};

function ownDrafts(): Drafts {
  return storedDrafts(summary.peek()?.folder ?? "");
}

/** The document of a text file: the same one for every view that opens it. */
export function openDocument<T extends object = Record<string, unknown>>(path: string): Document<T> {
  const known = documents.get(path);
  if (known !== undefined) return known as Document<T>;
  const made = new Document<T>(path, { api: serverApi, drafts });
  documents.set(path, made as unknown as Document<object>);
  opened.value = [...documents.values()];
  const ready = summary.peek() === null ? refreshProject().catch(() => undefined) : Promise.resolve();
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

/** Renames a text file. Throws ApiError. */
export async function renameFile(path: string, to: string): Promise<void> {
  await documents.get(path)?.flush();
  await post("/project/rename", { path, new: to });
  forget(path);
  forget(to);
  await refreshProject();
}

/** Deletes a text file; `undoDelete` brings it back. Throws ApiError. */
export async function deleteFile(path: string): Promise<void> {
  await documents.get(path)?.flush();
  await post("/project/delete", { path });
  forget(path);
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
  const taken = new Set(summary.peek()?.files.map((file) => file.path));
  const path = (number: number) => `${folder === "" ? "" : `${folder}/`}${stem}${number > 1 ? `-${number}` : ""}.toml`;
  let number = 1;
  while (taken.has(path(number))) number += 1;
  return path(number);
}
