import { formatNumber, t } from "../../text";
import { Button, IconButton } from "../../ui";
import type { CarpetModel } from "./model";

/** Edits that are listed, the last ones. */
const SHOWN = 200;

/** What an edit of the knots of a carpet may be on; one of a motif, a border or the picture counts other cells. */
const ON: Record<string, () => string> = {
  carpet: () => t("carpet.everySize"),
  knots: () => t("carpet.thisSize"),
};

/** The edits of the recipe, the last one first, each of which can be taken out. */
export function Edits({ model }: { model: CarpetModel }) {
  const edits = model.edits();
  if (edits.length === 0) return <p class="ui-callout">{t("carpet.noEdits")}</p>;
  const first = Math.max(0, edits.length - SHOWN);
  const listed = edits.slice(first).map((edit, at) => ({ ...edit, at: first + at }));
  return (
    <div class="ui-stack">
      <p class="ui-help">{t("carpet.editsHelp")}</p>
      <ol class="carpet-edits" aria-label={t("carpet.edits")}>
        {listed.reverse().map(({ line, on, at }) => (
          <li key={`${at} ${line}`}>
            <span class="ui-muted">{formatNumber(at + 1)}</span>
            <code title={line}>{line}</code>
            <select
              class="ui-input"
              aria-label={t("carpet.editOn", { number: at + 1 })}
              value={on}
              disabled={!(on in ON)}
              onChange={(event) => model.anchorEdit(at, event.currentTarget.value)}
            >
              {Object.entries({ ...(on in ON ? {} : { [on]: () => on }), ...ON }).map(([value, text]) => (
                <option key={value} value={value} selected={value === on}>
                  {text()}
                </option>
              ))}
            </select>
            <IconButton
              icon="remove"
              size="small"
              label={t("carpet.dropEdit", { number: at + 1 })}
              onClick={() => model.dropEdit(at)}
            />
          </li>
        ))}
      </ol>
      {first > 0 && <p class="ui-help">{t("carpet.moreEdits", { count: first })}</p>}
      <div class="ui-row">
        <Button onClick={() => model.set({ edits: null })}>{t("carpet.dropEdits")}</Button>
      </div>
    </div>
  );
}
