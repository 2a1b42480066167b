import { useEffect, useRef, useState } from "preact/hooks";
import { t } from "../text";
import { Field, type FieldProps } from "./field";
import { Slider } from "./slider";
import { type Bounds, formatQuantity, outside, quantityText, readQuantity, spaced } from "./units";

interface QuantityProps extends Omit<FieldProps, "aside"> {
  /** The quantity as a text with its unit; "" where none is given. */
  value: string;
  /** The unit that numbers without one are taken in, "" for a plain number. */
  unit: string;
  bounds?: Bounds;
  /** Shown while the field is empty, such as the default. */
  placeholder?: string;
  /** Whether the field may be left empty. */
  optional?: boolean;
  /** Least and greatest value of a slider [SI]; without them there is none. */
  range?: readonly [number, number] | undefined;
  disabled?: boolean;
  /** A text that can be read and is within its bounds, and its value in SI; null where it is empty. */
  onChange: (text: string, si: number | null) => void;
}

/** A quantity typed freely: "60mm", "6 cm", "0.06 m"; what cannot be read, or is out of bounds, is reported at once. */
export function QuantityField(props: QuantityProps) {
  const { value, unit, bounds = {}, placeholder, optional = false, range, disabled = false, onChange } = props;
  const [draft, setDraft] = useState(spaced(value));
  const given = useRef(value);
  useEffect(() => {
    if (value !== given.current) setDraft(spaced(value));
    given.current = value;
  }, [value]);
  const own = problem(draft, unit, bounds, optional);
  const read = readQuantity(draft === "" ? (placeholder ?? "") : draft, unit);
  const give = (text: string) => {
    setDraft(text);
    if (problem(text, unit, bounds, optional) !== undefined) return;
    const made = readQuantity(text, unit);
    const [kept, si] = "si" in made ? [made.text, made.si] : ["", null];
    given.current = kept;
    onChange(kept, si);
  };
  return (
    <Field {...props} error={own ?? props.error} aside={boundsText(bounds, unit)}>
      {(tied) => {
        const input = (
          <input
            {...tied}
            class="ui-input"
            type="text"
            autocomplete="off"
            spellcheck={false}
            value={draft}
            placeholder={placeholder}
            disabled={disabled}
            required={!optional}
            onInput={(event) => give(event.currentTarget.value)}
            onBlur={() => own === undefined && setDraft(spaced(given.current))}
          />
        );
        if (range === undefined) return input;
        const si = "si" in read ? read.si : range[0];
        return (
          <div class="ui-with-slider">
            <Slider
              bare
              label={props.label}
              value={Math.min(Math.max(si, range[0]), range[1])}
              min={range[0]}
              max={range[1]}
              text={formatQuantity(si, unit)}
              disabled={disabled}
              onInput={(to) => give(quantityText(to, unit, 4))}
            />
            {input}
          </div>
        );
      }}
    </Field>
  );
}

/** What is wrong with a text; undefined where nothing is. */
export function problem(text: string, unit: string, bounds: Bounds, optional: boolean): string | undefined {
  if (text.trim() === "" && optional) return undefined;
  const example = exampleOf(unit, bounds);
  const read = readQuantity(text, unit);
  if ("error" in read) {
    if (read.error === "notQuantity" || read.error === "notNumber") return t(`ui.${read.error}`, { example });
    return t(`ui.${read.error}`, { unit: read.unit, example });
  }
  const side = outside(read.si, bounds);
  const bound = boundsText(bounds, unit) ?? "";
  if (side === null) return undefined;
  return side === "small" ? t("ui.tooSmall", { bound }) : t("ui.tooLarge", { bound });
}

function exampleOf(unit: string, bounds: Bounds): string {
  const low = bounds.at_least ?? bounds.above ?? null;
  const high = bounds.at_most ?? bounds.below ?? null;
  const middle = low !== null && high !== null && high - low < 1e3 * Math.abs(low) ? (low + high) / 2 : null;
  if (middle !== null) return quantityText(middle, unit, 2);
  return unit === "" || unit === "1" ? "60" : `60${unit.replace(/^1\//, "/")}`;
}

/** Bounds in words, "0.1 to 100 mm"; undefined where there are none. */
export function boundsText(bounds: Bounds, unit: string): string | undefined {
  const { above, at_least: least, below, at_most: most } = bounds;
  const show = (si: number) => formatQuantity(si, unit);
  if (least != null && most != null) return t("ui.fromTo", { low: show(least), high: show(most) });
  const low =
    least != null ? t("ui.from", { low: show(least) }) : above != null ? t("ui.above", { low: show(above) }) : "";
  const high =
    most != null ? t("ui.to", { high: show(most) }) : below != null ? t("ui.below", { high: show(below) }) : "";
  return [low, high].filter(Boolean).join(", ") || undefined;
}
