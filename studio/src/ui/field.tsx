/** What all fields have in common: label, help, and an error that is tied to the input. */
import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { Icon } from "./icons";

export interface FieldProps {
  label: string;
  /** Symbol of the literature beside the label. */
  symbol?: string | undefined;
  help?: string | undefined;
  error?: string | undefined;
  /** Bounds, at the right of the label. */
  aside?: string | undefined;
}

interface Tied {
  id: string;
  "aria-invalid": boolean | undefined;
  "aria-describedby": string | undefined;
}

export function Field(props: FieldProps & { children: (tied: Tied) => ComponentChildren }) {
  const id = useId();
  const { label, symbol, help, error, aside } = props;
  const about = [error && `${id}-error`, aside && `${id}-aside`, help && `${id}-help`].filter(Boolean).join(" ");
  return (
    <div class="ui-field">
      <div class="ui-field-head">
        <label for={id}>{label}</label>
        {symbol && <span class="ui-symbol">{symbol}</span>}
        {aside && (
          <span class="ui-bounds" id={`${id}-aside`}>
            {aside}
          </span>
        )}
      </div>
      {props.children({
        id,
        "aria-invalid": error ? true : undefined,
        "aria-describedby": about || undefined,
      })}
      {error && (
        <p class="ui-error" id={`${id}-error`}>
          <Icon name="warning" />
          <span>{error}</span>
        </p>
      )}
      {help && (
        <p class="ui-help" id={`${id}-help`}>
          {help}
        </p>
      )}
    </div>
  );
}
