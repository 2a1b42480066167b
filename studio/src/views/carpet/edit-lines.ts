/** The edits of a recipe: lines, and tables [[edits]] of lines that count the knots of a stated grid. */

interface Table {
  lines: readonly string[];
  [key: string]: unknown;
}

type Entry = string | Table;

function entriesOf(recipe: object | null): readonly Entry[] {
  const edits = (recipe as { edits?: unknown } | null)?.edits;
  return Array.isArray(edits) ? (edits as Entry[]) : [];
}

function isTable(entry: Entry | undefined): entry is Table {
  return typeof entry === "object" && entry !== null && Array.isArray(entry.lines);
}

/** What the knots of a line are: those of the design at every size, of one size only, or of a part, as "motif 2". */
export type Anchor = "carpet" | "knots" | (string & {});

export interface EditLine {
  line: string;
  on: Anchor;
}

/** All lines with what their knots are, in the order in which they are applied. */
export function placedLines(recipe: object | null): readonly EditLine[] {
  return piecesOf(recipe).map(({ line, table }) => ({ line, on: String(table?.["on"] ?? "carpet") }));
}

interface Piece {
  line: string;
  table: Omit<Table, "lines"> | null;
}

function piecesOf(recipe: object | null): readonly Piece[] {
  return entriesOf(recipe).flatMap((entry): Piece[] => {
    if (!isTable(entry)) return [{ line: entry as string, table: null }];
    const { lines, ...table } = entry;
    return lines.map((line) => ({ line, table }));
  });
}

/** The edits where the line of a number, counted over all, is on something else; grid: where it states none. */
export function withAnchor(recipe: object | null, number: number, on: Anchor, grid: string): readonly Entry[] {
  const entries: Entry[] = [];
  piecesOf(recipe).forEach(({ line, table: own }, index) => {
    const stated = own !== null && ("grid" in own || "size" in own) ? own : { grid, ...own };
    const table: Omit<Table, "lines"> | null = index === number ? { ...stated, on } : own;
    const last = entries.at(-1);
    if (table === null) entries.push(line);
    else if (isTable(last) && isSame(table, last))
      entries[entries.length - 1] = { ...last, lines: [...last.lines, line] };
    else entries.push({ ...table, lines: [line] });
  });
  return entries;
}

function isSame(table: object, last: Table): boolean {
  const { lines: _, ...other } = last;
  return JSON.stringify(Object.entries(table).sort()) === JSON.stringify(Object.entries(other).sort());
}

/** The edits with more lines at the end: in the last table, where its knots are those of this grid, else behind it. */
export function withLines(recipe: object | null, lines: readonly string[], grid: string): readonly Entry[] {
  const entries = entriesOf(recipe);
  const last = entries[entries.length - 1];
  if (!isTable(last)) return [...entries, ...lines];
  if (last["on"] === undefined || last["on"] === "carpet")
    if (last["grid"] === grid) return [...entries.slice(0, -1), { ...last, lines: [...last.lines, ...lines] }];
  return [...entries, { on: "carpet", grid, lines }];
}

/** The edits where those that state no grid are in tables of this one: they stay in their place at another size. */
export function anchored(recipe: object | null, grid: string): readonly Entry[] | null {
  const tables: Table[] = [];
  for (const entry of entriesOf(recipe)) {
    const last = tables[tables.length - 1];
    if (isTable(entry)) tables.push(entry);
    else if (last?.["grid"] === grid && last["on"] === "carpet")
      tables[tables.length - 1] = { ...last, lines: [...last.lines, entry] };
    else tables.push({ on: "carpet", grid, lines: [entry] });
  }
  return tables.length > 0 ? tables : null;
}

/** The edits without the line of a number, counted over all; null where none is left. */
export function withoutLine(recipe: object | null, number: number): readonly Entry[] | null {
  let before = 0;
  const left = entriesOf(recipe).flatMap((entry): Entry[] => {
    const at = number - before;
    if (!isTable(entry)) {
      before += 1;
      return at === 0 ? [] : [entry];
    }
    before += entry.lines.length;
    const lines = entry.lines.filter((_, index) => index !== at);
    return lines.length > 0 ? [{ ...entry, lines }] : [];
  });
  return left.length > 0 ? left : null;
}
