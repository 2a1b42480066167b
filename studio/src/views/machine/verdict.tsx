import type { DesignView } from "../../api/messages";
import { formatSpan, t } from "../../text";
import { Icon } from "../../ui";
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
          <b>{reason.name}</b>: {reason.value_text}
          {reason.limit_text !== "" && t("machine.mustBe", { limit: reason.limit_text })}
          {reason.cure !== "" && <span class="ui-muted"> — {reason.cure}</span>}
        </p>
      ))}
    </div>
  );
}

/** The verdict as a badge, and how long the design took. */
export function VerdictBadge({ model }: { model: MachineModel }) {
  const view = model.view.value;
  const failure = model.failure.value;
  if (view === null && failure === null) return null;
  const good = view?.holds === true && failure === null;
  const pending = good && view.pending;
  return (
    <span class="ui-row" role="status">
      <span class={`ui-badge machine-badge ${good ? "good" : "bad"}`}>
        <Icon name={good ? "good" : "error"} />
        {failure !== null || view === null
          ? t("machine.noDesign")
          : pending
            ? t("machine.pending")
            : good
              ? t("machine.holds")
              : t("machine.fails", { count: view.failed })}
      </span>
      <span class="ui-muted machine-time">
        {model.working.value
          ? t("machine.designing")
          : view !== null && failure === null && t("machine.designed", { time: formatSpan(view.seconds) })}
      </span>
    </span>
  );
}
