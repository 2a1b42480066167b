import { describe, expect, it } from "vitest";
import { mapOf, mapWith } from "./assignment";

describe("yarns by hand", () => {
  it("are read whatever the case of a colour", () => {
    expect(mapOf({ map: { "#6C9136": "dark green", "#ffffff": 7 } })).toEqual({ "#6c9136": "dark green" });
    for (const map of [undefined, null, [], "ivory"]) expect(mapOf({ map })).toEqual({});
    expect(mapOf(null)).toEqual({});
  });

  it("are given, changed and taken back one by one", () => {
    const green = mapWith({}, "#6C9136", "dark green");
    expect(green).toEqual({ "#6c9136": "dark green" });
    const both = mapWith({ map: green }, "#000000", "ivory");
    expect(mapWith({ map: both }, "#6c9136", "sage green")).toEqual({ "#6c9136": "sage green", "#000000": "ivory" });
    expect(mapWith({ map: both }, "#000000", "")).toEqual(green);
    expect(mapWith({ map: green }, "#6c9136", "")).toBeNull();
  });
});
