/** Numbers and texts of the file as fields: each is written as the file has it, and taken over with Enter or on leaving. */
import { useState } from "preact/hooks";
import { t } from "../../text";
import { choicesOf, entryAt, hintOf, lackingKeys } from "./declaration";
import type { Editor } from "./editor";
import { apply, type Entry, type Table } from "./mechanism";

interface EntryFieldProps {
  label: string;
  value: string;
  /** What it means, and its unit. */
  hint?: string;
  /** Among which it is chosen; without them it is typed. */
  choices?: readonly string[] | undefined;
  /** Takes over a text; returns false where it cannot be. */
  onCommit: (text: string) => unknown;
}

/** A text that is taken over with Enter or on leaving; Escape brings the old one back. */
export function EntryField({ label, value, hint = "", choices, onCommit }: EntryFieldProps) {
  const [draft, setDraft] = useState({ of: value, text: value });
  const reset = () => setDraft({ of: value, text: value });
  const commit = (typed: string) => {
    if (typed.trim() !== value && onCommit(typed.trim()) === false) reset();
  };
  if (choices?.includes(value)) {
    return (
      <label class="linkage-entry" title={hint}>
        <span>{label}</span>
        <select class="ui-input" value={value} onChange={(event) => commit(event.currentTarget.value)}>
          {choices.map((choice) => (
            <option key={choice}>{choice}</option>
          ))}
        </select>
      </label>
    );
  }
  return (
    <label class="linkage-entry" title={hint}>
      <span>{label}</span>
      <input
        class="ui-input"
        type="text"
        autocomplete="off"
        spellcheck={false}
        value={draft.of === value ? draft.text : value}
        onInput={(event) => setDraft({ of: value, text: event.currentTarget.value })}
        onBlur={(event) => commit(event.currentTarget.value)}
        onKeyDown={(event) => {
          if (event.key === "Enter") commit(event.currentTarget.value);
          if (event.key === "Escape") reset();
          event.stopPropagation();
        }}
      />
    </label>
  );
}

/** A text as an entry of the file: a plain number where it is one, else text; true and false are themselves. */
export function entryOf(text: string): string | number | boolean {
  if (text === "true" || text === "false") return text === "true";
  return text !== "" && /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : text;
}

/** Every number and text below a table of the file: keys that lead to it, and its value. */
export function leaves(entry: unknown, path: readonly string[] = []): { path: readonly string[]; value: string }[] {
  if (Array.isArray(entry)) return entry.flatMap((one, index) => leaves(one, [...path, String(index)]));
  if (entry !== null && typeof entry === "object") {
    return Object.entries(entry).flatMap(([key, value]) => leaves(value, [...path, key]));
  }
  return [{ path, value: String(entry) }];
}

/** What the two places of a list are called: of two bodies, of two points, else of coordinates. */
function places(path: readonly string[]): readonly string[] {
  const kind = path.includes("torsion") ? t("linkage.onBody") : path.includes("between") ? t("linkage.atPoint") : "";
  return kind === "" ? ["x", "y"] : [`${kind} 1`, `${kind} 2`];
}

/** The name of an entry: "A x", "mass", "force1 on body". */
export function entryLabel(path: readonly string[]): string {
  const shown = path.filter((key) => key !== "points");
  const names = places(shown);
  return shown
    .map((key, index) => {
      if (index === 0 || !/^\d+$/.test(key)) return key;
      return index === shown.length - 1 ? (names[Number(key)] ?? key) : String(Number(key) + 1);
    })
    .join(" ");
}

interface EntriesProps {
  editor: Editor;
  /** Keys that lead to the table. */
  path: readonly string[];
  table: Table | undefined;
  skip?: readonly string[];
}

/** The entries below a table of the file as fields, as they are declared. */
export function Entries({ editor, path, table, skip = [] }: EntriesProps) {
  if (table === undefined) return null;
  const data = editor.document.data.value ?? {};
  const kept = Object.fromEntries(Object.entries(table).filter(([key]) => !skip.includes(key)));
  const set = (keys: readonly string[], value: Entry) =>
    editor.edit((copy) => apply(copy, [{ path: [...path, ...keys], value }]));
  return (
    <div class="linkage-entries">
      {leaves(kept).map((leaf) => {
        const declared = entryAt(data, [...path, ...leaf.path]);
        return (
          <EntryField
            key={leaf.path.join(".")}
            label={entryLabel(leaf.path)}
            value={leaf.value}
            hint={hintOf(declared)}
            choices={choicesOf(declared, data)}
            onCommit={(text) => set(leaf.path, entryOf(text))}
          />
        );
      })}
      <Lacking data={data} path={path} table={table} onAdd={set} />
    </div>
  );
}

interface LackingProps {
  data: Table;
  path: readonly string[];
  table: Table;
  onAdd: (keys: readonly string[], value: Entry) => void;
}

/** The optional keys that a table, or the only table in it, does not have yet. */
function Lacking({ data, path, table, onAdd }: LackingProps) {
  const [name, inner] = Object.entries(table)[0] ?? [];
  const isNamed = entryAt(data, path).properties === undefined && name !== undefined;
  const [keys, own] = isNamed ? [[name], inner] : [[], table];
  if (own === null || typeof own !== "object") return null;
  const entry = entryAt(data, [...path, ...keys]);
  const lacking = lackingKeys(entry, own);
  if (lacking.length === 0) return null;
  return (
    <select
      class="ui-input"
      aria-label={t("linkage.addKey")}
      value=""
      onChange={(event) => {
        const found = lacking.find(([key]) => key === event.currentTarget.value);
        event.currentTarget.value = "";
        if (found) onAdd([...keys, found[0]], found[1]);
      }}
    >
      <option value="">{t("linkage.addKey")}</option>
      {lacking.map(([key]) => (
        <option key={key} value={key} title={hintOf(entry.properties?.[key] ?? {})}>
          {key}
        </option>
      ))}
    </select>
  );
}
