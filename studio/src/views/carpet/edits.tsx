import { formatNumber, t } from "../../text";
import { Button, IconButton } from "../../ui";
import type { CarpetModel } from "./model";

/** Edits that are listed, the last ones. */
const SHOWN = 200;

/** The edits of the recipe, the last one first, each of which can be taken out. */
export function Edits({ model }: { model: CarpetModel }) {
  const edits = model.edits();
  if (edits.length === 0) return <p class="ui-callout">{t("carpet.noEdits")}</p>;
  const first = Math.max(0, edits.length - SHOWN);
  const listed = edits.slice(first).map((line, at) => ({ line, at: first + at }));
  return (
    <div class="ui-stack">
      <p class="ui-help">{t("carpet.editsHelp")}</p>
      <ol class="carpet-edits" aria-label={t("carpet.edits")}>
        {listed.reverse().map(({ line, at }) => (
          <li key={`${at} ${line}`}>
            <span class="ui-muted">{formatNumber(at + 1)}</span>
            <code title={line}>{line}</code>
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
