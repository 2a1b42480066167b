import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { formatNumber, t } from "../text";
import { Icon } from "./icons";
import { fromSi, shownUnit } from "./units";

export interface TableColumn {
  heading: string;
  unit?: string;
  digits?: number;
}

export type Cell = string | number | boolean | null;

interface TableProps {
  label: string;
  columns: readonly TableColumn[];
  /** SI numbers and texts. */
  rows: readonly (readonly Cell[])[];
  /** Greatest height before it scrolls. */
  height?: string | undefined;
  /** Shows the label above the rows. */
  captioned?: boolean;
  /** Shown instead of rows where there are none. */
  empty?: ComponentChildren;
}

/** Rows under headings with units; a heading sorts by its column. */
export function Table({ label, columns, rows, height, empty, captioned = false }: TableProps) {
  const [order, setOrder] = useState<{ column: number; up: boolean } | null>(null);
  if (rows.length === 0 && empty !== undefined) return <p class="ui-muted">{empty}</p>;
  const sorted = order === null ? rows : [...rows].sort((a, b) => compare(a[order.column], b[order.column], order.up));
  const sort = (column: number) => {
    setOrder(order?.column !== column ? { column, up: true } : order.up ? { column, up: false } : null);
  };
  const numeric = columns.map((_, at) => rows.every((row) => isNumeric(row[at])));
  return (
    <div
      class="ui-table-scroll"
      style={height ? { maxHeight: height } : {}}
      tabIndex={0}
      role="region"
      aria-label={label}
    >
      <table class="ui-table">
        {captioned && <caption>{label}</caption>}
        <thead>
          <tr>
            {columns.map((column, at) => {
              const up = order?.column === at ? order.up : null;
              return (
                <th
                  key={at}
                  scope="col"
                  class={numeric[at] ? "number" : ""}
                  aria-sort={up === null ? "none" : up ? "ascending" : "descending"}
                >
                  <button
                    type="button"
                    class="ui-sort"
                    title={t("figure.sortBy", { column: column.heading })}
                    onClick={() => sort(at)}
                  >
                    {headingText(column)}
                    {up !== null && <Icon name={up ? "up" : "down"} />}
                  </button>
                </th>
              );
            })}
          </tr>
        </thead>
        <tbody>
          {sorted.map((row, index) => (
            <tr key={index}>
              {columns.map((column, at) => {
                const text = cellText(row[at] ?? null, column);
                return at === 0 ? (
                  <th key={at} scope="row" class={numeric[at] ? "number" : ""}>
                    {text}
                  </th>
                ) : (
                  <td key={at} class={numeric[at] ? "number" : ""}>
                    {text}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** Whether a cell holds a number, or a dash in its stead. */
function isNumeric(cell: Cell | undefined): boolean {
  return typeof cell !== "string" || /^[-–]?$/.test(cell);
}

/** A heading with its unit in brackets. */
function headingText(column: TableColumn): string {
  const unit = shownUnit(column.unit ?? "");
  return unit === "" ? column.heading : `${column.heading} [${unit}]`;
}

/** A cell as it is shown: SI numbers in the unit of the column. */
function cellText(cell: Cell, column: TableColumn): string {
  if (cell === null) return "–";
  if (typeof cell === "boolean") return cell ? t("figure.yes") : t("figure.no");
  return typeof cell === "string" ? cell : formatNumber(fromSi(cell, column.unit ?? ""), column.digits ?? 4);
}

function compare(a: Cell | undefined, b: Cell | undefined, up: boolean): number {
  const sign = up ? 1 : -1;
  if (typeof a === "number" && typeof b === "number") return sign * (a - b);
  return sign * String(a ?? "").localeCompare(String(b ?? ""));
}
