import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { ServerLost } from "../api/request";
import { ApiError, type FileContent, type ProjectApi, type SavedState } from "./api";
import { Document, PAUSE } from "./document";
import { type Drafts, storedDrafts } from "./drafts";

/** A server with one file whose text is the JSON of its data. */
class FakeServer implements ProjectApi {
  states: string[] = [JSON.stringify({ size: "60x90cm" })];
  at = 0;
  lost = false;
  refuse: ApiError | null = null;
  saves = 0;
  aside: unknown[] = [];

  get text(): string {
    return this.states[this.at] ?? "";
  }

  file(): FileContent {
    let data: Record<string, unknown> | null = null;
    try {
      data = JSON.parse(this.text);
    } catch {
      // as a file that is no TOML
    }
    const error =
      data?.["size"] === "huge"
        ? { given: "line 1: huge is no size", allowed: "", do: "", line: 1, unfinished: false }
        : null;
    const [undo, redo] = [this.at > 0, this.at + 1 < this.states.length];
    return { path: "carpet.toml", kind: "carpet", text: this.text, data, digest: `#${this.text}`, error, undo, redo };
  }

  /** Another program changes the file. */
  write(data: unknown): void {
    this.states.splice(this.at + 1, Number.POSITIVE_INFINITY, JSON.stringify(data));
    this.at += 1;
  }

  async project(): Promise<never> {
    throw new Error("not used");
  }

  async read(): Promise<FileContent> {
    this.check();
    return this.file();
  }

  async save(_path: string, base: string, state: SavedState): Promise<{ saved: boolean; file: FileContent }> {
    this.check();
    if (state.aside) {
      this.aside.push(state.data);
      return { saved: true, file: this.file() };
    }
    if (base !== `#${this.text}`) return { saved: false, file: this.file() };
    this.saves += 1;
    const text = state.text ?? JSON.stringify(state.data);
    if (text !== this.text) {
      this.states.splice(this.at + 1, Number.POSITIVE_INFINITY, text);
      this.at += 1;
    }
    return { saved: true, file: this.file() };
  }

  async undo(): Promise<FileContent> {
    this.check();
    this.at = Math.max(0, this.at - 1);
    return this.file();
  }

  async redo(): Promise<FileContent> {
    this.check();
    this.at = Math.min(this.states.length - 1, this.at + 1);
    return this.file();
  }

  private check(): void {
    if (this.lost) throw new ServerLost();
    if (this.refuse !== null) throw this.refuse;
  }
}

class FakeDrafts implements Drafts {
  kept = new Map<string, ReturnType<Drafts["get"]>>();
  get(path: string) {
    return this.kept.get(path) ?? null;
  }
  set(path: string, draft: NonNullable<ReturnType<Drafts["get"]>>) {
    this.kept.set(path, structuredClone(draft));
  }
  remove(path: string) {
    this.kept.delete(path);
  }
}

interface Carpet {
  size?: string;
  colours?: number;
}

let server: FakeServer;
let drafts: FakeDrafts;

async function opened(): Promise<Document<Carpet>> {
  const document = new Document<Carpet>("carpet.toml", { api: server, drafts });
  await document.load();
  return document;
}

beforeEach(() => {
  vi.useFakeTimers();
  server = new FakeServer();
  drafts = new FakeDrafts();
});
afterEach(() => {
  vi.useRealTimers();
});

