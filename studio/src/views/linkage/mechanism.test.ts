import { beforeAll, describe, expect, it } from "vitest";
import { loadTexts } from "../../text";
import { choicesOf, entryAt, hintOf, lackingKeys } from "./declaration";
import { entryLabel, entryOf, leaves } from "./entries";
import { STILL, vec } from "./geometry";
import {
  addBody,
  addGears,
  addPivot,
  addSlide,
  addTracer,
  apply,
  copyBodies,
  type MechanismData,
  removeAll,
  toggleDrive,
} from "./mechanism";
import { renameBody, renameJoint, renamePoint } from "./renaming";

function drawn(): MechanismData {
  const data: MechanismData = { name: "drawn" };
  addBody(data, [{ at: vec(0, 0) }, { at: vec(0.04, 0.02) }], {});
  addBody(data, [{ at: vec(0.04, 0.02), body: "link1", point: "B" }, { at: vec(0.1, 0.1) }], {});
  addBody(data, [{ at: vec(0.1, 0.1), body: "link2", point: "C" }, { at: vec(0.12, 0) }], {});
  addPivot(data, { at: vec(0, 0), body: "link1", point: "A" }, {});
  addPivot(data, { at: vec(0.12, 0), body: "link3", point: "D" }, {});
  toggleDrive(data, "A");
  return data;
}

