import type { ComponentChildren } from "preact";
import { formatNumber, t } from "../text";
import { Icon } from "./icons";

/** A check with its value against its limit [SI]; without limit it only holds or fails. */
export interface Judged {
  name: string;
  ok: boolean;
  value?: number | null;
  limit?: number | null;
  relation?: string;
}

/** Share of its limit that a check is away from it, below 0 where it fails; infinite where it has none to be near to. */
export function marginOf({ value, limit, relation }: Judged): number {
  const isYes = value === 1 && limit === 1;
  if (value == null || limit == null || limit <= 0 || isYes) return Number.POSITIVE_INFINITY;
  return relation === ">=" ? value / limit - 1 : 1 - value / limit;
}

/** Checks in the order in which they bind: those that fail, then those with the least margin. */
export function binding<T extends Judged>(checks: readonly T[]): T[] {
  const rank = (one: T) => (one.ok ? marginOf(one) : Number.NEGATIVE_INFINITY);
  return checks.toSorted((a, b) => Math.sign(rank(a) - rank(b)) || 0);
}

/** Whether all checks hold, or how many fail, and the one with the least margin. */
export function Verdict({ checks, words }: { checks: readonly Judged[]; words?: string | undefined }) {
  const failed = checks.filter((one) => !one.ok).length;
  const [worst] = binding(checks);
  if (worst === undefined) return null;
  return (
    <VerdictBadge ok={failed === 0} about={aboutOf(worst)}>
      {words ?? (failed === 0 ? t("ui.allHold") : t("ui.someFail", { count: failed }))}
    </VerdictBadge>
  );
}

/** The check that binds, in words. */
function aboutOf(check: Judged): string {
  const { ok, name } = check;
  const percent = Math.round(1000 * marginOf(check)) / 10;
  if (!ok) return name;
  if (!Number.isFinite(percent)) return "";
  return percent === 0 ? t("ui.atLimit", { name }) : t("ui.leastMargin", { percent: formatNumber(percent, 2), name });
}

/** A verdict in the head of a view, and what it hangs on. */
export function VerdictBadge({
  ok,
  about = "",
  children,
}: {
  ok: boolean;
  about?: string;
  children: ComponentChildren;
}) {
  return (
    <span class="ui-verdict" role="status">
      <span class={`ui-badge ${ok ? "good" : "bad"}`}>
        <Icon name={ok ? "good" : "error"} />
        {children}
      </span>
      {about !== "" && <span class="ui-muted">{about}</span>}
    </span>
  );
}
