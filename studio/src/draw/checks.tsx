import { useState } from "preact/hooks";
import { formatNumber, t } from "../text";
import { Button, Icon } from "../ui";

/** A check as the server shows it. */
export interface CheckShown {
  name: string;
  /** The machine in it that the check is of, "" for its own. */
  machine?: string;
  ok: boolean;
  value_text: string;
  /** With its relation. */
  limit_text: string;
  /** Value over limit; null where there is none. */
  ratio?: number | null;
  source: string;
  cure: string;
}

const AT_FIRST = 12;

/** Checks, those that fail first: each with an icon, a word, its value against its limit, and what to do. */
export function CheckList({ checks }: { checks: readonly CheckShown[] }) {
  const [all, setAll] = useState(false);
  const failed = checks.filter((check) => !check.ok);
  const sorted = [...failed, ...checks.filter((check) => check.ok)];
  const shown = all ? sorted : sorted.slice(0, Math.max(AT_FIRST, failed.length));
  return (
    <div class="ui-stack">
      <p class={`check-verdict ${failed.length > 0 ? "bad" : "good"}`} role="status">
        <Icon name={failed.length > 0 ? "error" : "good"} />
        {failed.length > 0
          ? t("ui.checksFail", { failed: failed.length, count: checks.length })
          : t("ui.checksHold", { count: checks.length })}
      </p>
      <ul class="checks" aria-label={t("ui.checks")}>
        {shown.map((check) => (
          <Row key={`${check.machine ?? ""}: ${check.name}`} check={check} />
        ))}
      </ul>
      {sorted.length > shown.length || all ? (
        <Button kind="quiet" size="small" onClick={() => setAll(!all)}>
          {all ? t("ui.showLess") : t("ui.showAll")} ({formatNumber(checks.length)})
        </Button>
      ) : null}
    </div>
  );
}

function Row({ check }: { check: CheckShown }) {
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
          check.source && <p class="check-source">{check.source}</p>
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
