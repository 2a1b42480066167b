/** What is set by hand in the picture: standard views, what is followed, cut, moved apart, named, woven. */
import { formatNumber, t } from "../../text";
import { Button, Select, Slider, Toggle } from "../../ui";
import type { SectionAxis } from "./stage";
import { VIEW_NAMES, type ViewName } from "./views";

export interface PictureState {
  /** Number of the head that is followed; "": none. */
  followed: string;
  axis: SectionAxis | "none";
  /** Where it is cut, as a share of the loom. */
  cut: number;
  apart: number;
  names: boolean;
  measures: boolean;
  guards: boolean;
  rows: number;
}

interface ControlsProps {
  state: PictureState;
  heads: number;
  /** Whether it has guards. */
  guarded: boolean;
  /** Rows of the carpet; null: a run weaves them. */
  rows: number | null;
  onShow: (view: ViewName) => void;
  onChange: (change: Partial<PictureState>) => void;
}

const AXES = { none: "none", x: "across", y: "level", z: "depth" } as const;

export function Controls({ state, heads, guarded, rows, onShow, onChange }: ControlsProps) {
  const { axis, cut, apart } = state;
  return (
    <>
      <fieldset class="loom-views">
        <legend>{t("loom.views")}</legend>
        {VIEW_NAMES.filter((name) => heads > 0 || name !== "head").map((name) => (
          <Button key={name} size="small" onClick={() => onShow(name)}>
            {t(`loom.${name}`)}
          </Button>
        ))}
      </fieldset>
      {heads > 0 && (
        <Select
          label={t("loom.follow")}
          value={state.followed}
          choices={[
            { value: "", label: t("loom.nobody") },
            ...Array.from({ length: heads }, (_, k) => ({
              value: String(k),
              label: t("loom.headNumber", { number: k + 1 }),
            })),
          ]}
          onChange={(followed) => onChange({ followed })}
        />
      )}
      <Select
        label={t("loom.section")}
        value={axis}
        choices={(["none", "x", "y", "z"] as const).map((value) => ({ value, label: t(`loom.${AXES[value]}`) }))}
        onChange={(to) => onChange({ axis: to })}
      />
      {axis !== "none" && (
        <Slider
          label={t("loom.cut")}
          value={cut}
          min={0}
          max={1}
          text={percent(cut)}
          onInput={(to) => onChange({ cut: to })}
        />
      )}
      <Slider
        label={t("loom.explode")}
        value={apart}
        min={0}
        max={1}
        text={percent(apart)}
        onInput={(to) => onChange({ apart: to })}
      />
      {rows !== null && (
        <Slider
          label={t("loom.rows")}
          value={state.rows}
          min={0}
          max={rows}
          step={1}
          text={t("loom.rowsText", { rows: state.rows, all: rows })}
          onInput={(to) => onChange({ rows: to })}
        />
      )}
      <Toggle label={t("loom.labels")} value={state.names} onChange={(names) => onChange({ names })} />
      {guarded && <Toggle label={t("loom.guards")} value={state.guards} onChange={(guards) => onChange({ guards })} />}
      <Toggle label={t("loom.measure")} value={state.measures} onChange={(measures) => onChange({ measures })} />
    </>
  );
}

function percent(share: number): string {
  return `${formatNumber(Math.round(100 * share))} %`;
}
