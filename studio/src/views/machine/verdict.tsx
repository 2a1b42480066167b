import { CheckList } from "../../draw";
import { t } from "../../text";
import { Verdict, VerdictBadge } from "../../ui";
import type { MachineModel } from "./model";

/** Why there is no design, or the checks that bind it. */
export function Judgement({ model }: { model: MachineModel }) {
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
      {view !== null && failure === null && <CheckList checks={view.checks} />}
      {model.nearest.value !== "" && <p class="ui-callout">{t("machine.nearest", { text: model.nearest.value })}</p>}
    </section>
  );
}

/** The verdict in the head of the view. */
export function MachineVerdict({ model }: { model: MachineModel }) {
  const view = model.view.value;
  if (model.failure.value !== null) return <VerdictBadge ok={false}>{t("machine.noDesign")}</VerdictBadge>;
  if (view === null) return null;
  const words = model.working.value ? t("machine.designing") : view.pending ? t("machine.pending") : undefined;
  return <Verdict checks={view.checks} words={words} />;
}
