import { expect, test } from "vitest";
import { change, changesTo, flat, type MachineFile } from "./settings";

test("nested tables and dotted names are one list of settings", () => {
  const settings = { swing: "30deg", "start.run_up": "50deg", strength: { material: "POM", deep: { er: "1" } } };
  expect(flat(settings)).toEqual({
    swing: "30deg",
    "start.run_up": "50deg",
    "strength.material": "POM",
    "strength.deep.er": "1",
  });
  expect(flat(undefined)).toEqual({});
});

test("a change is made where the file has the setting", () => {
  const file: MachineFile = {
    machine: "beat-up",
    settings: { strength: { material: "POM" }, "start.run_up": "50deg" },
  };
  change(file, {
    "strength.material": "grey cast iron",
    "start.run_up": "60deg",
    "travel.reach": "20mm",
    swing: "31deg",
  });
  expect(file.settings).toEqual({
    strength: { material: "grey cast iron" },
    "start.run_up": "60deg",
    "travel.reach": "20mm",
    swing: "31deg",
  });
  change(file, { "strength.material": undefined, swing: undefined });
  expect(flat(file.settings)).toEqual({ "start.run_up": "60deg", "travel.reach": "20mm" });
});

test("changes from one state to another take out what the other has not", () => {
  const file: MachineFile = { machine: "cam", settings: { lift: "20mm", law: "cubic" } };
  change(file, changesTo(flat(file.settings), { lift: "25mm", rise: "80deg" }));
  expect(flat(file.settings)).toEqual({ lift: "25mm", rise: "80deg" });
});
