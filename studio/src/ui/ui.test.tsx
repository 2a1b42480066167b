import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Boundary } from "../app/boundary";
import { address, parseRoute } from "../app/routes";
import { NumberField, QuantityField, Segments, Slider, Table, Tabs, toast } from ".";
import { Toasts } from "./toast";

let page: HTMLElement;
beforeEach(() => {
  page = document.createElement("div");
  document.body.append(page);
});
afterEach(() => {
  render(null, page);
  page.remove();
});

function show(content: preact.ComponentChild): void {
  act(() => render(content, page));
}

function type(input: HTMLInputElement, text: string): void {
  act(() => {
    input.value = text;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  });
}

function one<T extends Element>(selector: string): T {
  const found = page.querySelector<T>(selector);
  if (found === null) throw new Error(`no ${selector}`);
  return found;
}

describe("a field of a quantity", () => {
  const bounds = { at_least: 0.001, at_most: 0.1 };
  it("gives what can be read and is allowed, with its unit", () => {
    const given = vi.fn();
    show(<QuantityField label="crank" value="60mm" unit="mm" bounds={bounds} onChange={given} />);
    type(one("input"), "5 cm");
    expect(given).toHaveBeenLastCalledWith("5cm", 0.05);
    type(one("input"), "70");
    expect(given).toHaveBeenLastCalledWith("70mm", 0.07);
  });
  it("reports the rest in words that are tied to the input, and keeps what was typed", () => {
    const given = vi.fn();
    show(<QuantityField label="crank" value="60mm" unit="mm" bounds={bounds} onChange={given} />);
    const input = one<HTMLInputElement>("input");
    for (const text of ["5 m", "wide", "3 kg", ""]) {
      type(input, text);
      expect(input.getAttribute("aria-invalid")).toBe("true");
      const error = document.getElementById(input.getAttribute("aria-describedby")?.split(" ")[0] ?? "");
      expect(error?.textContent).toBeTruthy();
      expect(input.value).toBe(text);
    }
    expect(given).not.toHaveBeenCalled();
  });
  it("may be empty where it is optional", () => {
    const given = vi.fn();
    show(<QuantityField label="crank" value="60mm" unit="mm" optional placeholder="by synthesis" onChange={given} />);
    type(one("input"), "");
    expect(given).toHaveBeenLastCalledWith("", null);
  });
  it("follows a new value from outside", () => {
    show(<NumberField label="heads" value={3} onChange={() => {}} />);
    show(<NumberField label="heads" value={4} onChange={() => {}} />);
    expect(one<HTMLInputElement>("input").value).toBe("4");
  });
  it("has a slider within its range", () => {
    const given = vi.fn();
    show(<QuantityField label="crank" value="60mm" unit="mm" range={[0, 0.1]} onChange={given} />);
    type(one("input[type=range]"), "0.05");
    expect(given).toHaveBeenLastCalledWith("50mm", 0.05);
    expect(one("input[type=range]").getAttribute("aria-valuetext")).toBe("50 mm");
  });
});

describe("tabs", () => {
  it("go by arrow keys, and only the one shown is in the order of Tab", () => {
    const chosen = vi.fn();
    const tabs = ["a", "b", "c"].map((value) => ({ value, label: value }));
    show(
      <Tabs label="parts" value="a" tabs={tabs} onChange={chosen}>
        <p>panel</p>
      </Tabs>,
    );
    const list = one<HTMLElement>("[role=tablist]");
    expect([...list.children].map((tab) => (tab as HTMLElement).tabIndex)).toEqual([0, -1, -1]);
    for (const [key, to] of [
      ["ArrowRight", "b"],
      ["ArrowLeft", "c"],
      ["End", "c"],
    ] as const) {
      act(() => {
        list.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
      });
      expect(chosen).toHaveBeenLastCalledWith(to);
    }
  });
});

describe("choices and sliders", () => {
  it("have names", () => {
    show(<Segments label="side" value="a" choices={[{ value: "a", label: "left" }]} onChange={() => {}} />);
    expect(one("legend").textContent).toBe("side");
    show(<Slider label="speed" value={1} min={0} max={2} text="1 rpm" onInput={() => {}} />);
    expect(one("label").getAttribute("for")).toBe(one("input").id);
  });
});

describe("a table", () => {
  it("shows SI numbers in units, and sorts by a heading, up, down and back", () => {
    const columns = [{ heading: "link" }, { heading: "length", unit: "mm" }];
    show(
      <Table
        label="links"
        columns={columns}
        rows={[
          ["a", 0.3],
          ["b", 0.1],
          ["c", null],
        ]}
      />,
    );
    const texts = () => [...page.querySelectorAll("tbody tr")].map((row) => row.textContent);
    expect(one("thead").textContent).toBe("linklength [mm]");
    expect(texts()).toEqual(["a300", "b100", "c–"]);
    const sort = () => act(() => (page.querySelectorAll<HTMLElement>(".ui-sort")[1] as HTMLElement).click());
    sort();
    expect(texts().slice(-2)).toEqual(["b100", "a300"]);
    sort();
    expect(texts()[0]).toBe("a300");
  });
});

describe("an error of a view", () => {
  it("is shown in its place, and tried again", () => {
    let broken = true;
    const View = () => {
      if (broken) throw new Error("no such crank");
      return <p>whole</p>;
    };
    show(
      <Boundary>
        <View />
      </Boundary>,
    );
    expect(one("[role=alert]").textContent).toContain("no such crank");
    broken = false;
    act(() => one<HTMLElement>("button").click());
    expect(page.textContent).toBe("whole");
  });
});

describe("addresses", () => {
  it("name a view and what it shows; unknown ones are the carpet", () => {
    expect(parseRoute("#linkage/four%20bar")).toEqual({ view: "linkage", name: "four bar" });
    expect(parseRoute("#nowhere")).toEqual({ view: "carpet", name: "" });
    expect(parseRoute("#files/%E0%A4%A")).toEqual({ view: "files", name: "%E0%A4%A" });
    expect(parseRoute(address("linkage", "a/b ç"))).toEqual({ view: "linkage", name: "a/b ç" });
  });
});

describe("a message", () => {
  it("is in one region, stays under the pointer, and goes by itself only where it is not urgent", () => {
    vi.useFakeTimers();
    const point = (type: string) =>
      act(() => {
        one(".ui-toast.good").dispatchEvent(new Event(type));
      });
    const wait = () =>
      act(() => {
        vi.advanceTimersByTime(60_000);
      });
    show(<Toasts />);
    act(() => {
      toast("Written", "good");
      toast("Not written", "bad");
    });
    expect(one("[role=status]").textContent).toBe("Written");
    expect(one("[role=alert]").textContent).toBe("Not written");
    point("pointerenter");
    wait();
    expect(page.querySelectorAll(".ui-toast").length).toBe(2);
    point("pointerleave");
    wait();
    expect(page.querySelectorAll(".ui-toast").length).toBe(1);
    vi.useRealTimers();
  });
});
