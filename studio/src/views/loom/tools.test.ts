import { expect, it } from "vitest";
import type { Placed } from "./motion";
import { carriers, movers, type SceneAbout, type SceneBody } from "./scene";
import { toolOf } from "./tools";

const body = (parent: string, motor = "", follows: string[] = []): SceneBody => ({
  parent,
  joint: "pin",
  drive: "knot",
  motor,
  follows,
  passive: "",
});
const about = {
  tools: { opener: "warp opener", gripper: "left side gripper" },
  bodies: { rail: body(""), shaft: body("rail", "motor of a head"), lever: body("rail", "", ["shaft"]) },
} as unknown as SceneAbout;
const on = (name: string, parent: Placed | null = null) => ({ frame: { name }, parent }) as unknown as Placed;

it("a part is of the nearest tool that carries it", () => {
  const opener = on("opener", on("head"));
  expect(toolOf(about, on("finger", on("gripper", opener)))).toEqual({ name: "left side gripper", number: 1 });
  expect(toolOf(about, on("plates", opener))?.number).toBe(0);
  expect(toolOf(about, on("head"))).toBeUndefined();
});

it("a body is held down to the floor, and moved by what a motor moves", () => {
  expect(carriers(about, "lever").map((one) => one.parent)).toEqual(["rail", ""]);
  expect(movers(about, "lever")).toEqual(["shaft", "motor of a head"]);
  expect(movers(about, "rail")).toEqual([]);
});
