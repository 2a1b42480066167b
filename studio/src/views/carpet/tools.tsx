import { t } from "../../text";
import { Button, NumberField, Segments, Select } from "../../ui";
import { type CarpetModel, TOOLS } from "./model";
import { mirrored, turned } from "./placing";
import { drawsLive, takesPart } from "./pointer";
import { BRUSHES, SYMMETRIES } from "./symmetry";
import { applyToWhole } from "./use-hand";

/** The tools of the chart, and what the one in hand needs. */
export function Tools({ model }: { model: CarpetModel }) {
  const tool = model.tool.value;
  const names = [...new Set(model.yarns().map((yarn) => yarn.name))];
  const isMotif = model.placing.value?.kind === "motif";
  const gives = tool === "pencil" || tool === "line" || tool === "fill" || tool === "border" || tool === "select";
  return (
    <div class="carpet-tools">
      <Segments
        label={t("carpet.tool")}
        labelHidden
        value={tool}
        choices={TOOLS.map((choice) => ({ value: choice, label: t(`carpet.${choice}Tool`) }))}
        onChange={(chosen) => model.takeTool(chosen)}
      />
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
      {tool !== "pan" && <p class="ui-help ui-grow">{helpOf(model)}</p>}
    </div>
  );
}

/** What the tool in hand expects next. */
function helpOf(model: CarpetModel): string {
  const tool = model.tool.value;
  if (tool === "pan") return "";
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
