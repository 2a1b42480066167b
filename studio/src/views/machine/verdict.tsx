import type { DesignView, ShownCheck } from "../../api/messages";
import { formatNumber, formatSpan, t } from "../../text";
import { Icon } from "../../ui";
import { keyOf } from "./effects";
import type { MachineModel } from "./model";

/** Reasons listed in the verdict. */
const MOST_REASONS = 4;

/** Whether the machine does its work; if not, the heaviest reasons with what cures them. */
export function Verdict({ model }: { model: MachineModel }) {
  const view = model.view.value;
  const failure = model.failure.value;
  return (
    <section class="machine-verdict ui-stack" aria-label={t("machine.checks")}>
      {failure !== null && (
        <div class="ui-callout bad" role="alert">
          <strong>{t("machine.noDesign")}</strong>
          <p>{[failure.given, failure.allowed].filter(Boolean).join("; ")}</p>
          {failure.do !== "" && <p>{failure.do}</p>}
          {view !== null && <p class="ui-muted">{t("machine.keptBelow")}</p>}
        </div>
      )}
      {view !== null && failure === null && <Reasons view={view} />}
      {model.nearest.value !== "" && <p class="ui-callout">{t("machine.nearest", { text: model.nearest.value })}</p>}
    </section>
  );
}

function Reasons({ view }: { view: DesignView }) {
  if (view.holds) return null;
  return (
    <div class="ui-callout bad">
      {view.reasons.slice(0, MOST_REASONS).map((reason) => (
        <p key={reason.name}>
          <b>{reason.name}</b>: {reason.text}
          {reason.cure !== "" && <span class="ui-muted"> — {reason.cure}</span>}
        </p>
      ))}
    </div>
  );
}

/** The verdict as a badge, and how long the design took. */
export function VerdictBadge({ model }: { model: MachineModel }) {
  const view = model.view.value;
  if (view === null) return null;
  const good = view.holds;
  return (
    <span class="ui-row" role="status">
      <span class={`ui-badge machine-badge ${good ? "good" : "bad"}`}>
        <Icon name={good ? "good" : "error"} />
        {good ? t("machine.holds") : t("machine.fails", { count: view.failed })}
      </span>
      <span class="ui-muted machine-time">
        {model.working.value ? t("machine.designing") : t("machine.designed", { time: formatSpan(view.seconds) })}
      </span>
    </span>
  );
}

/** The checks: value against limit, as a bar and as texts; failed ones first. */
export function Checks({ view }: { view: DesignView }) {
  const checks = [...view.checks].sort((a, b) => Number(a.ok) - Number(b.ok));
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("machine.checks")}>
      <table class="ui-table machine-checks">
        <thead>
          <tr>
            <th scope="col">{t("machine.checkName")}</th>
            <th scope="col">{t("machine.ok")}</th>
            <th scope="col" class="number">
              {t("machine.value")}
            </th>
            <th scope="col" class="number">
              {t("machine.limit")}
            </th>
            <th scope="col">{t("machine.source")}</th>
          </tr>
        </thead>
        <tbody>
          {checks.map((check) => (
            <CheckRow key={keyOf(check.machine, check.name)} check={check} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function CheckRow({ check }: { check: ShownCheck }) {
  return (
    <tr class={check.ok ? "" : "machine-failed"}>
      <th scope="row">
        {check.machine !== "" && <span class="ui-muted">{check.machine}: </span>}
        {check.name}
        {!check.ok && check.cure !== "" && <p class="ui-help">{check.cure}</p>}
      </th>
      <td>
        <span class={`ui-badge ${check.ok ? "good" : "bad"}`}>
          <Icon name={check.ok ? "good" : "error"} />
          {check.ok ? t("machine.ok") : t("machine.failed")}
        </span>
      </td>
      <td class="number">{check.value_text}</td>
      <td class="number">
        {check.relation} {check.limit_text}
        {check.ratio != null && check.limit !== 1 && (
          <span class="visually-hidden">{t("machine.share", { percent: formatNumber(100 * check.ratio, 3) })}</span>
        )}
      </td>
      <td class="ui-muted">{check.source}</td>
    </tr>
  );
}
