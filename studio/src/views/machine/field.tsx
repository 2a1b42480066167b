import { useEffect, useId, useMemo, useRef, useState } from "preact/hooks";
import { latest } from "../../api/latest";
import type { ForceValue, FormField, ReadValue } from "../../api/messages";
import { ApiError, post } from "../../api/request";
import { t } from "../../text";
import { Icon, IconButton, Slider } from "../../ui";
import { type Bounds, formatQuantity, outside, readQuantity, spaced } from "../../ui/units";
import { labelOf, nameIn } from "./form";
import type { MachineModel } from "./model";
import { onScale, positionOf, type Scale, STEPS, scaleAround, textAt } from "./scale";
import type { Setting } from "./settings";
import { Strip } from "./strip";

interface RowProps {
  model: MachineModel;
  field: FormField;
}

/** A parameter: what it is, its value, and what it does to the checks. */
export function FieldRow({ model, field }: RowProps) {
  const id = useId();
  const [asked, setAsked] = useState(false);
  const settings = model.settings.value;
  const name = nameIn(field, settings);
  const setting = name === undefined ? undefined : settings[name];
  const force = model.view.value?.parameters[field.name];
  const set = (to: Setting | undefined) => {
    const changes = name !== undefined && name !== field.name ? { [name]: undefined } : {};
    model.set({ ...changes, [field.name]: to });
  };
  const label = labelOf(field);
  const chosen = name === undefined && field.default === null && force?.value != null;
  return (
    <div class={`machine-field${name === undefined ? "" : " set"}`}>
      <span class="machine-name" title={field.doc}>
        <label for={id}>{label}</label> {field.symbol && <span class="ui-symbol">{field.symbol}</span>}
      </span>
      <Control id={id} model={model} field={field} setting={setting} force={force} set={set} />
      <span class="machine-aids">
        {name !== undefined && (
          <IconButton
            icon="reset"
            size="small"
            label={t("machine.reset", { name: label })}
            onClick={() => set(undefined)}
          />
        )}
        <IconButton
          icon="help"
          size="small"
          label={t("machine.about", { name: label })}
          aria-expanded={asked}
          onClick={() => setAsked(!asked)}
        />
      </span>
      <p class="ui-help" hidden={!asked}>
        <span id={`${id}-help`}>
          <Meaning text={field.doc} />
          {chosen && <> {t("machine.chosen", { value: force.text })}</>}
        </span>{" "}
        {field.allowed !== "" && field.kind !== "choice" && (
          <span class="ui-bounds" id={`${id}-bounds`}>
            {field.allowed.replace(/^allowed: /, "")}
          </span>
        )}
      </p>
      {model.moving.value && <Strip model={model} field={field} />}
    </div>
  );
}

/** What a parameter means; examples of what can be typed are in backticks. */
function Meaning({ text }: { text: string }) {
  return <>{text.split("`").map((part, at) => (at % 2 === 0 ? part : <code key={at}>{part}</code>))}</>;
}

interface ControlProps extends RowProps {
  id: string;
  setting: Setting | undefined;
  force: ForceValue | undefined;
  set: (to: Setting | undefined) => void;
}

function Control(props: ControlProps) {
  const { id, field, setting, force, set } = props;
  const about = `${id}-help${field.allowed !== "" && field.kind !== "choice" ? ` ${id}-bounds` : ""}`;
  if (field.kind === "flag") {
    const on = setting === undefined ? force?.value === true : setting === true || TRUE.has(String(setting));
    return (
      <input
        id={id}
        type="checkbox"
        role="switch"
        aria-checked={on}
        class="machine-switch"
        aria-describedby={about}
        checked={on}
        onChange={(event) => set(event.currentTarget.checked)}
      />
    );
  }
  if (field.kind === "choice") {
    const shown = setting === undefined ? "" : String(setting);
    const usual = typeof force?.value === "string" && setting === undefined ? force.value : field.default_text;
    return (
      <select
        id={id}
        class="ui-input"
        aria-describedby={about}
        value={shown}
        onChange={(event) => set(event.currentTarget.value === "" ? undefined : event.currentTarget.value)}
      >
        <option value="" selected={shown === ""}>
          {usual === "" ? t("machine.byDesign") : t("machine.defaultIs", { value: usual })}
        </option>
        {field.choices.map((one) => (
          <option key={one} value={one} selected={one === shown}>
            {one}
          </option>
        ))}
      </select>
    );
  }
  return <Typed {...props} about={about} />;
}

/** Pause after the last letter before what is typed is in the document, although the field is not left [ms]. */
const PAUSE = 700;

const TRUE = new Set(["yes", "true", "on", "1"]);

