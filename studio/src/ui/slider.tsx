import { useId } from "preact/hooks";

interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  step?: number | "any";
  /** The value as it is shown and read out. */
  text: string;
  onInput: (value: number) => void;
  /** The drag or key press has ended. */
  onCommit?: (value: number) => void;
  disabled?: boolean;
  /** Label and value are not shown, only read out. */
  bare?: boolean;
}

/** A slider of the browser: arrow keys a step, Page Up and Down ten, Home and End the ends. */
export function Slider({ label, value, min, max, step = "any", text, onInput, onCommit, disabled, bare }: SliderProps) {
  const id = useId();
  const fine = step === "any" ? (max - min) / 500 : step;
  const input = (
    <input
      id={id}
      class="ui-slider"
      type="range"
      min={min}
      max={max}
      step={fine}
      value={value}
      disabled={disabled}
      aria-label={bare ? label : undefined}
      aria-valuetext={text}
      onInput={(event) => onInput(event.currentTarget.valueAsNumber)}
      onChange={(event) => onCommit?.(event.currentTarget.valueAsNumber)}
    />
  );
  if (bare) return input;
  return (
    <div class="ui-field">
      <div class="ui-field-head">
        <label for={id}>{label}</label>
        <output for={id}>{text}</output>
      </div>
      {input}
    </div>
  );
}
