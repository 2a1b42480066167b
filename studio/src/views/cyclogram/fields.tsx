/** Fields of a cyclogram's file: quantities that may be left out, and names. */
import { useEffect, useState } from "preact/hooks";
import { t } from "../../text";
import { QuantityField, quantityText, TextField } from "../../ui";
import type { Quantity } from "./model";

interface EntryProps {
  label: string;
  value: Quantity | undefined;
  unit: string;
  placeholder?: string;
  onChange: (value: Quantity | undefined) => void;
}

/** A quantity of the file as it is written there; an empty field leaves it out. */
export function EntryField({ label, value, unit, placeholder = "", onChange }: EntryProps) {
  return (
    <QuantityField
      label={label}
      value={typeof value === "number" ? quantityText(value, unit) : (value ?? "")}
      unit={unit}
      optional
      placeholder={placeholder}
      onChange={(text) => onChange(text === "" ? undefined : text)}
    />
  );
}

interface NameProps {
  label: string;
  value: string;
  taken?: readonly string[];
  /** Whether the text may be empty. */
  optional?: boolean;
  onCommit: (name: string) => void;
}

/** A name that is taken when it is complete: on Enter, or when the field is left. */
export function NameField({ label, value, taken = [], optional = false, onCommit }: NameProps) {
  const [draft, setDraft] = useState(value);
  useEffect(() => setDraft(value), [value]);
  const name = draft.trim();
  const used = name !== value && taken.includes(name);
  const wrong = used || (name === "" && !optional);
  return (
    <TextField
      label={label}
      value={draft}
      error={used ? t("cyclogram.taken", { name }) : wrong ? t("cyclogram.nameNeeded") : undefined}
      onChange={setDraft}
      onCommit={() => !wrong && name !== value && onCommit(name)}
    />
  );
}
