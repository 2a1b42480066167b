/** The strip of sensitivities beside a parameter: bars of sign and size. */
import type { Effect, ShownCheck } from "../../api/messages";

export interface Bar {
  effect: Effect;
  /** Length, 0 to 1, on a logarithmic scale: 0.01 % to 10 % of the check for 1 % of the parameter. */
  length: number;
  /** Whether a rise of the parameter brings the check away from its limit; null where that is not known. */
  better: boolean | null;
}

const LEAST = 1e-4;
const MOST = 1e-1;

/** The bars of a parameter's effects; `checks` of the view of the same design. */
export function barsOf(effects: readonly Effect[], checks: readonly ShownCheck[]): Bar[] {
  const relation = new Map(checks.map((check) => [keyOf(check.machine, check.name), check]));
  return effects.map((effect) => ({
    effect,
    length: lengthOf(effect.relative),
    better: betters(effect, relation.get(keyOf(effect.machine, effect.check))),
  }));
}

/** The length of a bar. */
export function lengthOf(relative: number): number {
  const size = Math.abs(relative);
  if (size === 0) return 0;
  return Math.min(1, Math.max(0.06, Math.log(size / LEAST) / Math.log(MOST / LEAST)));
}

function betters(effect: Effect, check: ShownCheck | undefined): boolean | null {
  if (check === undefined || check.value == null || check.limit == null) return null;
  const rises = effect.change > 0 === check.limit >= 0;
  return check.relation === "<=" || check.relation === "<" ? !rises : rises;
}

/** The effects that turn a check nearest to the value now; those first that make one fail. */
export function turning(effects: readonly Effect[]): Effect[] {
  return effects.filter((effect) => effect.turns_at != null || effect.ok !== effect.after);
}

export function keyOf(machine: string, name: string): string {
  return `${machine}\n${name}`;
}
