import { useId } from "preact/hooks";
import type { Effect, FormField } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button, Icon } from "../../ui";
import { type Bar, barsOf } from "./effects";
import { labelOf } from "./form";
import type { MachineModel } from "./model";

/** Number of effects that are shown without being opened. */
const FIRST = 3;

/** What a parameter does to the checks: sign, size, and where a check would turn. */
export function Strip({ model, field }: { model: MachineModel; field: FormField }) {
  const id = useId();
  const found = model.sensitivities.value.get(field.name);
  if (found === undefined) return null;
  if (found.unmoved !== "") return <p class="ui-help">{t("machine.unmoved", { why: found.unmoved })}</p>;
  if (found.effects.length === 0) {
    return (
      <p class="ui-help">
        {found.step}: {t("machine.noEffect")}
      </p>
    );
  }
  const bars = barsOf(found.effects, model.view.value?.checks ?? []);
  const rest = bars.slice(FIRST);
  const list = (some: readonly Bar[]) =>
    some.map((bar) => <BarRow key={keyOf(bar.effect)} bar={bar} {...{ model, field }} />);
  return (
    <div class="machine-strip" role="group" aria-labelledby={id}>
      <p class="ui-help" id={id}>
        <span class="visually-hidden">{t("machine.effectsOf", { name: labelOf(field) })}: </span>
        {found.step}
      </p>
      <ul>{list(bars.slice(0, FIRST))}</ul>
      {rest.length > 0 && (
        <details class="ui-details">
          <summary>{t("machine.weaker", { count: rest.length + found.weaker })}</summary>
          <ul>{list(rest)}</ul>
        </details>
      )}
    </div>
  );
}

function BarRow({ bar, model, field }: { bar: Bar; model: MachineModel; field: FormField }) {
  const { effect, better } = bar;
  const chosen = field.kind === "choice" || field.kind === "flag";
  const check = effect.machine === "" ? effect.check : `${effect.machine}: ${effect.check}`;
  const percent = `${effect.relative > 0 ? "+" : "−"}${formatNumber(Math.abs(effect.relative) * 100, 2)}`;
  const look = better === null ? "" : better ? "better" : "worse";
  return (
    <li class={`machine-effect ${look}`}>
      <span class="machine-bar" aria-hidden="true">
        <span style={{ width: `${bar.length * 50}%` }} class={effect.relative > 0 ? "up" : "down"} />
      </span>
      <span class="machine-effect-text">
        {better !== null && (
          <Icon name={better ? "up" : "down"} label={better ? t("machine.better") : t("machine.worse")} />
        )}{" "}
        {chosen ? t("machine.effectChoice", { check, percent }) : t("machine.effect", { check, percent })}{" "}
        <Turn effect={effect} model={model} field={field} />
      </span>
    </li>
  );
}

/** Where a check would turn, in a straight line: a press sets the parameter there. */
function Turn({ effect, model, field }: { effect: Effect; model: MachineModel; field: FormField }) {
  if (effect.ok !== effect.after) {
    return (
      <strong class={effect.ok ? "machine-fails" : "machine-holds"}>
        {effect.ok ? t("machine.turnsChoiceFails") : t("machine.turnsChoiceHolds")}
      </strong>
    );
  }
  if (effect.turns_at == null) return null;
  const value = effect.turns_text;
  return (
    <Button
      size="small"
      class={effect.ok ? "machine-fails" : "machine-holds"}
      title={t("machine.tryIt", { value })}
      onClick={() => model.set({ [field.name]: value.replace(/\s/g, "") })}
    >
      {effect.ok ? t("machine.turnsFails", { value }) : t("machine.turnsHolds", { value })}
    </Button>
  );
}

function keyOf(effect: Effect): string {
  return `${effect.machine}\n${effect.check}`;
}
