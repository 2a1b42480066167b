import { Field, type FieldProps } from "./field";
import { Icon } from "./icons";
import type { Choice } from "./segments";

interface SelectProps<T extends string> extends Omit<FieldProps, "aside"> {
  value: T;
  choices: readonly Choice<T>[];
  disabled?: boolean;
  onChange: (value: T) => void;
}

export function Select<T extends string>({ value, choices, disabled = false, onChange, ...rest }: SelectProps<T>) {
  return (
    <Field {...rest}>
      {(tied) => (
        <select
          {...tied}
          class="ui-input"
          value={value}
          disabled={disabled}
          onChange={(event) => onChange(event.currentTarget.value as T)}
        >
          {choices.map((choice) => (
            <option key={choice.value} value={choice.value} selected={choice.value === value}>
              {choice.label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

interface TextProps extends Omit<FieldProps, "aside"> {
  value: string;
  placeholder?: string;
  disabled?: boolean;
  onChange: (value: string) => void;
  /** The text is complete: Enter, or the field is left. */
  onCommit?: (value: string) => void;
}

/** A text without rules. */
export function TextField({ value, placeholder, disabled = false, onChange, onCommit, ...rest }: TextProps) {
  return (
    <Field {...rest}>
      {(tied) => (
        <input
          {...tied}
          class="ui-input"
          type="text"
          autocomplete="off"
          value={value}
          placeholder={placeholder}
          disabled={disabled}
          onInput={(event) => onChange(event.currentTarget.value)}
          onChange={(event) => onCommit?.(event.currentTarget.value)}
        />
      )}
    </Field>
  );
}

/** Words that are searched for. */
export function SearchField({ label, value, onChange }: Pick<TextProps, "label" | "value" | "onChange">) {
  return (
    <label class="ui-search">
      <Icon name="search" />
      <input
        class="ui-input"
        type="search"
        aria-label={label}
        placeholder={label}
        value={value}
        onInput={(event) => onChange(event.currentTarget.value)}
      />
    </label>
  );
}

interface ToggleProps {
  label: string;
  value: boolean;
  disabled?: boolean;
  onChange: (value: boolean) => void;
}

/** A switch. */
export function Toggle({ label, value, disabled = false, onChange }: ToggleProps) {
  return (
    <label class="ui-toggle">
      <input
        type="checkbox"
        role="switch"
        aria-checked={value}
        checked={value}
        disabled={disabled}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      <span>{label}</span>
    </label>
  );
}
