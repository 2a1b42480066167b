import { useState } from "preact/hooks";
import { filesOf } from "../../project";
import { formatNumber, t } from "../../text";
import { Button, later, Select, Slider } from "../../ui";
import type { CarpetModel } from "./model";
import { Picture } from "./picture";
import { type SettingProps, TextSetting } from "./text-setting";

const SourceDialog = later(async () => (await import("./source")).SourceDialog);
const SpecksPanel = later(async () => (await import("./specks-panel")).SpecksPanel);

/** What the carpet is made of and how its picture is read: the keys of the recipe. */
export function Settings({ model }: { model: CarpetModel }) {
  const recipe = model.recipe.value;
  const [source, setSource] = useState<"crop" | "corners" | null>(null);
  if (recipe === null) return null;
  const picture = model.text("picture");
  const composed = picture === "";
  return (
    <div class="ui-stack">
      <Picture model={model} />
      {composed && <p class="ui-callout">{t("carpet.composed")}</p>}
      <div class="carpet-pair">
        <TextSetting model={model} name="size" label={t("carpet.size")} help={t("carpet.sizeHelp")} />
        <TextSetting model={model} name="quality" label={t("carpet.quality")} help={t("carpet.qualityHelp")} />
        <ChoiceSetting model={model} name="knot" label={t("carpet.knot")} choices={["symmetric", "asymmetric"]} />
        <ChoiceSetting
          model={model}
          name="read"
          label={t("carpet.reading")}
          choices={["auto", "exact", "flat", "photo"]}
        />
      </div>
      {!composed && (
        <details class="ui-details" open>
          <summary>{t("carpet.fitTitle")}</summary>
          <div class="ui-stack">
            <ChoiceSetting
              model={model}
              name="fit"
              label={t("carpet.fit")}
              choices={["auto", "crop", "pad", "stretch", "turn"]}
            />
            <Turn model={model} />
            <div class="ui-row">
              <Button onClick={() => setSource("crop")}>{t("carpet.cropPicture")}</Button>
              <Button onClick={() => setSource("corners")}>{t("carpet.setCorners")}</Button>
            </div>
            <p class="ui-help">{fitText(model)}</p>
          </div>
        </details>
      )}
      <details class="ui-details" open>
        <summary>{t("carpet.tone")}</summary>
        <div class="ui-stack">
          <ShareSetting model={model} name="brightness" label={t("carpet.brightness")} least={-0.9} most={0.9} />
          <ShareSetting model={model} name="contrast" label={t("carpet.contrast")} least={-1} most={2} />
          <ShareSetting model={model} name="saturation" label={t("carpet.saturation")} least={-1} most={2} />
          <Halftone model={model} />
          <TextSetting model={model} name="white" label={t("carpet.white")} help={t("carpet.whiteHelp")} />
        </div>
      </details>
      <Specks model={model} />
      {source !== null && <SourceDialog model={model} mode={source} onClose={() => setSource(null)} />}
    </div>
  );
}

function fitText(model: CarpetModel): string {
  const fit = model.chart.value?.about.fit ?? "";
  const notes = [model.text("crop") && t("carpet.isCropped"), model.text("corners") && t("carpet.isStraightened")];
  return [fit, ...notes].filter(Boolean).join("; ");
}

const CHOICE_TEXTS = {
  auto: () => t("carpet.auto"),
  exact: () => t("carpet.exact"),
  flat: () => t("carpet.flat"),
  photo: () => t("carpet.photo"),
  crop: () => t("carpet.crop"),
  pad: () => t("carpet.pad"),
  stretch: () => t("carpet.stretch"),
  turn: () => t("carpet.quarterTurn"),
  symmetric: () => t("carpet.symmetric"),
  asymmetric: () => t("carpet.asymmetric"),
};
type ChoiceName = keyof typeof CHOICE_TEXTS;

