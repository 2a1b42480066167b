import { t } from "../../text";
import { Tabs } from "../../ui";
import { Command } from "./command";
import { Compare } from "./compare";
import type { MachineModel } from "./model";
import { Choices, Results } from "./results";
import { Checks, Verdict } from "./verdict";

interface OutcomeProps {
  model: MachineModel;
  tab: string;
  onTab: (tab: string) => void;
}

/** What the design is: verdict, figures, checks, results, and what differs from B. */
export function Outcome({ model, tab, onTab }: OutcomeProps) {
  const view = model.view.value;
  const failed = view === null || view.holds ? "" : ` (${view.failed})`;
  const tabs = [
    { value: "checks", label: `${t("machine.checks")}${failed}` },
    { value: "results", label: t("machine.results") },
    { value: "compare", label: t("machine.comparison") },
    { value: "choices", label: t("machine.choices") },
    { value: "command", label: t("machine.command") },
  ];
  return (
    <div class="machine-outcome ui-stack">
      <Verdict model={model} />
      {view !== null && (
        <Tabs label={view.title} value={tab} tabs={tabs} onChange={onTab}>
          {tab === "checks" && <Checks view={view} />}
          {tab === "results" && <Results view={view} />}
          {tab === "compare" && <Compare model={model} />}
          {tab === "choices" && <Choices view={view} />}
          {tab === "command" && <Command model={model} />}
        </Tabs>
      )}
    </div>
  );
}
