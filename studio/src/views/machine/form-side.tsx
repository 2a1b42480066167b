import { useState } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { Button, Progress, SearchField, Toggle } from "../../ui";
import { FieldRow } from "./field";
import { type Group, groupLabel, groupsOf } from "./form";
import type { MachineModel } from "./model";

/** Number of parameters of a group that are shown before the rest is opened. */
const FIRST = 60;

/** The form: search, filter, groups of parameters. */
export function FormSide({ model }: { model: MachineModel }) {
  const [words, setWords] = useState("");
  const [changed, setChanged] = useState(false);
  const form = model.form.value;
  if (form === null) return null;
  const settings = model.settings.value;
  const groups = groupsOf(form.fields, settings, { words, changed, machine: model.shownMachine.value });
  const set = Object.keys(settings).length;
  return (
    <div class="machine-form ui-stack">
      <div class="machine-tools ui-stack">
        <SearchField label={t("machine.search")} value={words} onChange={setWords} />
        <div class="ui-row">
          <Toggle label={`${t("machine.changedOnly")} (${formatNumber(set)})`} value={changed} onChange={setChanged} />
          <span class="ui-grow" />
          <Button
            size="small"
            icon="reset"
            disabled={set === 0}
            title={t("machine.resetAllHint")}
            onClick={() => model.set(Object.fromEntries(Object.keys(settings).map((name) => [name, undefined])))}
          >
            {t("machine.resetAll")}
          </Button>
        </div>
        {form.machines.length > 0 && <OfMachine model={model} machines={form.machines} />}
        <Toggle
          label={t("machine.sensitivities")}
          value={model.moving.value}
          onChange={(on) => {
            model.moving.value = on;
          }}
        />
        <Moving model={model} />
      </div>
      {groups.length === 0 && <p class="ui-muted">{t("machine.noneFound")}</p>}
      {groups.map((group) => (
        <GroupOfFields key={group.name} model={model} group={group} open={groups.length < 3 || group.name === ""} />
      ))}
    </div>
  );
}

/** Whose parameters are shown: those of the machine, or of a machine in it. */
function OfMachine({ model, machines }: { model: MachineModel; machines: readonly string[] }) {
  return (
    <label class="ui-field">
      <span class="ui-label">{t("machine.parametersOf")}</span>
      <select
        class="ui-input"
        value={model.shownMachine.value}
        onChange={(event) => {
          model.shownMachine.value = event.currentTarget.value;
        }}
      >
        {["", ...machines].map((name) => (
          <option key={name} value={name} selected={name === model.shownMachine.value}>
            {name === "" ? t("machine.itself") : name}
          </option>
        ))}
      </select>
    </label>
  );
}

function Moving({ model }: { model: MachineModel }) {
  const count = model.toMove.value;
  if (count === null) return null;
  const stop = () => {
    model.moving.value = false;
  };
  return (
    <Progress label={t("machine.sensitivityWork", count)} share={count.done / Math.max(1, count.all)} onCancel={stop} />
  );
}

function GroupOfFields({ model, group, open }: { model: MachineModel; group: Group; open: boolean }) {
  const [all, setAll] = useState(false);
  const shown = all ? group.fields : group.fields.slice(0, FIRST);
  return (
    <details class="machine-group" open={open}>
      <summary>
        <h2>{group.name === "" ? t("machine.groupGeneral") : groupLabel(group.name)}</h2>
        <span class="ui-muted">{t("machine.count", { count: group.fields.length })}</span>
      </summary>
      {shown.map((field) => (
        <FieldRow key={`${model.machine.value} ${field.name}`} model={model} field={field} />
      ))}
      {shown.length < group.fields.length && (
        <Button onClick={() => setAll(true)}>{t("machine.more", { count: group.fields.length })}</Button>
      )}
    </details>
  );
}