describe("saving", () => {
  it("saves once, a pause after the last edit", async () => {
    const document = await opened();
    for (const colours of [2, 3, 4]) {
      document.update((data) => {
        data.colours = colours;
      });
      await vi.advanceTimersByTimeAsync(PAUSE / 2);
    }
    expect([server.saves, document.saved.value, document.data.value?.colours]).toEqual([0, "changed", 4]);
    await vi.advanceTimersByTimeAsync(PAUSE);
    expect([server.saves, document.saved.value]).toEqual([1, "saved"]);
    expect(JSON.parse(server.text)).toEqual({ size: "60x90cm", colours: 4 });
    expect(drafts.kept.size).toBe(0);
  });

  it("does not change data in place, and saves nothing for an edit that changes nothing", async () => {
    const document = await opened();
    const before = document.data.value;
    document.update((data) => ({ ...data }));
    expect(document.saved.value).toBe("saved");
    document.update(() => ({ size: "80x120cm" }));
    expect(before).toEqual({ size: "60x90cm" });
  });

  it("keeps an edit that comes while another one is sent", async () => {
    const document = await opened();
    document.update(() => ({ colours: 1 }));
    const save = server.save.bind(server);
    server.save = async (...given) => {
      await new Promise((resolve) => setTimeout(resolve, 50));
      return save(...given);
    };
    const sent = document.flush();
    await vi.advanceTimersByTimeAsync(20);
    expect(document.saved.value).toBe("saving");
    document.update(() => ({ colours: 2 }));
    await vi.advanceTimersByTimeAsync(40);
    await sent;
    expect([JSON.parse(server.text), document.data.value]).toEqual([{ colours: 1 }, { colours: 2 }]);
    await vi.advanceTimersByTimeAsync(PAUSE + 50);
    expect([server.saves, document.saved.value, JSON.parse(server.text)]).toEqual([2, "saved", { colours: 2 }]);
  });

  it("saves work in progress and reports its error", async () => {
    const document = await opened();
    document.setText('{"size":"huge"}');
    await document.flush();
    expect([document.saved.value, document.error.value?.line]).toEqual(["saved", 1]);
    document.setText("{");
    await document.flush();
    expect([document.saved.value, document.data.value, document.update(() => ({}))]).toEqual(["saved", null, false]);
  });

  it("reports what the server refuses, and tries again", async () => {
    const document = await opened();
    server.refuse = new ApiError(422, "the disc is full", "", "free some space");
    document.update(() => ({ colours: 1 }));
    await document.flush();
    expect([document.saved.value, document.problem.value]).toEqual(["refused", "the disc is full; free some space"]);
    server.refuse = null;
    await vi.advanceTimersByTimeAsync(1000);
    expect([document.saved.value, document.problem.value, server.saves]).toEqual(["saved", "", 1]);
  });
});

describe("undo and redo", () => {
  it("go through the states that were saved; what waits is saved before", async () => {
    const document = await opened();
    expect(document.canUndo.value).toBe(false);
    document.update(() => ({ colours: 1 }));
    await document.flush();
    document.update(() => ({ colours: 2 }));
    expect([document.canUndo.value, document.canRedo.value]).toEqual([true, false]);
    await document.undo();
    expect([document.data.value, document.canRedo.value]).toEqual([{ colours: 1 }, true]);
    await document.undo();
    expect([document.data.value, document.canUndo.value]).toEqual([{ size: "60x90cm" }, false]);
    await document.redo();
    expect([document.data.value, document.saved.value]).toEqual([{ colours: 1 }, "saved"]);
  });
});

describe("a lost server", () => {
  it("keeps edits in memory and in the browser, and sends them when it is back", async () => {
    const document = await opened();
    server.lost = true;
    document.update(() => ({ colours: 1 }));
    await document.flush();
    document.update(() => ({ colours: 2 }));
    expect([document.saved.value, drafts.kept.get("carpet.toml")?.data]).toEqual(["lost", { colours: 2 }]);
    await vi.advanceTimersByTimeAsync(5000);
    expect(server.saves).toBe(0);
    server.lost = false;
    await vi.advanceTimersByTimeAsync(8000);
    expect([document.saved.value, JSON.parse(server.text), drafts.kept.size]).toEqual(["saved", { colours: 2 }, 0]);
  });

  it("opens by itself when it is back", async () => {
    server.lost = true;
    const document = await opened();
    expect(document.saved.value).toBe("lost");
    server.lost = false;
    await vi.advanceTimersByTimeAsync(1000);
    expect([document.saved.value, document.data.value]).toEqual(["saved", { size: "60x90cm" }]);
  });

  it("an edit of a page that was closed is taken up", async () => {
    const first = await opened();
    server.lost = true;
    first.update(() => ({ colours: 3 }));
    await first.flush();
    vi.clearAllTimers();
    server.lost = false;
    const second = await opened();
    expect(second.data.value).toEqual({ colours: 3 });
    await vi.advanceTimersByTimeAsync(1);
    expect([second.saved.value, JSON.parse(server.text)]).toEqual(["saved", { colours: 3 }]);
  });
});

