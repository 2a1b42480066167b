import { useSignal, useSignalEffect } from "@preact/signals";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { latest } from "../../api/latest";
import type { ChartYarn, RowAnswer, RowRun } from "../../api/messages";
import { post } from "../../api/request";
import { remember, remembered } from "../../app/settings";
import { t } from "../../text";
import { Button, NumberField, Segments } from "../../ui";
import type { CarpetModel, Recipe } from "./model";
import { Surroundings } from "./surroundings";
import { isLight } from "./yarns";

type Direction = "right" | "left" | "alternate";

/** Where the weaver is: row from the lower edge, run in the direction of reading from 0. */
export interface Position {
  row: number;
  run: number;
  direction: Direction;
}

/** The position that a text holds, as this browser remembers it; the first row where it holds none. */
export function positionOf(text: string | null): Position {
  const [row, run, direction] = (text ?? "").split(" ");
  const known = (["right", "left", "alternate"] as const).find((one) => one === direction);
  return { row: Math.max(1, Number(row) || 1), run: Math.max(0, Number(run) || 0), direction: known ?? "alternate" };
}

/** Whether a row is read from left to right. */
export function isRightward(row: number, direction: Direction): boolean {
  return direction === "right" || (direction === "alternate" && row % 2 === 1);
}

/** One row at a time, large: the runs to tie, in the direction of reading. */
export function Weaver({ model, onClose }: { model: CarpetModel; onClose: () => void }) {
  const name = `weaver.${model.path}`;
  const position = useSignal<Position>(positionOf(remembered(name)));
  const answer = useSignal<RowAnswer | null>(null);
  const box = useRef<HTMLElement>(null);
  /** The run shown last, until that of another row is read. */
  const seen = useRef({ first: 1, cells: 1 });
  const read = useMemo(
    () =>
      latest(
        ({ recipe, row }: { recipe: Recipe; row: number }, signal) =>
          post<RowAnswer>("/carpet/row", { recipe, row, path: model.path }, signal),
        (found) => {
          answer.value = found;
        },
        () => undefined,
        PATIENCE,
      ),
    [model],
  );
  useEffect(() => {
    box.current?.focus();
    return () => read.cancel();
  }, []);
  useSignalEffect(() => {
    const [recipe, chart] = [model.recipe.value, model.chart.value];
    const { row, run, direction } = position.value;
    if (chart === null || recipe === null) return;
    if (row > chart.grid.rows) {
      position.value = { row: chart.grid.rows, run: 0, direction };
      return;
    }
    remember(name, `${row} ${run} ${direction}`);
    read({ recipe, row });
  });

  const found = answer.value;
  const { row, direction } = position.value;
  const rows = model.chart.value?.grid.rows ?? 1;
  const rightward = isRightward(row, direction);
  const runs = found === null || found.row !== row ? [] : rightward ? found.runs : [...found.runs].reverse();
  const at = Math.min(position.value.run, Math.max(0, runs.length - 1));
  const goTo = (to: number, run = 0) => {
    position.value = { row: Math.min(Math.max(to, 1), rows), run, direction };
  };
  const step = (by: number) => {
    if (at + by >= 0 && at + by < runs.length) position.value = { row, run: at + by, direction };
    else if (by > 0 && row < rows) goTo(row + 1);
    else if (by < 0 && row > 1) goTo(row - 1, Number.MAX_SAFE_INTEGER);
  };
  const key = (event: KeyboardEvent) => {
    if (event.target instanceof HTMLInputElement || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "ArrowRight" || event.key === " ") step(1);
    else if (event.key === "ArrowLeft") step(-1);
    else if (event.key === "ArrowUp") goTo(row + 1);
    else if (event.key === "ArrowDown") goTo(row - 1);
    else if (event.key === "Escape") onClose();
    else return;
    event.preventDefault();
  };
  const now = runs[at];
  if (now !== undefined) seen.current = now;
  return (
    <section class="carpet-weaver" ref={box} tabIndex={-1} aria-label={t("carpet.weaver")} onKeyDown={key}>
      <div class="ui-row">
        <h2 class="ui-grow">{t("carpet.rowOf", { row, rows })}</h2>
        <NumberField
          label={t("carpet.goToRow")}
          value={row}
          min={1}
          max={rows}
          onChange={(to) => goTo(Math.round(to))}
        />
        <Segments
          label={t("carpet.direction")}
          value={direction}
          choices={[
            { value: "alternate", label: t("carpet.alternate") },
            { value: "right", label: t("carpet.rightward") },
            { value: "left", label: t("carpet.leftward") },
          ]}
          onChange={(chosen) => {
            position.value = { row, run: 0, direction: chosen };
          }}
        />
        <Button icon="close" onClick={onClose}>
          {t("carpet.backToChart")}
        </Button>
      </div>
      <p class="carpet-now" role="status">
        {now !== undefined && found !== null && (
          <>
            <Swatch yarn={found.yarns[now.yarn]} />
            <span>{t("carpet.runNow", { knots: countText(now), yarn: yarnText(now, found, rightward) })}</span>
            <small>
              {t("carpet.runPosition", {
                run: at + 1,
                runs: runs.length,
                columns: found.columns,
                ...cellsOf(now, found, rightward),
              })}
            </small>
          </>
        )}
      </p>
      <div class="carpet-strip" tabIndex={0} role="region" aria-label={t("carpet.runs")}>
        <ol class="carpet-runs">
          {found !== null &&
            runs.map((run, index) => <RunCell key={index} run={run} answer={found} now={index === at} />)}
        </ol>
      </div>
      <div class="ui-row carpet-steps">
        <Button icon="left" disabled={row === 1 && at === 0} onClick={() => step(-1)}>
          {t("carpet.runBefore")}
        </Button>
        <Button icon="right" kind="primary" disabled={row === rows && at >= runs.length - 1} onClick={() => step(1)}>
          {t("carpet.nextRun")}
        </Button>
        <Button icon="down" disabled={row <= 1} onClick={() => goTo(row - 1)}>
          {t("carpet.rowBefore")}
        </Button>
        <Button icon="up" disabled={row >= rows} onClick={() => goTo(row + 1)}>
          {t("carpet.nextRow")}
        </Button>
      </div>
      {model.chart.value !== null && (
        <Surroundings model={model} row={row} first={seen.current.first - 1} cells={seen.current.cells} />
      )}
      <pre class="carpet-line" tabIndex={0} role="region" aria-label={t("carpet.rowsText")}>
        {found === null ? "" : `${found.rightward}\n${found.leftward}`}
      </pre>
      <p class="ui-help">{t("carpet.weaverKeys")}</p>
    </section>
  );
}

