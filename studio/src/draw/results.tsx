import { useState } from "preact/hooks";
import { formatNumber, t } from "../text";
import { Button, TextField } from "../ui";

/** A result as the server shows it. */
interface ResultShown {
  name: string;
  machine?: string;
  text: string;
  meaning: string;
}

/** Number of results that are shown at first. */
const AT_FIRST = 40;

/** Results with their meanings; where there are many, the first ones, and a field that filters them. */
export function ResultTable({ results }: { results: readonly ResultShown[] }) {
  const [filter, setFilter] = useState("");
  const [all, setAll] = useState(false);
  const wanted = filter.trim().toLowerCase();
  const found = results.filter((one) =>
    `${one.machine ?? ""} ${one.name} ${one.meaning}`.toLowerCase().includes(wanted),
  );
  const shown = all ? found : found.slice(0, AT_FIRST);
  return (
    <div class="ui-stack">
      {results.length > 12 && <TextField label={t("ui.filter")} value={filter} onChange={setFilter} />}
      <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("ui.results")}>
        <table class="ui-table">
          <thead>
            <tr>
              <th scope="col">{t("ui.meaning")}</th>
              <th scope="col" class="number">
                {t("ui.value")}
              </th>
              <th scope="col">{t("ui.result")}</th>
            </tr>
          </thead>
          <tbody>
            {shown.map((one) => (
              <tr key={`${one.machine ?? ""}.${one.name}`}>
                <th scope="row">{one.meaning}</th>
                <td class="number fig-lines">{one.text}</td>
                <td>
                  <code>{one.machine ? `${one.machine}.${one.name}` : one.name}</code>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {shown.length < found.length && (
        <Button kind="quiet" size="small" onClick={() => setAll(true)}>
          {t("ui.showAll")} ({formatNumber(found.length)})
        </Button>
      )}
    </div>
  );
}

/** A choice of a design as the server shows it. */
interface ChoiceShown {
  name: string;
  chosen: string;
  decided_by: string;
  next_cheaper: string;
  failed: string;
}

/** What a design chose of what was left open, and what the next cheaper one failed. */
export function ChoiceTable({ choices }: { choices: readonly ChoiceShown[] }) {
  const heads = [t("ui.choice"), t("ui.chosen"), t("ui.decidedBy"), t("ui.nextCheaper"), t("ui.failedThere")];
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("ui.choices")}>
      <table class="ui-table">
        <thead>
          <tr>
            {heads.map((head) => (
              <th key={head} scope="col">
                {head}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {choices.map((one) => (
            <tr key={one.name}>
              <th scope="row">{one.name}</th>
              <td>{one.chosen}</td>
              <td>{one.decided_by}</td>
              <td>{one.next_cheaper || "–"}</td>
              <td>{one.failed || "–"}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
