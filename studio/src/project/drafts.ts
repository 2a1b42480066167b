/** Edits that are not saved yet, kept by the browser: a lost server or a closed page loses none. */
import type { State } from "./api";

export interface Draft extends State {
  /** Digest of the state that was changed. */
  base: string;
}

export interface Drafts {
  get(path: string): Draft | null;
  set(path: string, draft: Draft): void;
  remove(path: string): void;
}

/** Drafts of a project in the browser's storage; where it is full or forbidden, edits stay in memory alone. */
export function storedDrafts(project: string, storage: Storage | null = browserStorage()): Drafts {
  const key = (path: string) => `ilmek draft ${project} ${path}`;
  return {
    get(path) {
      try {
        const found: unknown = JSON.parse(storage?.getItem(key(path)) ?? "null");
        const isDraft =
          typeof found === "object" && found !== null && "base" in found && typeof found.base === "string";
        return isDraft ? (found as Draft) : null;
      } catch {
        return null;
      }
    },
    set(path, draft) {
      try {
        storage?.setItem(key(path), JSON.stringify(draft));
      } catch {
        // full: the edit is still in memory, and is sent when the server is back
      }
    },
    remove(path) {
      try {
        storage?.removeItem(key(path));
      } catch {
        // forbidden
      }
    },
  };
}

function browserStorage(): Storage | null {
  try {
    return localStorage;
  } catch {
    return null;
  }
}
