import { describe, expect, it } from "vitest";
import { documentKey } from "./keys";

function key(name: string, more: KeyboardEventInit = {}, target: EventTarget = document.body) {
  const event = new KeyboardEvent("keydown", { key: name, ctrlKey: true, ...more });
  Object.defineProperty(event, "target", { value: target });
  return documentKey(event);
}

describe("keys", () => {
  it("undo, redo and save, also with the command key", () => {
    expect([key("z"), key("Z", { shiftKey: true }), key("y"), key("s")]).toEqual(["undo", "redo", "redo", "save"]);
    expect(key("z", { ctrlKey: false, metaKey: true })).toBe("undo");
    expect([key("z", { ctrlKey: false }), key("z", { altKey: true }), key("x")]).toEqual([null, null, null]);
  });

  it("leave text fields their own undo, not sliders", () => {
    const input = document.createElement("input");
    expect([key("z", {}, input), key("s", {}, input), key("z", {}, document.createElement("textarea"))]).toEqual([
      null,
      "save",
      null,
    ]);
    input.type = "range";
    expect(key("z", {}, input)).toBe("undo");
  });
});
