/** The list of parts, and what is known of one. */
import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";
import { t, textIfKnown } from "../../text";
import { Button, formatQuantity } from "../../ui";
import { isRoom } from "./look";
import { carriers, failures, movers, type SceneAbout, type SceneCheck, type SceneModel, type ScenePart } from "./scene";

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
                {failures(part).length > 0 ? `⚠ ${part.title}` : part.title}
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

/** The part after the chosen one for Page Down, the one before for Page Up; null for other keys. */
export function neighbour(parts: readonly ScenePart[], chosen: string, key: string): string | null {
  const step = { PageDown: 1, PageUp: -1 }[key];
  if (step === undefined || parts.length === 0) return null;
  const listed = byMachine(parts).flatMap(([, own]) => own);
  const at = listed.findIndex((one) => one.name === chosen);
  const next = at < 0 && step < 0 ? -1 : at + step;
  return listed[(next + listed.length) % listed.length]?.name ?? null;
}

interface FailuresProps {
  checks: readonly SceneCheck[];
  parts: readonly ScenePart[];
  onChoose: (name: string) => void;
}

/** The checks of the loom that fail, with what cures them and the parts that they concern. */
export function Failures({ checks, parts, onChoose }: FailuresProps) {
  if (checks.length === 0) return null;
  return (
    <section class="ui-callout bad loom-failures" aria-label={t("loom.failures")}>
      <b>{t("loom.unsound", { count: checks.length })}</b>
      <ul>
        {checks.map((check) => (
          <li key={check.name}>
            {`${check.name}: ${judged(check)}`}
            {check.cure !== "" && <p>{check.cure}</p>}
            {parts
              .filter((part) => failures(part).some((one) => one.name === check.name))
              .map((part) => (
                <Button key={part.name} size="small" onClick={() => onChoose(part.name)}>
                  {part.title}
                </Button>
              ))}
          </li>
        ))}
      </ul>
    </section>
  );
}

interface DetailsProps {
  model: SceneModel;
  part: ScenePart;
  /** Brings it near; null: there is no picture. */
  onLook: (() => void) | null;
  children?: ComponentChildren;
}

export function PartDetails({ model, part, onLook, children }: DetailsProps) {
  const bad = failures(part).length;
  const facts: [string, string][] = [
    [t("loom.machine"), part.machine],
    [t("loom.material"), part.material || t("loom.notStated")],
    [t("loom.mass"), part.mass === null ? t("loom.notWeighed") : formatQuantity(part.mass, "kg")],
    [t("loom.number"), String(part.number)],
    [t("loom.extents"), part.extents.map((one) => formatQuantity(one, "mm")).join(" × ")],
  ];
  return (
    <section class="loom-part" aria-live="polite">
      <div class="ui-row">
        <h2 class="ui-grow">{part.title}</h2>
        {onLook && (
          <Button size="small" onClick={onLook}>
            {t("loom.nearer")}
          </Button>
        )}
      </div>
      {part.envelope && <p class="ui-muted">{t(isRoom(part) ? "loom.room" : "loom.envelope")}</p>}
      <dl class="loom-facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      <Holding model={model} part={part} />
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

/** What holds a part, joint by joint down to the floor, and what moves it. */
function Holding({ model, part }: { model: SceneModel; part: ScenePart }) {
  const chain = carriers(model.about, part.ids[1]);
  if (chain.length === 0) return null;
  return (
    <>
      <h3>{t("loom.heldBy")}</h3>
      <ol class="loom-holding">
        {chain.map(({ parent, joint, drive, passive }, k) => (
          <li key={parent}>
            {textIfKnown(JOINTS[joint] ?? "", { parent: parent === "" ? t("loom.floor") : named(parent) }) ?? joint}
            {passive !== "" && `: ${passive}`}
            {drive !== "" && <span class="ui-muted"> {t(MOVES[drive])}</span>}
            <Movers about={model.about} body={k === 0 ? part.ids[1] : (chain[k - 1]?.parent ?? "")} />
          </li>
        ))}
      </ol>
      {chain.every((held) => held.drive === "" && held.motor === "") && <p class="ui-muted">{t("loom.stands")}</p>}
    </>
  );
}

/** What moves a body against what holds it, one after the other up to the motor. */
function Movers({ about, body }: { about: SceneAbout; body: string }) {
  const names = movers(about, body).map(named);
  return names.length === 0 ? null : <div class="ui-muted">{t("loom.movedBy", { names: names.join(" ← ") })}</div>;
}

const MOVES = {
  row: "loom.movesWithRow",
  knot: "loom.movesWithKnot",
  shed: "loom.movesWithShed",
  beat: "loom.movesWithBeat",
} as const;

/** The text of each kind of joint; the kinds are those of `JointKind` in the server's part/tree.py. */
const JOINTS: Record<string, string> = {
  fixed: "loom.jointFixed",
  pin: "loom.jointPin",
  slide: "loom.jointSlide",
  screw: "loom.jointScrew",
  rolling: "loom.jointRolling",
  "cam and follower": "loom.jointCam",
  missing: "loom.jointMissing",
};

/** A body in words: its id without the machine's name. */
const named = (body: string) => body.slice(body.indexOf("/") + 1).replaceAll("-", " ");

/** A check in a line: value, relation, limit, and in words whether it holds. */
export function judged(check: SceneCheck): string {
  return `${check.shown}: ${t(check.ok ? "loom.holds" : "loom.fails")}`;
}