describe("another program or tab", () => {
  it("is followed where nothing waits here", async () => {
    const document = await opened();
    server.write({ size: "80x120cm" });
    await document.refresh();
    expect([document.data.value, document.saved.value]).toEqual([{ size: "80x120cm" }, "saved"]);
  });

  it("is not overwritten; mine is kept on request", async () => {
    const document = await opened();
    server.write({ size: "80x120cm" });
    document.update(() => ({ colours: 1 }));
    await document.flush();
    expect([document.saved.value, JSON.parse(server.text)]).toEqual(["conflict", { size: "80x120cm" }]);
    expect([document.conflict.value?.mine.data, document.conflict.value?.theirs.data]).toEqual([
      { colours: 1 },
      { size: "80x120cm" },
    ]);
    await document.resolve("mine");
    expect([document.saved.value, document.conflict.value, JSON.parse(server.text)]).toEqual([
      "saved",
      null,
      { colours: 1 },
    ]);
    await document.undo();
    expect(document.data.value).toEqual({ size: "80x120cm" });
  });

  it("theirs is taken on request, mine goes into the history, and nothing is sent before", async () => {
    const document = await opened();
    server.write({ size: "80x120cm" });
    document.update(() => ({ colours: 1 }));
    await document.flush();
    document.update(() => ({ colours: 2 }));
    await vi.advanceTimersByTimeAsync(9000);
    expect(document.saved.value).toBe("conflict");
    await document.resolve("theirs");
    expect([document.data.value, document.saved.value, server.saves]).toEqual([{ size: "80x120cm" }, "saved", 0]);
    expect([server.aside, document.conflict.value, drafts.kept.size]).toEqual([[{ colours: 2 }], null, 0]);
  });

  it("stays open where the server does not keep mine", async () => {
    const document = await opened();
    server.write({ size: "80x120cm" });
    document.update(() => ({ colours: 1 }));
    await document.flush();
    server.refuse = new ApiError(422, "no space");
    await document.resolve("theirs");
    expect([document.saved.value, document.problem.value, drafts.kept.size]).toEqual(["conflict", "no space", 1]);
    server.refuse = null;
    await document.resolve("theirs");
    expect([document.saved.value, document.problem.value]).toEqual(["saved", ""]);
  });

  it("is no conflict where both made the same change", async () => {
    const document = await opened();
    server.write({ colours: 1 });
    document.update(() => ({ colours: 1 }));
    await document.flush();
    expect([document.saved.value, document.conflict.value]).toEqual(["saved", null]);
  });

  it("a draft of an older state is a conflict when the page opens", async () => {
    drafts.set("carpet.toml", { base: "#older", data: { colours: 9 } });
    const document = await opened();
    expect([document.saved.value, document.data.value]).toEqual(["conflict", { colours: 9 }]);
    await document.resolve("theirs");
    expect(document.data.value).toEqual({ size: "60x90cm" });
  });

  it("a file that has gone keeps its data in the page, and undo brings it back", async () => {
    const document = await opened();
    const file = server.file();
    server.file = () => ({
      ...file,
      digest: "",
      data: null,
      text: "",
      undo: true,
      error: { given: "gone", allowed: "", do: "", line: null, unfinished: false },
    });
    await document.refresh();
    expect([document.saved.value, document.error.value?.given, document.canUndo.value, document.data.value]).toEqual([
      "missing",
      "gone",
      true,
      { size: "60x90cm" },
    ]);
    server.file = () => file;
    await document.undo();
    expect([document.saved.value, document.error.value ?? null]).toEqual(["saved", null]);
  });

  it("a document whose file is taken away saves what waits, and asks for nothing afterwards", async () => {
    const document = await opened();
    document.update(() => ({ colours: 1 }));
    const left = document.leave(async () => {
      expect(JSON.parse(server.text)).toEqual({ colours: 1 });
      server.refuse = new ApiError(422, "carpet.toml is not there");
    });
    await Promise.all([left, document.refresh()]);
    expect([document.saved.value, document.problem.value]).toEqual(["saved", ""]);
  });

  it("a document whose file could not be taken away goes on", async () => {
    const document = await opened();
    await expect(document.leave(() => Promise.reject(new ApiError(422, "taken")))).rejects.toThrow("taken");
    server.write({ size: "80x120cm" });
    await document.refresh();
    expect(document.data.value).toEqual({ size: "80x120cm" });
  });

  it("a file that is gone is reported", async () => {
    const document = await opened();
    server.refuse = new ApiError(422, "carpet.toml is not there");
    await document.refresh();
    expect([document.saved.value, document.problem.value]).toEqual(["missing", "carpet.toml is not there"]);
  });
});

describe("drafts in the browser's storage", () => {
  it("are kept apart by project, and survive what is broken or full", () => {
    const storage = window.localStorage;
    const [one, other] = [storedDrafts("/a", storage), storedDrafts("/b", storage)];
    one.set("carpet.toml", { base: "x", data: { colours: 1 } });
    expect([one.get("carpet.toml")?.data, other.get("carpet.toml")]).toEqual([{ colours: 1 }, null]);
    one.remove("carpet.toml");
    expect(one.get("carpet.toml")).toBeNull();
    storage.setItem("ilmek draft /a x", "{");
    expect(one.get("x")).toBeNull();
    expect(() => storedDrafts("/a", null).set("x", { base: "" })).not.toThrow();
  });
});
