/** The tools of the drawing, and what is shown. */

import { useSignal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { t } from "../../text";
import { Button, formatQuantity, IconButton, QuantityField, Toggle, ToolBar } from "../../ui";
import { type Editor, type Shown, TOOLS, type Tool } from "./editor";
import { direction, distance, vec } from "./geometry";
import type { Tools } from "./tools";

/** Letter and icon of each tool. */
const LOOKS: Record<Tool, readonly [letter: string, shape: string]> = {
  select: ["V", "M6 4l12 9-5.500 1-3 5.500z"],
  link: ["L", "M6 18a2 2 0 1 0 0-.010M18 6a2 2 0 1 0 0-.010M7.500 16.500l9-9"],
  body: ["B", "M5 18h14L13 5zM5 18h.010M19 18h.010M13 5h.010"],
  pin: ["P", "M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6M3 12h6M15 12h6"],
  pivot: ["O", "M12 4a2 2 0 1 0 0 4 2 2 0 0 0 0-4M11 8l-5 9h12l-5-9M4 17h16M7 17l-3 3M13 17l-3 3M19 17l-3 3"],
  slide: ["S", "M3 16h18M7 8h10v8H7zM12 12h.010"],
  gears: ["G", "M8 5a5 5 0 1 0 0 10A5 5 0 0 0 8 5M17 11a4 4 0 1 0 0 8 4 4 0 0 0 0-8"],
  drive: ["D", "M5 15a8 8 0 1 1 13 2M18 17l4-3M18 17l-1-5"],
  point: ["T", "M12 7l5 5-5 5-5-5zM3 19c4 2 14 2 18-2"],
  force: ["F", "M5 19 18 6M18 6h-6M18 6v6"],
  mass: ["M", "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16M12 4v16M4 12h16"],
};

/** The tools; `onChoose`: one waits for positions on the canvas. */
export function Toolbar({ tools, onChoose }: { tools: Tools; onChoose: () => void }) {
  return (
    <ToolBar
      upright
      label={t("linkage.tools")}
      value={tools.editor.tool.value}
      tools={TOOLS.map((value) => {
        const [letter, shape] = LOOKS[value];
        return { value, label: t(`linkage.tool_${value}`), letter, shape };
      })}
      onChoose={(tool) => {
        tools.choose(tool);
        onChoose();
      }}
    />
  );
}

const SHOWN = ["paths", "names", "grid", "velocities", "accelerations", "forces"] as const;

/** Switches of what is drawn. */
export function ShownToggles({ editor }: { editor: Editor }) {
  const shown = editor.shown.value;
  return (
    <fieldset class="linkage-shown">
      <legend class="visually-hidden">{t("linkage.shown")}</legend>
      {SHOWN.map((key) => (
        <Toggle
          key={key}
          label={t(`linkage.show_${key}`)}
          value={shown[key]}
          onChange={(on) => {
            editor.shown.value = { ...editor.shown.peek(), [key]: on } satisfies Shown;
          }}
        />
      ))}
    </fieldset>
  );
}

/** Tools that wait for a joint or point that is there, not for a position. */
const ON_PARTS: ReadonlySet<Tool> = new Set(["gears", "drive", "force"]);

/** The next spot typed: its coordinates, or length and direction from the last one. */
export function TypedSpot({ tools, onDone }: { tools: Tools; onDone: () => void }) {
  const typed = useSignal({ x: "", y: "" });
  const at = useSignal<{ x: number | null; y: number | null }>({ x: null, y: null });
  const [byLine, setByLine] = useState(true);
  const { spots, next } = tools.draft.value;
  const last = spots.at(-1);
  const line = byLine && last !== undefined;
  const tool = tools.editor.tool.value;
  const clear = () => {
    typed.value = { x: "", y: "" };
    at.value = { x: null, y: null };
    tools.typed.value = { length: null, angle: null };
  };
  useEffect(clear, [spots.length, tool, byLine]);
  if (tool === "select") return null;
  const type = (key: "x" | "y", text: string, si: number | null) => {
    typed.value = { ...typed.peek(), [key]: text };
    at.value = { ...at.peek(), [key]: si };
    if (line) tools.typed.value = { length: at.peek().x, angle: at.peek().y };
  };
  const put = () => {
    const { x, y } = at.peek();
    const near = next?.at ?? last?.at ?? vec(0, 0);
    if (line) tools.putLine();
    else if (x !== null || y !== null) tools.putAt(vec(x ?? near.x, y ?? near.y));
  };
  const isTyped = !ON_PARTS.has(tool);
  const from = last?.at ?? vec(0, 0);
  const there = next?.at ?? from;
  const shown = line
    ? [formatQuantity(distance(from, there), "mm"), formatQuantity(direction(from, there), "deg")]
    : [formatQuantity(there.x, "mm"), formatQuantity(there.y, "mm")];
  return (
    <form
      class="linkage-typed"
      aria-label={t("linkage.typed")}
      onSubmit={(event) => {
        event.preventDefault();
        put();
      }}
      onKeyDown={(event) => event.key === "Escape" && onDone()}
    >
      <p class="ui-help">{t(`linkage.hint_${tool}`)}</p>
      {isTyped &&
        (["x", "y"] as const).map((key, index) => (
          <QuantityField
            key={`${key}${line}`}
            label={line ? t(index === 0 ? "linkage.length" : "linkage.direction") : key}
            unit={line && index === 1 ? "deg" : "mm"}
            optional
            placeholder={shown[index] ?? ""}
            value={typed.value[key]}
            onChange={(text, si) => type(key, text, si)}
          />
        ))}
      {isTyped && (
        <Button size="small" onClick={put}>
          {t("linkage.set")}
        </Button>
      )}
      {isTyped && last !== undefined && <Toggle label={t("linkage.polar")} value={byLine} onChange={setByLine} />}
      <IconButton icon="close" size="small" label={t("linkage.endTool")} onClick={() => tools.choose("select")} />
    </form>
  );
}
