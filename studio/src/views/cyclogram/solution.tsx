import type { ComponentChildren } from "preact";
import { formatNumber, t } from "../../text";
import { Button, formatQuantity, Progress } from "../../ui";
import type { CyclogramData } from "./model";
import type { Compared, CyclogramStore, Goal } from "./store";

interface SolveProps {
  store: CyclogramStore;
  data: CyclogramData;
  onTake: (data: CyclogramData) => void;
}

/** The two goals by a button each, the progress, and the solution beside what it was made from. */
export function Solve({ store, data, onTake }: SolveProps) {
  const goal = store.solving.value;
  const compared = store.compared.value;
  const button = (own: Goal, text: ComponentChildren) => (
    <Button icon="step" disabled={goal !== null} onClick={() => void store.solve(data, own)}>
      {text}
    </Button>
  );
  return (
    <>
      <div class="ui-row">
        {button("acceleration", t("cyclogram.leastAcceleration"))}
        {button("period", t("cyclogram.shortestTurn"))}
      </div>
      {goal !== null && (
        <Progress
          label={t(goal === "period" ? "cyclogram.shortestTurn" : "cyclogram.leastAcceleration")}
          onCancel={() => store.stop()}
        />
      )}
      {compared && <Comparison compared={compared} onTake={onTake} onDiscard={() => store.discard()} />}
    </>
  );
}

interface ComparisonProps {
  compared: Compared;
  onTake: (data: CyclogramData) => void;
  onDiscard: () => void;
}

function Comparison({ compared, onTake, onDiscard }: ComparisonProps) {
  const { solution } = compared;
  const times = solution.before / solution.after;
  const value = (si: number) => formatQuantity(si, solution.shown_unit, 4);
  return (
    <section class="ui-callout good ui-stack" aria-label={t("cyclogram.solution")}>
      <div>
        <strong>
          {t(solution.goal === "period" ? "cyclogram.shortestTurn" : "cyclogram.leastAcceleration")}:{" "}
          {value(solution.before)} → {value(solution.after)}
        </strong>
        <p>
          {solution.measure}
          {times > 1.005 && `, ${t("cyclogram.timesLess", { times: formatNumber(times, 3) })}`}
        </p>
        <p class="ui-help">{t("cyclogram.comparedHelp")}</p>
      </div>
      <div class="ui-row">
        <Button kind="primary" icon="good" onClick={() => onTake(solution.data as CyclogramData)}>
          {t("cyclogram.take")}
        </Button>
        <Button onClick={onDiscard}>{t("cyclogram.discard")}</Button>
      </div>
      <div>
        <h2>{t("cyclogram.binds")}</h2>
        <ol class="cyclogram-binding">
          {solution.binding.map((one, index) => (
            <li key={index}>
              <span>{one.label}</span> <span class="ui-muted">{one.effect}</span>
            </li>
          ))}
        </ol>
      </div>
    </section>
  );
}