describe("edits of a mechanism", () => {
  beforeAll(loadTexts);

  it("draws a four-bar of three links, two pins, two pivots and a drive", () => {
    const data = drawn();
    expect(Object.keys(data.joints ?? {})).toEqual(["B", "C", "A", "D"]);
    expect(data.joints?.["B"]?.pin).toEqual(["link1", "link2"]);
    expect(data.joints?.["A"]?.pin).toEqual(["link1", "ground"]);
    expect(data.inputs).toEqual({ A: "link1" });
    expect(data.bodies?.["link1"]?.points).toEqual({ A: [0, 0], B: ["40mm", "20mm"] });
    expect(data.bodies?.["ground"]?.points?.["D"]).toEqual(["120mm", 0]);
  });

  it("joins a third link to a pin, and takes points in the frame of a body that moved", () => {
    const data = drawn();
    addBody(data, [{ at: vec(0.1, 0.1), joint: "C" }, { at: vec(0.2, 0.1) }], {});
    expect(data.joints?.["C"]?.pin).toEqual(["link2", "link3", "link4"]);
    const name = addTracer(data, "link2", vec(0.05, 0.05), { link2: { x: 0.01, y: 0, angle: Math.PI / 2 } });
    expect(data.bodies?.["link2"]?.points?.[name]).toEqual(["50mm", "-40mm"]);
  });

  it("makes a block with a guide on the ground or on a link", () => {
    const data = drawn();
    const slide = addSlide(data, { at: vec(0.1, 0.1), joint: "C" }, "ground", Math.PI / 4, {});
    expect(data.joints?.[slide]).toEqual({ slide: ["block1", "ground"], along: "45deg" });
    expect(data.joints?.["C"]?.pin).toContain("block1");
    expect(data.bodies?.["block1"]).toEqual({});
    toggleDrive(data, slide);
    expect(data.inputs?.[slide]).toBe("block1");
    toggleDrive(data, slide);
    expect(data.inputs?.[slide]).toBeUndefined();
  });

  it("couples two wheels on the ground, and refuses wheels without a carrier", () => {
    const data = drawn();
    const poses = { link1: { x: 0, y: 0, angle: 0.5 }, link3: STILL };
    expect(addGears(data, "A", "D", poses)).toBe("gears1");
    const gears = (data["couplings"] as Record<string, Record<string, unknown>>)["gears1"];
    expect(gears?.["gears"]).toEqual(["link1.A", "link3.D"]);
    expect(gears?.["first_at"]).toBe("28.64789deg");
    expect(addGears(data, "A", "C", poses)).toBeUndefined();
  });

  it("removes what refers to a body that is gone", () => {
    const data = drawn();
    data["loads"] = { push: { force: "1N", on: "link3.C" }, pull: { force: "1N", on: "link2.C" } };
    data["paths"] = ["link3.C"];
    data.branches = { C: 1 };
    removeAll(data, { bodies: ["link3", "ground"] });
    expect(Object.keys(data.bodies ?? {})).toEqual(["ground", "link1", "link2"]);
    expect(Object.keys(data.joints ?? {})).toEqual(["B", "A"]);
    expect(data["loads"]).toEqual({ pull: { force: "1N", on: "link2.C" } });
    expect(data["paths"]).toBeUndefined();
    expect(data.branches).toBeUndefined();
    expect(data.bodies?.["ground"]?.points).toEqual({ A: [0, 0] });
    removeAll(data, { joints: ["A"] });
    expect(data.inputs).toEqual({});
  });

  it("copies bodies with the joints among them", () => {
    const data = drawn();
    const corners = {
      link1: { A: vec(0, 0), B: vec(0.04, 0.02) },
      link2: { B: vec(0.04, 0.02), C: vec(0.1, 0.1) },
    };
    const made = copyBodies(data, ["ground", "link1", "link2"], corners, (at) => vec(-at.x, at.y));
    expect(made).toHaveLength(2);
    const joints = Object.values(data.joints ?? {}).filter((joint) => joint.pin?.every((body) => made.includes(body)));
    expect(joints).toHaveLength(1);
    expect(Object.values(data.bodies?.[made[0] ?? ""]?.points ?? {})[1]).toEqual(["-40mm", "20mm"]);
  });

  it("renames a body everywhere, and refuses a name that is taken", () => {
    const data = drawn();
    data["motions"] = { link1: "60rpm" };
    expect(renameBody(data, "link1", "crank")).toBe(true);
    expect(data.joints?.["A"]?.pin).toEqual(["crank", "ground"]);
    expect(data.inputs).toEqual({ A: "crank" });
    expect(data["motions"]).toEqual({ crank: "60rpm" });
    expect(Object.keys(data.bodies ?? {})[1]).toBe("crank");
    expect(renameBody(data, "crank", "link2")).toBe(false);
    expect(renameBody(data, "ground", "base")).toBe(false);
  });

  it("sets entries by their keys", () => {
    const data = drawn();
    apply(data, [
      { path: ["bodies", "link1", "points", "B"], value: ["41mm", 0] },
      { path: ["branches", "C"], value: -1 },
      { path: ["bodies", "link2", "points", "C", "1"], value: "7mm" },
    ]);
    expect(data.bodies?.["link1"]?.points?.["B"]).toEqual(["41mm", 0]);
    expect(data.branches).toEqual({ C: -1 });
    expect(data.bodies?.["link2"]?.points?.["C"]).toEqual(["100mm", "7mm"]);
  });

  it("shows every number of a table as a field", () => {
    const table = { points: { P: { radius: "8mm", angle: "35deg" }, A: [0, "2mm"] }, mass: "1kg" };
    expect(leaves(table).map((leaf) => [entryLabel(leaf.path), leaf.value])).toEqual([
      ["P radius", "8mm"],
      ["P angle", "35deg"],
      ["A x", "0"],
      ["A y", "2mm"],
      ["mass", "1kg"],
    ]);
    const loads = {
      force1: { force: ["3N", "4N"], on: "link3.E" },
      spring1: { between: ["ground.A", "link2.B"] },
      twist: { torsion: ["ground", "link1"] },
    }; // biome-ignore format: one table
    expect(leaves(loads).map((leaf) => entryLabel(leaf.path))).toEqual([
      ...["force1 force x", "force1 force y", "force1 on"],
      ...["spring1 between point 1", "spring1 between point 2"],
      ...["twist torsion body 1", "twist torsion body 2"],
    ]);
    expect([entryOf("2"), entryOf("2mm"), entryOf("2*r"), entryOf("true")]).toEqual([2, "2mm", "2*r", true]);
  });
});

