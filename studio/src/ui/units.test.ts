import { describe, expect, it } from "vitest";
import { formatQuantity, outside, parseUnit, quantityText, readQuantity, shownUnit } from "./units";

function si(text: string, unit: string): number | string {
  const read = readQuantity(text, unit);
  return "si" in read ? read.si : read.error;
}

describe("quantities", () => {
  it("reads what the command line reads", () => {
    expect(si("60mm", "m")).toBeCloseTo(0.06, 12);
    expect(si(" 6 cm ", "mm")).toBeCloseTo(0.06, 12);
    expect(si("90deg", "rad")).toBeCloseTo(Math.PI / 2, 12);
    expect(si("40/dm", "1/dm")).toBeCloseTo(400, 9);
    expect(si("1.2e3 kg/m³", "kg/m^3")).toBe(1200);
    expect(si("2 N·m", "Nm")).toBe(2);
    expect(si("7.5 m/s²", "m/s^2")).toBe(7.5);
  });
  it("takes a number alone in the unit of the field, and writes the unit behind it", () => {
    const read = readQuantity("60", "mm");
    expect(read).toEqual({ si: 0.06, text: "60mm" });
    expect(readQuantity("40", "1/dm")).toMatchObject({ text: "40/dm" });
  });
  it("takes a comma for a decimal point", () => {
    expect(si("0,5 m", "mm")).toBe(0.5);
  });
  it("names what is wrong", () => {
    expect(si("", "mm")).toBe("notQuantity");
    expect(si("wide", "mm")).toBe("notQuantity");
    expect(si("x", "")).toBe("notNumber");
    expect(si("3 furlong", "mm")).toBe("unknownUnit");
    expect(si("3 constructor", "mm")).toBe("unknownUnit");
    expect(si("3 kg", "mm")).toBe("wrongUnit");
    expect(si("1e99 m", "mm")).toBe("notQuantity");
  });
  it("knows no unit beyond the limits of the package", () => {
    expect(parseUnit("m^13")).toBeNull();
    expect(parseUnit("m".repeat(101))).toBeNull();
    expect(parseUnit("km^12")).toBeNull();
  });
});

describe("bounds", () => {
  it("are open or closed as declared", () => {
    expect(outside(0, { above: 0 })).toBe("small");
    expect(outside(0, { at_least: 0 })).toBeNull();
    expect(outside(1, { below: 1 })).toBe("large");
    expect(outside(1 + 1e-12, { at_most: 1 })).toBeNull();
    expect(outside(5, {})).toBeNull();
  });
});

describe("shown", () => {
  it("units as they are printed", () => {
    expect(["kg/m^3", "N*m", "deg", "m/s^2", "1", "1/dm", "rpm"].map(shownUnit)).toEqual([
      "kg/m³",
      "N·m",
      "°",
      "m/s²",
      "",
      "/dm",
      "rev/min",
    ]);
  });
  it("quantities with four digits, and texts that are read again", () => {
    expect(formatQuantity(0.0597375, "mm")).toBe("59.74 mm");
    expect(formatQuantity(-0.5, "deg")).toBe("−28.65°");
    expect(quantityText(0.0597375, "mm")).toBe("59.7375mm");
    expect(quantityText(400, "1/dm")).toBe("40/dm");
    expect(si(quantityText(0.0597375, "mm"), "mm")).toBeCloseTo(0.0597375, 12);
  });
});