function ChoiceSetting({ model, name, label, choices }: SettingProps & { choices: readonly ChoiceName[] }) {
  const [first] = choices;
  const value = (model.text(name) || model.text(name === "read" ? "reading" : name) || first) as ChoiceName;
  return (
    <Select
      label={label}
      value={value}
      choices={choices.map((choice) => ({ value: choice, label: CHOICE_TEXTS[choice]() }))}
      onChange={(chosen) => {
        const extra = name === "read" ? { reading: "" } : {};
        model.set({ ...extra, [name]: chosen === first ? "" : chosen });
      }}
    />
  );
}

/** A share as a slider in per cent; the recipe takes it as a number. */
function ShareSetting({ model, name, label, least, most }: SettingProps & { least: number; most: number }) {
  const share = shareOf(model.recipe.value?.[name]);
  const percent = Math.round(100 * share);
  return (
    <Slider
      label={label}
      value={share}
      min={least}
      max={most}
      step={0.01}
      text={`${percent > 0 ? "+" : ""}${formatNumber(percent)} %`}
      onInput={(value) => model.set({ [name]: Math.abs(value) < 0.005 ? "" : Math.round(100 * value) / 100 })}
    />
  );
}

/** How much of the tones between the yarns patterns render: of photos only. */
function Halftone({ model }: { model: CarpetModel }) {
  const written = model.recipe.value?.["halftone"];
  if (written === undefined && model.chart.value?.about.reading !== "photo") return null;
  const share = shareOf(written);
  return (
    <div class="carpet-turn">
      <Slider
        label={t("carpet.halftone")}
        value={share}
        min={0}
        max={1}
        step={0.05}
        text={written === undefined ? t("carpet.auto") : `${formatNumber(Math.round(100 * share))} %`}
        onInput={(value) => model.set({ halftone: Math.round(100 * value) / 100 })}
      />
      <Button size="small" disabled={written === undefined} onClick={() => model.set({ halftone: "" })}>
        {t("carpet.auto")}
      </Button>
    </div>
  );
}

/** The specks, which are looked for while they are open. */
function Specks({ model }: { model: CarpetModel }) {
  const [open, setOpen] = useState(false);
  return (
    <details class="ui-details" onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{t("carpet.specks")}</summary>
      {open && <SpecksPanel model={model} />}
    </details>
  );
}

/** A share as the recipe may have it: a number, or a text with %. */
export function shareOf(value: unknown): number {
  if (typeof value === "number") return value;
  const parts = typeof value === "string" ? /^\s*([+-]?[\d.]+)\s*(%?)\s*$/.exec(value) : null;
  if (parts === null) return 0;
  return Number(parts[1]) / (parts[2] === "%" ? 100 : 1);
}

/** An angle of the recipe in degrees. */
export function degreesOf(value: unknown): number {
  if (typeof value === "number") return (180 * value) / Math.PI;
  const parts = typeof value === "string" ? /^\s*([+-]?[\d.]+)\s*(deg|°|rad)?\s*$/.exec(value) : null;
  if (parts === null) return 0;
  return parts[2] === "deg" || parts[2] === "°" ? Number(parts[1]) : (180 * Number(parts[1])) / Math.PI;
}

function Turn({ model }: { model: CarpetModel }) {
  const degrees = degreesOf(model.recipe.value?.["turn"]);
  const give = (value: number) => {
    const rounded = Math.round(10 * value) / 10;
    model.set({ turn: rounded === 0 ? "" : `${rounded}deg` });
  };
  return (
    <div class="carpet-turn">
      <Slider
        label={t("carpet.turn")}
        value={degrees}
        min={-180}
        max={180}
        step={0.5}
        text={`${formatNumber(degrees)}°`}
        onInput={give}
      />
      <Button size="small" onClick={() => give(((degrees + 90 + 180) % 360) - 180)}>
        {t("carpet.quarter")}
      </Button>
    </div>
  );
}

/** The recipes of the project. */
export function recipesOf(): readonly string[] {
  return filesOf("carpet").map((file) => file.path);
}