/** Time after which a row that is read is given up for a newer one [ms]: the first one makes the whole chart. */
const PATIENCE = 60_000;

const HALF = 1;
const JUFTI = 2;

/** Number of a run's knots as it is called: 12, of half knots 2½, of jufti knots 3j. */
export function countText(run: RowRun): string {
  return `${run.knots}${run.mark === HALF ? "½" : run.mark === JUFTI ? "j" : ""}`;
}

/** First and last cell of a run, from 1 in the direction of reading. */
export function cellsOf(run: RowRun, { columns }: { columns: number }, rightward: boolean) {
  const first = rightward ? run.first : columns - run.first - run.cells + 2;
  return { first, last: first + run.cells - 1 };
}

/** The yarn of a run, of half knots both in the direction of reading. */
function yarnText(run: RowRun, answer: RowAnswer, rightward: boolean): string {
  const pair = [answer.yarns[run.yarn]?.name ?? "", answer.yarns[run.second]?.name ?? ""];
  return run.mark === HALF ? (rightward ? pair : pair.reverse()).join(" + ") : (pair[0] ?? "");
}

function Swatch({ yarn }: { yarn: ChartYarn | undefined }) {
  const srgb = yarn?.srgb ?? "#888888";
  return (
    <span class="carpet-swatch large" style={{ background: srgb }} aria-hidden="true">
      <span class={isLight(srgb) ? "on-light" : "on-dark"}>{yarn?.symbol}</span>
    </span>
  );
}

function RunCell({ run, answer, now }: { run: RowRun; answer: RowAnswer; now: boolean }) {
  const item = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (now) item.current?.scrollIntoView({ block: "nearest", inline: "center" });
  }, [now]);
  const yarn = answer.yarns[run.yarn];
  return (
    <li ref={item} class={now ? "now" : ""} aria-current={now ? "step" : undefined}>
      <Swatch yarn={yarn} />
      <strong>{countText(run)}</strong>
      <span>{yarn?.name}</span>
    </li>
  );
}
