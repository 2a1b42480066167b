/** Equality and differences of plain data. */

export interface Difference {
  /** Keys from the whole to the value, joined by dots. */
  path: string;
  mine: string;
  theirs: string;
}

type Table = Record<string, unknown>;

function isTable(value: unknown): value is Table {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Whether two values of plain data are the same. */
export function isSame(one: unknown, other: unknown): boolean {
  if (one === other) return true;
  if (Array.isArray(one) && Array.isArray(other))
    return one.length === other.length && one.every((value, index) => isSame(value, other[index]));
  if (!isTable(one) || !isTable(other)) return false;
  const keys = Object.keys(one);
  return keys.length === Object.keys(other).length && keys.every((key) => key in other && isSame(one[key], other[key]));
}

/** The values in which two states differ, the innermost ones; at most `most`. */
export function differences(mine: unknown, theirs: unknown, most = 200): Difference[] {
  const found: Difference[] = [];
  compare(mine, theirs, [], found, most);
  return found;
}

function compare(mine: unknown, theirs: unknown, path: readonly string[], found: Difference[], most: number): void {
  if (found.length >= most || isSame(mine, theirs)) return;
  if (isTable(mine) && isTable(theirs)) {
    for (const key of new Set([...Object.keys(mine), ...Object.keys(theirs)]))
      compare(mine[key], theirs[key], [...path, key], found, most);
  } else if (Array.isArray(mine) && Array.isArray(theirs)) {
    for (let index = 0; index < Math.max(mine.length, theirs.length); index++)
      compare(mine[index], theirs[index], [...path, String(index + 1)], found, most);
  } else {
    found.push({ path: path.join("."), mine: shown(mine), theirs: shown(theirs) });
  }
}

function shown(value: unknown): string {
  if (value === undefined) return "";
  return typeof value === "string" ? value : JSON.stringify(value);
}
