import { expect, test } from "vitest";
import type { FormField } from "../../api/messages";
import { groupLabel, groupsOf, isSet, labelOf, nameIn } from "./form";

const NO = { words: "", changed: false, machine: "" };

function field(name: string, more: Partial<FormField> = {}): FormField {
  return {
    name,
    group: name.includes(".") ? name.slice(0, name.lastIndexOf(".")) : "",
    machine: "",
    kind: "quantity",
    default: 1,
    default_text: "1 m",
    shown_unit: "m",
    printed: "m",
    factor: 1,
    above: null,
    at_least: null,
    below: null,
    at_most: null,
    allowed: "",
    choices: [],
    doc: "",
    symbol: "",
    alias: "",
    ...more,
  };
}

const FIELDS = [
  field("swing", { symbol: "ψ", doc: "swing of the rocker" }),
  field("beat_force", { doc: "force at the fell", alias: "F" }),
  field("strength.material", { kind: "choice" }),
  field("shedding.law", { machine: "shedding", doc: "law of the cams" }),
];

test("the machine's own parameters by group, those of another machine when it is chosen", () => {
  const names = (machine: string) => groupsOf(FIELDS, {}, { ...NO, machine }).map((one) => one.name);
  expect(names("")).toEqual(["", "strength"]);
  expect(names("shedding")).toEqual(["shedding"]);
});

test("words are searched in name, symbol and meaning of all parameters", () => {
  const found = (words: string) =>
    groupsOf(FIELDS, {}, { ...NO, words }).flatMap((one) => one.fields.map((each) => each.name));
  expect(found("beat force")).toEqual(["beat_force"]);
  expect(found("ψ")).toEqual(["swing"]);
  expect(found("LAW cams")).toEqual(["shedding.law"]);
  expect(found("nothing")).toEqual([]);
});

test("only what is set, of every machine", () => {
  const settings = { F: "70N", "shedding.law": "cubic" };
  const groups = groupsOf(FIELDS, settings, { ...NO, changed: true });
  expect(groups.flatMap((one) => one.fields.map((each) => each.name))).toEqual(["beat_force", "shedding.law"]);
  expect(FIELDS.map((one) => isSet(one, settings))).toEqual([false, true, false, true]);
  expect(FIELDS.map((one) => nameIn(one, settings))).toEqual([undefined, "F", undefined, "shedding.law"]);
});

test("a name is shown in words without its group", () => {
  expect(FIELDS.map(labelOf)).toEqual(["swing", "beat force", "material", "law"]);
});

test("the group of a machine in the machine is shown with its path", () => {
  expect(groupLabel("weaver.side_grippers")).toBe("weaver › side grippers");
});
