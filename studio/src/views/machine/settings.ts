/** Settings of a machine file: by dotted names, whether the file has them so or as nested tables. */

export type Setting = string | number | boolean;
export type Settings = Readonly<Record<string, Setting>>;

/** The data of a machine file. */
export interface MachineFile {
  machine: string;
  settings?: Table;
}

type Table = { [name: string]: Setting | Table };

/** The settings of a file by dotted names. */
export function flat(table: Table | undefined, prefix = ""): Settings {
  const found: Record<string, Setting> = {};
  for (const [name, value] of Object.entries(table ?? {})) {
    if (typeof value === "object" && value !== null) Object.assign(found, flat(value, `${prefix}${name}.`));
    else found[`${prefix}${name}`] = value;
  }
  return found;
}

/** Changes the settings of a file in place; undefined takes a setting out. Where the file has a table, it is kept. */
export function change(file: MachineFile, changes: Readonly<Record<string, Setting | undefined>>): void {
  const settings = file.settings ?? {};
  file.settings = settings;
  for (const [name, value] of Object.entries(changes)) {
    const [table, key] = home(settings, name);
    if (value === undefined) delete table[key];
    else table[key] = value;
  }
}

/** The table that has a setting, or will have it, and its key there. */
function home(settings: Table, name: string): [Table, string] {
  if (name in settings) return [settings, name];
  const dot = name.indexOf(".");
  const inner = dot < 0 ? undefined : settings[name.slice(0, dot)];
  return typeof inner === "object" ? home(inner, name.slice(dot + 1)) : [settings, name];
}

/** The settings `to` as changes of the settings `from`. */
export function changesTo(from: Settings, to: Settings): Record<string, Setting | undefined> {
  const gone = Object.keys(from).filter((name) => !(name in to));
  return { ...Object.fromEntries(gone.map((name) => [name, undefined])), ...to };
}
