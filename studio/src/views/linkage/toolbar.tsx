/** The tools of the drawing, and what is shown; a bar of icons, with a letter each. */

import { useState } from "preact/hooks";
import { t } from "../../text";
import { Button, IconButton, QuantityField, Toggle } from "../../ui";
import { type Editor, type Shown, TOOLS, type Tool } from "./editor";
import { plus, vec } from "./geometry";
import { copyBodies, GROUND } from "./mechanism";
import { deleteSelection } from "./pointer";
import type { Tools } from "./tools";

const SHAPES: Record<Tool, string> = {
  select: "M6 4l12 9-5.500 1-3 5.500z",
  link: "M6 18a2 2 0 1 0 0-.010M18 6a2 2 0 1 0 0-.010M7.500 16.500l9-9",
  body: "M5 18h14L13 5zM5 18h.010M19 18h.010M13 5h.010",
  pin: "M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6M3 12h6M15 12h6",
  pivot: "M12 4a2 2 0 1 0 0 4 2 2 0 0 0 0-4M11 8l-5 9h12l-5-9M4 17h16M7 17l-3 3M13 17l-3 3M19 17l-3 3",
  slide: "M3 16h18M7 8h10v8H7zM12 12h.010",
  gears: "M8 5a5 5 0 1 0 0 10A5 5 0 0 0 8 5M17 11a4 4 0 1 0 0 8 4 4 0 0 0 0-8",
  drive: "M5 15a8 8 0 1 1 13 2M18 17l4-3M18 17l-1-5",
  point: "M12 7l5 5-5 5-5-5zM3 19c4 2 14 2 18-2",
  force: "M5 19 18 6M18 6h-6M18 6v6",
  mass: "M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16M12 4v16M4 12h16",
};

/** The letter that chooses a tool. */
export const LETTERS: Record<string, Tool> = {
  v: "select",
  l: "link",
  b: "body",
  p: "pin",
  o: "pivot",
  s: "slide",
  g: "gears",
  d: "drive",
  t: "point",
  f: "force",
  m: "mass",
};

export function Toolbar({ tools }: { tools: Tools }) {
  const { editor } = tools;
  const letter = Object.fromEntries(Object.entries(LETTERS).map(([key, tool]) => [tool, key.toUpperCase()]));
  return (
    <div class="linkage-tools" role="toolbar" aria-label={t("linkage.tools")} aria-orientation="vertical">
      {TOOLS.map((tool) => (
        <button
          key={tool}
          type="button"
          class="ui-button quiet icon"
          aria-pressed={editor.tool.value === tool}
          aria-label={t(`linkage.tool_${tool}`)}
          title={`${t(`linkage.tool_${tool}`)} (${letter[tool]})`}
          data-tool={tool}
          onClick={() => tools.choose(tool)}
        >
          <svg class="ui-icon" viewBox="0 0 24 24" aria-hidden="true">
            <path d={SHAPES[tool]} />
          </svg>
        </button>
      ))}
    </div>
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

/** What can be done with the chosen bodies. */
export function Actions({ editor }: { editor: Editor }) {
  const { bodies, joints, points } = editor.selection.value;
  const copy = (mirrored: boolean) => {
    const figure = editor.figure.peek();
    if (figure === null) return;
    const corners = Object.fromEntries(
      figure.bodies.map((body) => [body.name, Object.fromEntries(body.points.map((point) => [point.name, point.at]))]),
    );
    const all = figure.bodies.filter((body) => bodies.includes(body.name)).flatMap((body) => body.outline);
    const right = Math.max(...all.map((point) => point.x));
    const aside = 24 / editor.camera.peek().scale;
    const place = mirrored
      ? (at: { x: number; y: number }) => vec(2 * right + aside - at.x, at.y)
      : (at: { x: number; y: number }) => plus(at, vec(aside, -aside));
    let made: string[] = [];
    editor.edit((data) => {
      made = copyBodies(data, bodies, corners, place);
    });
    editor.select({ bodies: made });
  };
  const some = bodies.some((body) => body !== GROUND);
  return (
    <div class="ui-row">
      <Button size="small" disabled={!some} onClick={() => copy(false)}>
        {t("linkage.duplicate")}
      </Button>
      <Button size="small" disabled={!some} onClick={() => copy(true)}>
        {t("linkage.mirror")}
      </Button>
      <Button
        size="small"
        icon="remove"
        disabled={bodies.length + joints.length + points.length === 0}
        onClick={() => deleteSelection(editor)}
      >
        {t("linkage.remove")}
      </Button>
    </div>
  );
}

/** Typed coordinates of the next spot, or length and direction from the last one. */
export function TypedSpot({ tools }: { tools: Tools }) {
  const [typed, setTyped] = useState({ x: "0mm", y: "0mm", polar: false });
  const [si, setSi] = useState({ a: 0, b: 0 });
  const last = tools.draft.value.spots.at(-1);
  const polar = typed.polar && last !== undefined;
  const tool = tools.editor.tool.value;
  if (tool === "select") return null;
  const put = () => {
    const at = polar ? plus(last.at, vec(si.a * Math.cos(si.b), si.a * Math.sin(si.b))) : vec(si.a, si.b);
    tools.putAt(at);
  };
  return (
    <form
      class="linkage-typed"
      aria-label={t("linkage.typed")}
      onSubmit={(event) => {
        event.preventDefault();
        put();
      }}
    >
      <p class="ui-help">{t(`linkage.hint_${tool}`)}</p>
      {last !== undefined && (
        <Toggle label={t("linkage.polar")} value={typed.polar} onChange={(on) => setTyped({ ...typed, polar: on })} />
      )}
      <QuantityField
        label={polar ? t("linkage.length") : "x"}
        unit="mm"
        value={typed.x}
        onChange={(x, a) => {
          setTyped({ ...typed, x });
          setSi({ ...si, a: a ?? 0 });
        }}
      />
      <QuantityField
        key={String(polar)}
        label={polar ? t("linkage.direction") : "y"}
        unit={polar ? "deg" : "mm"}
        value={polar ? "0deg" : typed.y}
        onChange={(y, b) => {
          if (!polar) setTyped({ ...typed, y });
          setSi({ ...si, b: b ?? 0 });
        }}
      />
      <Button size="small" onClick={put}>
        {t("linkage.set")}
      </Button>
      <IconButton icon="close" size="small" label={t("linkage.endTool")} onClick={() => tools.choose("select")} />
    </form>
  );
}
