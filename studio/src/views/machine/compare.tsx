import type { CheckDifference, Difference } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button, Icon } from "../../ui";
import { keyOf } from "./effects";
import type { MachineModel } from "./model";

/** Buttons that keep, switch and forget B. */
export function CompareButtons({ model }: { model: MachineModel }) {
  const kept = model.b.value !== null;
  return (
    <div class="ui-row">
      <Button icon="keep" onClick={() => model.keepAsB()}>
        {t("machine.keepAsB")}
      </Button>
      <Button disabled={!kept} onClick={() => model.switchWithB()}>
        {t("machine.switch")}
      </Button>
      <Button kind="quiet" disabled={!kept} onClick={() => model.forgetB()}>
        {t("machine.forget")}
      </Button>
    </div>
  );
}

/** The first parameters that differ from B, in a line. */
export function Differences({ model }: { model: MachineModel }) {
  const rows = model.comparison.value?.parameters ?? [];
  return rows.slice(0, 2).map((row) => (
    <span key={keyOf(row.machine, row.name)} class="machine-difference">
      {row.name.replaceAll("_", " ")} <b>A {row.a || "–"}</b> <b class="b">B {row.b || "–"}</b>
    </span>
  ));
}

/** What differs between A, the settings now, and B, the settings kept. */
export function Compare({ model }: { model: MachineModel }) {
  const found = model.comparison.value;
  return (
    <div class="ui-stack">
      {model.b.value === null && <p class="ui-muted">{t("machine.noB")}</p>}
      {found !== null && (
        <>
          <p class="ui-row">
            <Count name={t("machine.a")} failed={found.a_failed} />
            <Count name={t("machine.b")} failed={found.b_failed} />
          </p>
          {found.parameters.length + found.results.length + found.checks.length === 0 && <p>{t("machine.same")}</p>}
          <Rows title={t("machine.parameters")} rows={found.parameters} />
          <CheckRows rows={found.checks} />
          <Rows title={t("machine.results")} rows={found.results} />
        </>
      )}
    </div>
  );
}

function Count({ name, failed }: { name: string; failed: number }) {
  return (
    <span class={`ui-badge ${failed === 0 ? "good" : "bad"}`}>
      <Icon name={failed === 0 ? "good" : "error"} />
      {name}: {failed === 0 ? t("ui.allHold") : t("ui.someFail", { count: failed })}
    </span>
  );
}

function Head({ title }: { title: string }) {
  return (
    <thead>
      <tr>
        <th scope="col">{title}</th>
        <th scope="col" class="number">
          {t("machine.a")}
        </th>
        <th scope="col" class="number">
          {t("machine.b")}
        </th>
        <th scope="col" class="number">
          {t("machine.change")}
        </th>
      </tr>
    </thead>
  );
}

function Rows({ title, rows }: { title: string; rows: readonly Difference[] }) {
  if (rows.length === 0) return null;
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={title}>
      <table class="ui-table machine-compare">
        <Head title={title} />
        <tbody>
          {rows.map((row) => (
            <tr key={keyOf(row.machine, row.name)}>
              <th scope="row">
                {row.machine !== "" && <span class="ui-muted">{row.machine}: </span>}
                {row.name.replaceAll("_", " ")}
              </th>
              <td class="number fig-lines">{row.a || "–"}</td>
              <td class="number fig-lines">{row.b || "–"}</td>
              <td class="number">{changeText(row.change)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function CheckRows({ rows }: { rows: readonly CheckDifference[] }) {
  if (rows.length === 0) return null;
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("machine.checks")}>
      <table class="ui-table machine-compare">
        <Head title={t("machine.checks")} />
        <tbody>
          {rows.map((row) => (
            <tr key={keyOf(row.machine, row.name)} class={row.a_holds === row.b_holds ? "" : "machine-turned"}>
              <th scope="row">
                {row.machine !== "" && <span class="ui-muted">{row.machine}: </span>}
                {row.name}
              </th>
              <Judged text={row.a} holds={row.a_holds} />
              <Judged text={row.b} holds={row.b_holds} />
              <td class="number">{changeText(row.change)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Judged({ text, holds }: { text: string; holds: boolean | null }) {
  return (
    <td class="number">
      {text || "–"}
      {holds !== null && (
        <span class={holds ? "machine-holds" : "machine-fails"}>
          {" "}
          <Icon name={holds ? "good" : "error"} label={holds ? t("machine.ok") : t("machine.failed")} />
        </span>
      )}
    </td>
  );
}

/** A relative change in percent. */
export function changeText(change: number | null | undefined): string {
  if (change == null) return "–";
  const percent = formatNumber(Math.abs(change) * 100, 3);
  return `${change > 0 ? "+" : change < 0 ? "−" : ""}${percent} %`;
}
