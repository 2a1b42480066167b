import { ChoiceTable, ResultTable } from "../../draw";
import { t } from "../../text";
import { Tabs } from "../../ui";
import { Compare } from "./compare";
import { Figures } from "./figures";
import type { MachineModel } from "./model";
import { MachineStudy } from "./study";
import { DesignTables } from "./tables";
import { Judgement } from "./verdict";

interface OutcomeProps {
  model: MachineModel;
  tab: string;
  onTab: (tab: string) => void;
}

/** What the design is: the checks that bind, figures, results, and what differs from B. */
export function Outcome({ model, tab, onTab }: OutcomeProps) {
  const view = model.view.value;
  const tabs = [
    { value: "results", label: t("machine.results") },
    { value: "tables", label: t("machine.tables") },
    { value: "compare", label: t("machine.comparison") },
    { value: "study", label: t("study.title") },
    { value: "choices", label: t("machine.choices") },
  ];
  return (
    <div class="machine-outcome ui-stack">
      <Judgement model={model} />
      <Figures model={model} />
      {view !== null && (
        <Tabs label={view.title} value={tab} tabs={tabs} onChange={onTab}>
          {tab === "results" && <ResultTable results={view.results} />}
          {tab === "tables" && <DesignTables model={model} />}
          {tab === "compare" && <Compare model={model} />}
          <div hidden={tab !== "study"}>
            <MachineStudy model={model} shown={tab === "study"} />
          </div>
          {tab === "choices" && <Choices warnings={view.warnings} choices={view.choices} />}
        </Tabs>
      )}
    </div>
  );
}

interface ChoicesProps {
  warnings: readonly string[];
  choices: Parameters<typeof ChoiceTable>[0]["choices"];
}

/** Warnings of the design, and what it chose of what was left open. */
function Choices({ warnings, choices }: ChoicesProps) {
  return (
    <div class="ui-stack">
      {warnings.length === 0 && <p class="ui-muted">{t("machine.noWarnings")}</p>}
      {warnings.map((text) => (
        <p key={text} class="ui-callout warn">
          {text}
        </p>
      ))}
      {choices.length === 0 ? <p class="ui-muted">{t("machine.noChoices")}</p> : <ChoiceTable choices={choices} />}
    </div>
  );
}
