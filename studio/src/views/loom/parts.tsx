/** The list of parts, and what is known of one. */
import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { t } from "../../text";
import { Button, formatQuantity } from "../../ui";
import type { SceneCheck, ScenePart } from "./scene";

interface ListProps {
  parts: readonly ScenePart[];
  chosen: string;
  onChoose: (name: string) => void;
}

/** The parts by machine, in the order in which the machines come. */
export function byMachine(parts: readonly ScenePart[]): [machine: string, parts: ScenePart[]][] {
  const found = new Map<string, ScenePart[]>();
  for (const part of parts) found.set(part.machine, [...(found.get(part.machine) ?? []), part]);
  return [...found];
}

export function PartList({ parts, chosen, onChoose }: ListProps) {
  const id = useId();
  return (
    <div class="loom-parts">
      <label for={id}>{t("loom.parts")}</label>
      <select
        id={id}
        class="ui-input"
        size={8}
        value={chosen}
        aria-describedby={`${id}-help`}
        onChange={(event) => onChoose(event.currentTarget.value)}
      >
        {byMachine(parts).map(([machine, own]) => (
          <optgroup key={machine} label={machine}>
            {own.map((part) => (
              <option key={part.name} value={part.name} selected={part.name === chosen}>
                {failed(part) > 0 ? `⚠ ${part.title}` : part.title}
              </option>
            ))}
          </optgroup>
        ))}
      </select>
      <p id={`${id}-help`} class="ui-muted">
        {t("loom.partsHelp")}
      </p>
    </div>
  );
}

function failed(part: ScenePart): number {
  return part.checks.filter((check) => !check.ok).length;
}

interface DetailsProps {
  part: ScenePart;
  onLook: () => void;
  children?: ComponentChildren;
}

export function PartDetails({ part, onLook, children }: DetailsProps) {
  const bad = failed(part);
  const facts: [string, string][] = [
    [t("loom.machine"), part.machine],
    [t("loom.material"), part.material || t("loom.notStated")],
    [t("loom.mass"), part.mass === null ? t("loom.notWeighed") : formatQuantity(part.mass, "kg")],
    [t("loom.number"), String(part.number)],
  ];
  return (
    <section class="loom-part" aria-live="polite">
      <div class="ui-row">
        <h2 class="ui-grow">{part.title}</h2>
        <Button size="small" onClick={onLook}>
          {t("loom.nearer")}
        </Button>
      </div>
      {part.envelope && <p class="ui-muted">{t("loom.envelope")}</p>}
      <dl class="loom-facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <h3>{t("loom.checks")}</h3>
      {part.checks.length === 0 ? (
        <p class="ui-muted">{t("loom.noChecks")}</p>
      ) : (
        <>
          <p class={bad > 0 ? "ui-callout bad" : "ui-muted"}>
            {bad > 0 ? t("loom.unsound", { count: bad }) : t("loom.sound")}
          </p>
          <ul class="loom-checks">
            {part.checks.map((check) => (
              <li key={check.name} class={check.ok ? "good" : "bad"}>
                <span>{check.name}</span>
                <b>{judged(check)}</b>
              </li>
            ))}
          </ul>
        </>
      )}
      {children}
    </section>
  );
}

/** A check in a line: value, relation, limit, and in words whether it holds. */
export function judged(check: SceneCheck): string {
  const [value, limit] = [check.value, check.limit].map((one) =>
    one === null ? "–" : formatQuantity(one, check.unit),
  );
  return `${value} ${check.relation} ${limit}: ${t(check.ok ? "loom.holds" : "loom.fails")}`;
}
