import { signal } from "@preact/signals";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Document } from "../../project";
import { Editor } from "./editor";
import { vec } from "./geometry";
import { addBody, type MechanismData } from "./mechanism";
import { Pointer } from "./pointer";
import { Tools } from "./tools";

interface Sent {
  mechanism: MechanismData;
  drag?: { joint: string; x: number; y: number };
}

const sent: Sent[] = [];

/** A server that answers each request with its bodies, and a drag with a new length. */
function reply(request: Sent) {
  const bodies = Object.entries(request.mechanism.bodies ?? {}).map(([name, table]) => ({
    name,
    points: Object.fromEntries(
      Object.entries(table.points ?? {}).map(([point, at]) => [
        point,
        (at as string[]).map((one) => Number.parseFloat(one) / 1000),
      ]),
    ),
    solved: false,
  }));
  const joints = Object.entries(request.mechanism.joints ?? {}).map(([name, { pin }]) => ({
    name,
    file_joint: name,
    kind: "pin",
    bodies: pin,
    along: 0,
    turned: 0,
  }));
  const changes = request.drag ? [{ path: ["bodies", "crank", "length"], value: `${request.drag.x}m` }] : [];
  const structure = { degrees_of_freedom: 0, driven: 0, loops: 0, groups: [], left: [], loose: [], missing: null };
  return {
    name: "",
    bodies,
    joints,
    couplings: [],
    inputs: [],
    structure,
    poses: {},
    motion: null,
    no_motion: null,
    changes,
    values: {},
  };
}

function documentOf(data: MechanismData): Document<MechanismData> {
  const own = signal<MechanismData | null>(data);
  const update = (change: (copy: MechanismData) => MechanismData | undefined) => {
    const copy = structuredClone(own.peek() as MechanismData);
    own.value = change(copy) ?? copy;
    return true;
  };
  return { data: own, update } as unknown as Document<MechanismData>;
}

const settled = () => new Promise((resolve) => setTimeout(resolve, 5));

beforeEach(() => {
  sent.length = 0;
  vi.stubGlobal("fetch", async (_: string, options: { body: string }) => {
    const request = JSON.parse(options.body) as Sent;
    sent.push(request);
    return new Response(JSON.stringify(reply(request)));
  });
});
afterEach(() => vi.unstubAllGlobals());

describe("the linkage editor", () => {
  it("drags a joint from the state at its beginning, and changes the document once", async () => {
    const document = documentOf({ bodies: { ground: {}, crank: { length: "1m" } }, joints: {} });
    const editor = new Editor(document);
    await settled();
    editor.beginDrag("A");
    for (const x of [2, 3, 4]) editor.drag(vec(x, 0));
    editor.endDrag();
    await settled();
    await settled();
    expect(sent.filter((one) => one.drag).at(-1)?.drag).toEqual({ joint: "A", x: 4, y: 0 });
    expect(sent.filter((one) => one.drag).every((one) => one.mechanism.bodies?.["crank"]?.length === "1m")).toBe(true);
    expect(document.data.value?.bodies?.["crank"]?.length).toBe("4m");
    expect(editor.isDragging.value).toBe(false);
    editor.dispose();
  });

  it("changes nothing where a drag is given up", async () => {
    const document = documentOf({ bodies: { ground: {}, crank: { length: "1m" } }, joints: {} });
    const editor = new Editor(document);
    await settled();
    editor.beginDrag("A");
    editor.drag(vec(2, 0));
    editor.cancelDrag();
    await settled();
    expect(document.data.value?.bodies?.["crank"]?.length).toBe("1m");
    editor.dispose();
  });

  it("draws links by clicks and by keys, the second joined to the first", async () => {
    const document = documentOf({ bodies: { ground: {} }, joints: {} });
    const editor = new Editor(document);
    const tools = new Tools(editor);
    const pointer = new Pointer(editor, tools);
    await settled();
    tools.choose("link");
    const press = (x: number, y: number) => {
      const at = pointer.screen(vec(x, y));
      pointer.down(1, at, false, false, 0);
      pointer.up(1, at, false);
    };
    press(0, 0);
    press(0.1, 0);
    await settled();
    press(0.1, 0);
    press(0.1, 0.1);
    await settled();
    expect(Object.values(document.data.value?.joints ?? {})).toEqual([{ pin: ["link1", "link2"] }]);
    pointer.key("ArrowRight", false);
    pointer.key("Enter", false);
    pointer.key("ArrowUp", true);
    pointer.key("Enter", false);
    expect(Object.keys(document.data.value?.bodies ?? {})).toEqual(["ground", "link1", "link2", "link3"]);
    pointer.key("Escape", false);
    expect(editor.tool.value).toBe("select");
    editor.select({ bodies: ["link3"] });
    pointer.key("Delete", false);
    expect(Object.keys(document.data.value?.bodies ?? {})).toEqual(["ground", "link1", "link2"]);
    editor.dispose();
  });

  it("joins the free end of a link to what it is dropped on", async () => {
    const data: MechanismData = { bodies: { ground: {} }, joints: {} };
    addBody(data, [{ at: vec(0, 0) }, { at: vec(0.05, 0) }], {});
    addBody(data, [{ at: vec(0.08, 0.08) }, { at: vec(0.02, 0.08) }], {});
    const document = documentOf(data);
    const editor = new Editor(document);
    const pointer = new Pointer(editor, new Tools(editor));
    await settled();
    pointer.down(1, pointer.screen(vec(0.08, 0.08)), false, false, 0);
    pointer.move(1, pointer.screen(vec(0.06, 0.02)), false);
    pointer.move(1, pointer.screen(vec(0.05, 0.001)), false);
    pointer.up(1, pointer.screen(vec(0.05, 0.001)), false);
    expect(Object.values(document.data.value?.joints ?? {})).toEqual([{ pin: ["link1", "link2"] }]);
    expect(document.data.value?.bodies?.["link2"]?.points?.["C"]).toBeUndefined();
    editor.dispose();
  });
});
