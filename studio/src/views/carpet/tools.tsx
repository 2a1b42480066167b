import { t } from "../../text";
import { Button, NumberField, Segments, Select, ToolBar } from "../../ui";
import { type CarpetModel, TOOLS, type Tool } from "./model";
import { mirrored, turned } from "./placing";
import { drawsLive, takesPart } from "./pointer";
import { BRUSHES, SYMMETRIES } from "./symmetry";
import { applyToWhole } from "./use-hand";

/** Letter and icon of each tool. */
const LOOKS: Record<Tool, readonly [letter: string, shape: string]> = {
  pan: ["V", "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3"],
  pencil: ["B", "M4 20l1-4L16 5l3 3L8 19zM14 7l3 3"],
  line: ["L", "M5 19 19 5"],
  fill: ["F", "M4 12l7-7 7 7-7 7zM4 12h14M20.500 16c1.500 2.500 1 4 0 4s-1.500-1.500 0-4"],
  select: ["S", "M4 8V4h4M11 4h3M17 4h3v4M20 11v3M20 17v3h-3M14 20h-3M8 20H4v-3M4 14v-3"],
  mirror: ["M", "M12 3v18M9 7 3 17h6zM15 7l6 10h-6z"],
  repeat: ["E", "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z"],
  border: ["O", "M3 3h18v18H3zM7 7h10v10H7z"],
};

/** The tools of the chart, and what the one in hand needs. */
export function Tools({ model }: { model: CarpetModel }) {
  const tool = model.tool.value;
  return (
    <>
      <ToolBar
        label={t("carpet.tool")}
        value={tool}
        tools={TOOLS.map((value) => {
          const [letter, shape] = LOOKS[value];
          return { value, label: t(`carpet.${value}Tool`), letter, shape };
        })}
        onChoose={(chosen) => model.takeTool(chosen)}
      />
      {tool !== "pan" && <InHand model={model} tool={tool} />}
    </>
  );
}

/** What the tool in hand needs, and what it expects next. */
function InHand({ model, tool }: { model: CarpetModel; tool: Exclude<Tool, "pan"> }) {
  const names = [...new Set(model.yarns().map((yarn) => yarn.name))];
  const isMotif = model.placing.value?.kind === "motif";
  const gives = tool === "pencil" || tool === "line" || tool === "fill" || tool === "border" || tool === "select";
  return (
    <div class="carpet-tools">
      {gives && (
        <span class="carpet-swatch" style={{ background: model.colourOf(model.yarn.value) }} aria-hidden="true" />
      )}
      {gives && (
        <Select
          label={tool === "select" && !isMotif ? t("carpet.leftYarn") : t("carpet.yarn")}
          value={model.yarn.value}
          choices={names.map((name) => ({ value: name, label: name }))}
          onChange={(name) => model.takeYarnOf(name)}
        />
      )}
      {(tool === "pencil" || tool === "line") && (
        <Select
          label={t("carpet.brush")}
          value={String(model.brush.value)}
          choices={BRUSHES.map((width) => ({ value: String(width), label: t("carpet.brushWidth", { count: width }) }))}
          onChange={(width) => {
            model.brush.value = Number(width);
          }}
        />
      )}
      {(drawsLive(tool) || isMotif) && (
        <Select
          label={t("carpet.symmetry")}
          value={model.symmetry.value}
          choices={SYMMETRIES.map((symmetry) => ({ value: symmetry, label: t(`carpet.${symmetry}Symmetry`) }))}
          onChange={(symmetry) => {
            model.symmetry.value = symmetry;
          }}
        />
      )}
      {tool === "mirror" && (
        <Segments
          label={t("carpet.mirrorTool")}
          labelHidden
          value={model.mirror.value}
          choices={[
            { value: "across", label: t("carpet.across") },
            { value: "along", label: t("carpet.along") },
            { value: "both", label: t("carpet.both") },
          ]}
          onChange={(direction) => {
            model.mirror.value = direction;
          }}
        />
      )}
      {tool === "border" && (
        <NumberField
          label={t("carpet.borderWidth")}
          value={model.borderWidth.value}
          min={1}
          max={1000}
          onChange={(width) => {
            model.borderWidth.value = Math.round(width);
          }}
        />
      )}
      {tool === "select" && <Selection model={model} />}
      {takesPart(tool) && tool !== "select" && (
        <Button disabled={tool === "repeat" && model.tile.value === null} onClick={() => applyToWhole(model)}>
          {t("carpet.wholeCarpet")}
        </Button>
      )}
      <p class="ui-help ui-grow">{helpOf(model, tool)}</p>
    </div>
  );
}

/** What the tool in hand expects next. */
function helpOf(model: CarpetModel, tool: Exclude<Tool, "pan">): string {
  if (model.placing.value !== null) return t("carpet.placeHelp");
  if (tool === "select" && model.selection.value !== null) return t("carpet.selected");
  return tool === "repeat" && model.tile.value !== null ? t("carpet.repeatPart") : t(`carpet.${tool}Help`);
}

/** What is done with a selected part, and with what is held. */
function Selection({ model }: { model: CarpetModel }) {
  const placing = model.placing.value;
  const nothing = model.selection.value === null;
  return (
    <span class="ui-row">
      <Button size="small" disabled={nothing} pressed={placing?.kind === "copy"} onClick={() => model.hold("copy")}>
        {t("carpet.copy")}
      </Button>
      <Button size="small" disabled={nothing} pressed={placing?.kind === "move"} onClick={() => model.hold("move")}>
        {t("carpet.move")}
      </Button>
      <Button
        size="small"
        disabled={placing === null || placing.kind === "tile"}
        onClick={() => {
          if (placing !== null) model.placing.value = turned(placing);
        }}
      >
        {t("carpet.turnHeld")}
      </Button>
      <Button
        size="small"
        disabled={placing === null || placing.kind === "tile"}
        onClick={() => {
          if (placing !== null) model.placing.value = mirrored(placing);
        }}
      >
        {t("carpet.mirrorHeld")}
      </Button>
    </span>
  );
}
