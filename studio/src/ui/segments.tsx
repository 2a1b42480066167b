import { useId } from "preact/hooks";

export interface Choice<T extends string> {
  value: T;
  label: string;
}

interface SegmentsProps<T extends string> {
  label: string;
  value: T;
  choices: readonly Choice<T>[];
  onChange: (value: T) => void;
  /** The label is read by screen readers only. */
  labelHidden?: boolean;
}

/** One of a few choices, all in sight; arrow keys go from one to the next. */
export function Segments<T extends string>({ label, value, choices, onChange, labelHidden = false }: SegmentsProps<T>) {
  const name = useId();
  return (
    <fieldset class="ui-segments">
      <legend class={labelHidden ? "visually-hidden" : ""}>{label}</legend>
      <div class="ui-group">
        {choices.map((choice) => (
          <label key={choice.value}>
            <input
              type="radio"
              name={name}
              value={choice.value}
              checked={choice.value === value}
              onChange={() => onChange(choice.value)}
            />
            <span>{choice.label}</span>
          </label>
        ))}
      </div>
    </fieldset>
  );
}
