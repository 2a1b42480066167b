import { useEffect, useState } from "preact/hooks";
import type { FormField, MachineFields } from "../../api/messages";
import { get } from "../../api/request";
import { t, textIfKnown } from "../../text";
import { QuantityField, quantityText, Select, TextField, Toggle } from "../../ui";
import { isOn, LISTS, type Machine, type Settings, type SettingValue } from "./task";

const known = new Map<Machine, MachineFields>();

/** The declared parameters of a machine; null until they are read. */
export function useFields(machine: Machine): MachineFields | null {
  const [fields, setFields] = useState<MachineFields | null>(known.get(machine) ?? null);
  useEffect(() => {
    const found = known.get(machine) ?? null;
    setFields(found);
    if (found !== null) return;
    const abort = new AbortController();
    get<MachineFields>(`/machines/${machine}`, abort.signal).then(
      (made) => {
        known.set(machine, made);
        setFields(made);
      },
      () => undefined,
    );
    return () => abort.abort();
  }, [machine]);
  return fields;
}

/** Settings that the workshop's files need, or that are chosen elsewhere in the view. */
const ELSEWHERE = new Set(["chosen", "link_width", "link_thickness", "loosen"]);

/** Groups of settings, in the order shown; what is in none is in the last one. */
const GROUPS: Record<string, readonly string[]> = {
  quality: ["transmission_min", "transmission_over", "size_max", "link_ratio_max", "error_max", "full_turn"],
  task: [
    ...["function", "start", "stop", "crank_swing", "rocker_swing", "criterion", "closed", "ordered", "kind"],
    ...["timing", "exact", "coupler_angles", "driven"],
  ],
  links: ["ground", "crank", "coupler", "rocker", "tracer_along", "tracer_across"],
  pivots: ["pivots", "pins", "pivot_x", "pivot_y", "pivot_region", "crank_region", "rocker_region", "keep_out", "turn"],
  defects: ["transmits", "one_circuit", "one_branch", "in_order"],
};

/** An upper bound so far off that it is not worth a line of the form; the server keeps it. */
const FAR = 1e5;

interface LimitsProps {
  machine: Machine;
  settings: Settings;
  onChange: (name: string, value: SettingValue | undefined) => void;
}

/** All settings of the task besides its points, made from the machine's declaration. */
export function Limits({ machine, settings, onChange }: LimitsProps) {
  const fields = useFields(machine);
  if (fields === null) return <p class="ui-muted">{t("app.loading")}</p>;
  const shown = fields.fields.filter((one) => one.name !== LISTS[machine].setting && !ELSEWHERE.has(one.name));
  const grouped = Object.values(GROUPS).flat();
  const groups = [
    ...Object.entries(GROUPS),
    ["search", shown.map((one) => one.name).filter((one) => !grouped.includes(one))],
  ] as const;
  return (
    <div class="ui-stack">
      {groups.map(([group, names]) => {
        const own = names.flatMap((name) => shown.filter((one) => one.name === name));
        const given = own.filter((one) => settings[one.name] !== undefined).length;
        if (own.length === 0) return null;
        return (
          <details
            key={`${machine}-${group}`}
            class="ui-details"
            open={group === "quality" || (group === "task" && machine === "function-four-bar")}
          >
            <summary>
              {textIfKnown(`synthesis.group_${group}`) ?? group}{" "}
              {given > 0 && <span class="ui-badge">{t("synthesis.given", { count: given })}</span>}
            </summary>
            <div class="synthesis-fields">
              {own.map((field) => (
                <Setting
                  key={field.name}
                  field={field}
                  value={settings[field.name]}
                  onChange={(to) => onChange(field.name, to)}
                />
              ))}
            </div>
          </details>
        );
      })}
    </div>
  );
}

interface SettingProps {
  field: FormField;
  value: SettingValue | undefined;
  onChange: (value: SettingValue | undefined) => void;
}

function Setting({ field, value, onChange }: SettingProps) {
  const label = textIfKnown(`synthesis.set_${field.name}`) ?? field.name;
  if (field.kind === "flag") {
    const on = value === undefined ? field.default === true : isOn(value);
    return <Toggle label={label} value={on} onChange={(to) => onChange(to === field.default ? undefined : to)} />;
  }
  if (field.kind === "choice") {
    return (
      <Select
        label={label}
        help={field.doc}
        value={String(value ?? field.default)}
        choices={field.choices.map((one) => ({ value: one, label: one }))}
        onChange={(to) => onChange(to === field.default ? undefined : to)}
      />
    );
  }
  if (field.kind === "text") return <TextSetting field={field} label={label} value={value} onChange={onChange} />;
  const far = (field.at_most ?? 0) / field.factor >= FAR;
  const bounds = {
    above: field.above,
    at_least: field.at_least,
    below: field.below,
    at_most: far ? null : field.at_most,
  };
  const count = field.kind === "count";
  return (
    <QuantityField
      label={label}
      help={field.doc}
      value={typeof value === "number" ? quantityText(value, field.shown_unit) : String(value ?? "")}
      unit={field.shown_unit}
      optional
      placeholder={field.default_text}
      bounds={bounds}
      onChange={(text, si) => onChange(text === "" ? undefined : count && si !== null ? Math.round(si) : text)}
    />
  );
}

/** A text that is taken when it is complete: on Enter, or when the field is left. */
function TextSetting({ field, label, value, onChange }: SettingProps & { label: string }) {
  const given = String(value ?? "");
  const [draft, setDraft] = useState(given);
  useEffect(() => setDraft(given), [given]);
  return (
    <TextField
      label={label}
      help={field.doc}
      value={draft}
      placeholder={field.default_text}
      onChange={setDraft}
      onCommit={(text) => onChange(text.trim() === "" ? undefined : text.trim())}
    />
  );
}
