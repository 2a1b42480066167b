/** The form of a machine: which parameters are shown, in which groups. */
import type { FormField } from "../../api/messages";
import type { Settings } from "./settings";

export interface Filter {
  /** Words that must all occur in name, symbol, meaning or alias. */
  words: string;
  /** Only parameters that are set. */
  changed: boolean;
  /** The other machine whose parameters are shown; "" for the machine's own. */
  machine: string;
}

export interface Group {
  /** What stands before the last dot of the names; "" for the machine's own. */
  name: string;
  fields: readonly FormField[];
}

/** The fields that a filter lets through, by group, in the order of the declaration. */
export function groupsOf(fields: readonly FormField[], settings: Settings, filter: Filter): Group[] {
  const words = filter.words.toLowerCase().split(/\s+/).filter(Boolean);
  const groups = new Map<string, FormField[]>();
  for (const field of fields) {
    const anywhere = words.length > 0 || filter.changed;
    if (!anywhere && field.machine !== filter.machine) continue;
    if (filter.changed && !isSet(field, settings)) continue;
    if (!words.every((word) => textOf(field).includes(word))) continue;
    const group = groups.get(field.group);
    if (group === undefined) groups.set(field.group, [field]);
    else group.push(field);
  }
  return [...groups].map(([name, of]) => ({ name, fields: of }));
}

/** Whether a parameter is set, by its name or its alias. */
export function isSet(field: FormField, settings: Settings): boolean {
  return nameIn(field, settings) !== undefined;
}

/** The name under which a parameter is set. */
export function nameIn(field: FormField, settings: Settings): string | undefined {
  if (field.name in settings) return field.name;
  return field.alias !== "" && field.alias in settings ? field.alias : undefined;
}

/** A group's name in words: `weaver.side_grippers` is "weaver › side grippers". */
export function groupLabel(name: string): string {
  return name.replaceAll("_", " ").split(".").join(" › ");
}

/** The last part of a parameter's name, in words: `beat_force` is "beat force". */
export function labelOf(field: FormField): string {
  return (field.name.split(".").at(-1) ?? field.name).replaceAll("_", " ");
}

function textOf(field: FormField): string {
  return `${field.name} ${field.name.replaceAll("_", " ")} ${field.symbol} ${field.alias} ${field.doc}`.toLowerCase();
}
