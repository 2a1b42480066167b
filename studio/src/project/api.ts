/** What the project's files need of the server. */
import type { FileContent, ProjectSummary, SavedFile } from "../api/messages";
import { ApiError, get, post, put, upload } from "../api/request";

export type { FileContent, FileError, FileSummary, PictureSummary, ProjectSummary, SavedFile } from "../api/messages";

/** A state to be saved: plain data, or the whole text. */
export interface State {
  data?: unknown;
  text?: string;
}

/** A state and where it goes; `aside`: into the file's history alone. */
export interface SavedState extends State {
  aside?: boolean;
}

export interface ProjectApi {
  project(checked: boolean): Promise<ProjectSummary>;
  read(path: string): Promise<FileContent>;
  save(path: string, base: string, state: SavedState): Promise<SavedFile>;
  undo(path: string): Promise<FileContent>;
  redo(path: string): Promise<FileContent>;
}

/** The path of a text file below /api. */
export function filePath(path: string): string {
  return `/project/files/${path.split("/").map(encodeURIComponent).join("/")}`;
}

/** The address of a picture, or of a file of out/, as it is. */
export function fileAddress(path: string): string {
  return `/files/${path.split("/").map(encodeURIComponent).join("/")}`;
}

export const serverApi: ProjectApi = {
  project: (checked) => get<ProjectSummary>(`/project?checked=${checked}`),
  read: (path) => get<FileContent>(filePath(path)),
  save: (path, base, state) => put<SavedFile>(filePath(path), { base, ...state }),
  undo: (path) => post<FileContent>("/project/undo", { path }),
  redo: (path) => post<FileContent>("/project/redo", { path }),
};

export { ApiError, post, upload };

/** What went wrong, in the server's words; "" for a server that does not answer. */
export function problemOf(error: unknown): string {
  return error instanceof ApiError ? error.message : "";
}