describe("new names", () => {
  const data = (): MechanismData => ({
    bodies: {
      ground: { points: { A: [0, 0] } },
      crank: { points: { A: [0, 0], B: ["60mm", 0], P: { offset: [0, "9mm"], from: "B" } }, centre: "B" },
      rod: { length: "90mm", between: ["B", "C"] },
    },
    joints: { A: { pin: ["ground", "crank"] }, B: { pin: ["crank", "rod"] } },
    inputs: { A: "crank" },
    branches: { B: 1 },
    loads: { pull: { force: "1N", on: "rod.B" } },
    paths: ["crank.P"],
    transmission: ["B"],
  });

  it("of a joint reach its points, branches, loads and everything else that names it", () => {
    const own = data();
    expect(renameJoint(own, "B", "crank pin")).toBe(true);
    expect(own.joints).toEqual({ A: { pin: ["ground", "crank"] }, "crank pin": { pin: ["crank", "rod"] } });
    expect(own.bodies?.["crank"]).toEqual({
      points: { A: [0, 0], "crank pin": ["60mm", 0], P: { offset: [0, "9mm"], from: "crank pin" } },
      centre: "crank pin",
    });
    expect(own.bodies?.["rod"]).toEqual({ length: "90mm", between: ["crank pin", "C"] });
    expect([own.branches, own["loads"], own["transmission"]]).toEqual([
      { "crank pin": 1 },
      { pull: { force: "1N", on: "rod.crank pin" } },
      ["crank pin"],
    ]);
    expect([renameJoint(own, "A", "P"), renameJoint(own, "A", " "), renameJoint(own, "A", "a.b")]).toEqual([
      false,
      false,
      false,
    ]);
  });

  it("of a point reach what is drawn of it", () => {
    const own = data();
    expect([renamePoint(own, "crank", "P", "B"), renamePoint(own, "crank", "P", "tip")]).toEqual([false, true]);
    expect(own["paths"]).toEqual(["crank.tip"]);
  });
});

describe("the declaration of the file", () => {
  const data: MechanismData = {
    units: "mm",
    bodies: { ground: { points: { S: [0, 0] } }, jib: { points: { S: [0, 0], T: ["1m", 0] }, mass: "2kg" } },
    joints: { S: { slide: ["jib", "ground"] } },
    cylinders: { lift: { between: ["ground.S", "jib.T"] } },
    loads: { pull: { force: "1N", on: "jib.T", while: { from: 0, to: "1mm", input: "jib" } } },
    redundant: ["S"],
  };

  it("gives each entry its meaning, unit and choices", () => {
    expect(hintOf(entryAt(data, ["joints", "S", "along"]))).toBe(
      "direction of the line in the guide's frame; default: 0 [rad]",
    );
    expect(hintOf(entryAt(data, ["bodies", "jib", "points", "T", "0"]))).toBe('like "60mm" [m]');
    expect(choicesOf(entryAt(data, ["joints", "S", "slide", "0"]), data)).toEqual(["ground", "jib"]);
    expect(choicesOf(entryAt(data, ["loads", "pull", "on"]), data)).toEqual(["ground.S", "jib.S", "jib.T"]);
    expect(choicesOf(entryAt(data, ["loads", "pull", "frame"]), data)).toEqual(["ground", "body"]);
    expect(choicesOf(entryAt(data, ["bodies", "jib", "mass"]), data)).toBeUndefined();
    const lacking = lackingKeys(entryAt(data, ["joints", "S"]), data.joints?.["S"] ?? {});
    expect(lacking).toEqual([
      ["along", "10deg"],
      ["turned", "10deg"],
    ]);
  });

  it("renames and removes in tables that no list of the editor names", () => {
    const own = structuredClone(data);
    renameBody(own, "jib", "boom");
    expect(own["cylinders"]).toEqual({ lift: { between: ["ground.S", "boom.T"] } });
    expect(own["loads"]).toEqual({
      pull: { force: "1N", on: "boom.T", while: { from: 0, to: "1mm", input: "boom" } },
    });
    renameJoint(own, "S", "way");
    expect(own["redundant"]).toEqual(["way"]);
    removeAll(own, { bodies: ["boom"] });
    expect([own["cylinders"], own["loads"], own["redundant"]]).toEqual([undefined, undefined, undefined]);
  });
});
