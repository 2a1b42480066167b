import { useState } from "preact/hooks";
import type { DesignView } from "../../api/messages";
import { t } from "../../text";
import { Button } from "../../ui";
import { keyOf } from "./effects";

const FIRST = 100;

/** The results with their units and meanings, those of the machines in it last. */
export function Results({ view }: { view: DesignView }) {
  const [all, setAll] = useState(false);
  const shown = all ? view.results : view.results.slice(0, FIRST);
  return (
    <div class="ui-stack">
      <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("machine.results")}>
        <table class="ui-table machine-results">
          <thead>
            <tr>
              <th scope="col">{t("machine.resultName")}</th>
              <th scope="col" class="number">
                {t("machine.value")}
              </th>
              <th scope="col">{t("machine.meaning")}</th>
            </tr>
          </thead>
          <tbody>
            {shown.map((one) => (
              <tr key={keyOf(one.machine, one.name)}>
                <th scope="row">
                  {one.machine !== "" && <span class="ui-muted">{one.machine}: </span>}
                  {one.name.replaceAll("_", " ")}
                </th>
                <td class="number machine-lines">{one.text}</td>
                <td class="ui-muted">{one.meaning}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
      {shown.length < view.results.length && (
        <Button onClick={() => setAll(true)}>{t("machine.more", { count: view.results.length })}</Button>
      )}
    </div>
  );
}

/** What the design chose, and its warnings. */
export function Choices({ view }: { view: DesignView }) {
  const heads = [t("machine.choice"), t("machine.chosen"), t("machine.decidedBy"), t("machine.nextCheaper")];
  return (
    <div class="ui-stack">
      {view.warnings.length === 0 && <p class="ui-muted">{t("machine.noWarnings")}</p>}
      {view.warnings.map((text) => (
        <p key={text} class="ui-callout warn">
          {text}
        </p>
      ))}
      {view.choices.length === 0 ? (
        <p class="ui-muted">{t("machine.noChoices")}</p>
      ) : (
        <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("machine.choices")}>
          <table class="ui-table">
            <thead>
              <tr>
                {[...heads, t("machine.failsThere")].map((head) => (
                  <th key={head} scope="col">
                    {head}
                  </th>
                ))}
              </tr>
            </thead>
            <tbody>
              {view.choices.map((one) => (
                <tr key={one.name}>
                  <th scope="row">{one.name}</th>
                  <td>{one.chosen}</td>
                  <td>{one.decided_by}</td>
                  <td>{one.next_cheaper}</td>
                  <td>{one.failed}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </div>
  );
}
