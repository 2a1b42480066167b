import { useEffect, useState } from "preact/hooks";
import { t } from "../../text";
import { Field } from "../../ui/field";
import type { CarpetModel } from "./model";

export interface SettingProps {
  model: CarpetModel;
  name: string;
  label: string;
  help?: string;
}

/** Texts whose numbers are above 0. */
const MEASURES: ReadonlySet<string> = new Set(["size", "quality"]);

/** Whether a measure has a number that is 0: it is not written into the file. */
export function hasNothing(text: string): boolean {
  return (text.match(/\d+(?:[.,]\d+)?/g) ?? []).some((number) => Number(number.replace(",", ".")) === 0);
}

/** A text of the recipe, taken when the field is left or Enter is pressed. */
export function TextSetting({ model, name, label, help }: SettingProps) {
  const value = model.text(name);
  const [draft, setDraft] = useState(value);
  useEffect(() => setDraft(value), [value]);
  const error = MEASURES.has(name) && hasNothing(draft) ? t("carpet.notZero") : undefined;
  return (
    <Field label={label} help={help} error={error}>
      {(tied) => (
        <input
          {...tied}
          class="ui-input"
          type="text"
          autocomplete="off"
          spellcheck={false}
          value={draft}
          onInput={(event) => setDraft(event.currentTarget.value)}
          onChange={(event) => error === undefined && model.set({ [name]: event.currentTarget.value.trim() })}
        />
      )}
    </Field>
  );
}