/** A quantity, a number or a text typed freely, a number with a slider. */
function Typed({ id, model, field, setting, force, set, about }: ControlProps & { about: string }) {
  const given = setting === undefined ? "" : String(setting);
  const [draft, setDraft] = useState(spaced(given));
  const [refused, setRefused] = useState("");
  const typed = useRef(given);
  const pause = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
  useEffect(() => {
    if (given !== typed.current) {
      setDraft(spaced(given));
      setRefused("");
    }
    typed.current = given;
  }, [given]);
  const check = useMemo(() => reader(model, field, setRefused), [model, field]);
  const type = (text: string) => {
    setDraft(text);
    const made = settingOf(field, text);
    if (made === undefined && text.trim() !== "") {
      check(text);
      return;
    }
    check.cancel();
    setRefused("");
    typed.current = made === undefined ? "" : String(made);
    if (made === undefined) set(undefined);
    else model.drag(field.name, made);
    clearTimeout(pause.current);
    pause.current = setTimeout(() => model.drop(), PAUSE);
  };
  const end = () => {
    clearTimeout(pause.current);
    model.drop();
    if (refused === "") setDraft(spaced(typed.current));
  };
  const back = () => {
    check.cancel();
    setRefused("");
    setDraft(spaced(typed.current));
  };
  const shown = typeof force?.value === "number" ? force.value : null;
  return (
    <>
      <div class={shown === null || field.kind === "text" ? "machine-wide" : "ui-with-slider"}>
        {shown !== null && field.kind !== "text" && (
          <ValueSlider model={model} field={field} value={readValue(field, given) ?? shown} />
        )}
        <input
          id={id}
          class="ui-input"
          type="text"
          autocomplete="off"
          spellcheck={false}
          value={draft}
          placeholder={placeholderOf(field, force)}
          aria-invalid={refused !== "" || undefined}
          aria-describedby={refused === "" ? about : `${id}-error ${about}`}
          onInput={(event) => type(event.currentTarget.value)}
          onChange={end}
          onKeyDown={(event) => event.key === "Escape" && back()}
        />
      </div>
      <Understood field={field} text={draft} />
      {refused !== "" && (
        <p class="ui-error" id={`${id}-error`} role="alert">
          <Icon name="error" />
          <span>{refused}</span>
        </p>
      )}
    </>
  );
}

/** Asks the server why a text is no value of a parameter: its words are those of the command line. */
function reader(model: MachineModel, field: FormField, refuse: (why: string) => void) {
  return latest<string, ReadValue>(
    (text, abort) => post(`/machines/${model.machine.peek()}/reading`, { parameter: field.name, setting: text }, abort),
    () => refuse(""),
    (error) => refuse(error instanceof ApiError ? error.message : ""),
  );
}

/** What a text was read as, where it is typed in another unit. */
function Understood({ field, text }: { field: FormField; text: string }) {
  const value = readValue(field, text);
  const shown = value === null ? "" : formatQuantity(value, field.shown_unit, 5);
  if (field.kind !== "quantity" || shown === "" || same(shown, text)) return null;
  return <p class="ui-help">{t("machine.readAs", { value: shown })}</p>;
}

function same(one: string, other: string): boolean {
  const bare = (text: string) => text.replaceAll(/[\s,]/g, "").replaceAll("−", "-");
  return bare(one) === bare(other) || bare(one).replace("°", "deg") === bare(other);
}

/** The value of a text [SI]; null where it is none. */
function readValue(field: FormField, text: string): number | null {
  if (text.trim() === "") return null;
  const read = readQuantity(text, field.shown_unit);
  return "si" in read ? read.si : null;
}

/** The setting that a text is; undefined where it is none, or out of bounds. */
export function settingOf(field: FormField, text: string): Setting | undefined {
  const written = text.trim();
  if (written === "") return undefined;
  if (field.kind === "text" || field.choices.includes(written)) return written;
  const read = readQuantity(written, field.shown_unit);
  if (!("si" in read) || outside(read.si, field) !== null) return undefined;
  return field.kind === "count" && !Number.isInteger(read.si) ? undefined : read.text;
}

function placeholderOf(field: FormField, force: ForceValue | undefined): string {
  if (field.default !== null) return field.default_text;
  return force?.value == null ? t("machine.byDesign") : force.text;
}

/** A slider over a part of the bounds; it follows a value that is typed outside of that part. */
function ValueSlider({ model, field, value }: RowProps & { value: number }) {
  const whole = field.kind === "count";
  const kept = useRef<{ scale: Scale; field: FormField } | null>(null);
  if (kept.current?.field !== field || !onScale(value, kept.current.scale)) {
    const usual = typeof field.default === "number" ? scaleAround(field.default, field, field.shown_unit, whole) : null;
    const scale = usual && onScale(value, usual) ? usual : scaleAround(value, field, field.shown_unit, whole);
    kept.current = { scale, field };
  }
  const { scale } = kept.current;
  return (
    <Slider
      bare
      label={t("machine.adjust", { name: labelOf(field) })}
      value={Math.round(positionOf(value, scale))}
      min={0}
      max={STEPS}
      step={whole ? Math.max(1, STEPS / Math.max(1, scale.high - scale.low)) : 1}
      text={formatQuantity(value, field.shown_unit)}
      onInput={(position) => model.drag(field.name, textAt(position, scale, field.shown_unit, field as Bounds))}
      onCommit={() => model.drop()}
    />
  );
}
