import { useState } from "preact/hooks";
import { t } from "../text";
import { Button, binding, Icon, type Judged } from "../ui";

/** A check as the server shows it. */
export interface CheckShown extends Judged {
  /** The machine in it that the check is of, "" for its own. */
  machine?: string;
  value_text: string;
  /** With its relation. */
  limit_text: string;
  /** Value over limit; null where there is none. */
  ratio?: number | null;
  source: string;
  cure: string;
}

/** The checks that bind are shown before all are asked for, more only where they fail. */
const AT_FIRST = 4;

/** Checks in the order in which they bind: each with an icon, a word, its value against its limit, and what to do. */
export function CheckList({ checks }: { checks: readonly CheckShown[] }) {
  const [all, setAll] = useState(false);
  const sorted = binding(checks);
  const failed = sorted.filter((check) => !check.ok).length;
  const shown = all ? sorted : sorted.slice(0, Math.max(AT_FIRST, failed));
  return (
    <div class="check-list">
      <ul class="checks" aria-label={t("ui.checks")}>
        {shown.map((check) => (
          <Row key={`${check.machine ?? ""}: ${check.name}`} check={check} whole={all} />
        ))}
      </ul>
      {sorted.length > shown.length || all ? (
        <Button kind="quiet" size="small" onClick={() => setAll(!all)}>
          {all ? t("ui.showLess") : t("ui.allChecks", { count: checks.length })}
        </Button>
      ) : null}
    </div>
  );
}

function Row({ check, whole }: { check: CheckShown; whole: boolean }) {
  return (
    <li class={`check ${check.ok ? "" : "bad"}`}>
      <Icon name={check.ok ? "connected" : "error"} label={check.ok ? t("ui.holds") : t("ui.fails")} />
      <div class="check-main">
        <span class="check-name">
          {check.machine ? <span class="ui-muted">{check.machine}: </span> : null}
          {check.name}
        </span>
        <Bar check={check} />
        <span class="check-values">
          <b>{check.value_text}</b> {check.limit_text}
        </span>
        {check.ok ? (
          whole && check.source && <p class="check-source">{check.source}</p>
        ) : (
          <p class="check-cure">
            <b>{t("ui.fails")}.</b> {check.cure || check.source}
          </p>
        )}
      </div>
    </li>
  );
}

/** Value against limit: the bar is the value, the line the limit. */
function Bar({ check }: { check: CheckShown }) {
  const ratio = check.ratio;
  if (ratio == null || !(ratio >= 0)) return null;
  const whole = Math.max(1.25, Math.min(ratio, 4) * 1.04);
  const wide = (100 * Math.min(ratio, whole)) / whole;
  return (
    <svg class="check-bar" viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true">
      <rect class="check-bar-ground" width="100" height="6" rx="1.5" />
      <rect class="check-bar-value" width={wide} height="6" rx="1.5" />
      <rect class="check-bar-limit" x={100 / whole - 0.7} width="1.4" height="6" />
    </svg>
  );
}
