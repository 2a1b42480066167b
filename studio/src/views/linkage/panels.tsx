/** Panels beside the drawing: structure, parts with their numbers, motion, checks. */
import { useState } from "preact/hooks";
import type { LinkageFault } from "../../api/messages";
import { formatNumber, t, textIfKnown } from "../../text";
import { Button, Icon, IconButton, Tabs } from "../../ui";
import type { Editor } from "./editor";
import { Entries } from "./entries";
import { Motion, MotionFacts } from "./motion";
import { Selected } from "./selected";
import { LinkageStudy } from "./study";

type Panel = "structure" | "parts" | "motion" | "checks" | "study";

export function Panels({ editor }: { editor: Editor }) {
  const [panel, setPanel] = useState<Panel>("structure");
  const values = Object.keys(editor.document.data.value?.["values"] ?? {});
  const tabs: { value: Panel; label: string }[] = (["structure", "parts", "motion", "checks"] as const).map(
    (value) => ({ value, label: t(`linkage.${value}`) }),
  );
  if (values.length > 0) tabs.push({ value: "study", label: t("study.title") });
  return (
    <div class="linkage-panels">
      <Selected editor={editor} />
      <Faults editor={editor} />
      <Tabs label={t("linkage.panels")} value={panel} tabs={tabs} onChange={setPanel}>
        {panel === "structure" && <StructurePanel editor={editor} />}
        {panel === "parts" && <Parts editor={editor} />}
        {panel === "motion" && <Motion editor={editor} />}
        {panel === "checks" && <Checks editor={editor} />}
        {panel === "study" && values.length > 0 && <LinkageStudy editor={editor} />}
      </Tabs>
    </div>
  );
}

function Report({ fault, kind }: { fault: LinkageFault; kind: "bad" | "warn" }) {
  return (
    <div class={`ui-callout ${kind}`} role="status">
      <p>{fault.given}</p>
      {fault.allowed && <p>{fault.allowed}</p>}
      {fault.do && (
        <p>
          <b>{fault.do}</b>
        </p>
      )}
    </div>
  );
}

/** The key by which a file accepts lengths that differ much, as the reader of files advises it. */
const CONFIRM = "confirm =";

/** What does not work, and what to do. */
function Faults({ editor }: { editor: Editor }) {
  const answer = editor.answer.value;
  const refused = editor.refused.value;
  const motion = answer?.motion;
  const { data, error } = editor.document;
  if (data.value === null && error.value !== null) return <Report fault={error.value} kind="bad" />;
  return (
    <>
      {refused && <Report fault={refused} kind="bad" />}
      {refused?.do.includes(CONFIRM) && (
        <Button
          size="small"
          onClick={() =>
            editor.edit((copy) => {
              copy["confirm"] = ["lengths"];
            })
          }
        >
          {t("linkage.confirmLengths")}
        </Button>
      )}
      {!refused && motion?.fault && <Report fault={motion.fault} kind="bad" />}
      {!refused && answer?.no_motion && <Report fault={answer.no_motion} kind="warn" />}
      {motion && motion.no_forces !== "" && (
        <Report fault={{ given: motion.no_forces, allowed: "", do: "" }} kind="warn" />
      )}
    </>
  );
}

function StructurePanel({ editor }: { editor: Editor }) {
  const structure = editor.answer.value?.structure;
  if (!structure) return <p class="ui-muted">{t("app.loading")}</p>;
  const { degrees_of_freedom: count, driven, loops, groups, left, loose, missing } = structure;
  return (
    <div class="linkage-structure">
      <dl class="linkage-facts">
        <dt>{t("linkage.mobility")}</dt>
        <dd>{formatNumber(count)}</dd>
        <dt>{t("linkage.drivenCount")}</dt>
        <dd>{formatNumber(driven)}</dd>
        <dt>{t("linkage.loops")}</dt>
        <dd>{formatNumber(loops)}</dd>
      </dl>
      <MotionFacts editor={editor} />
      {editor.quality.value?.mobility && <p class="ui-help">{editor.quality.value.mobility}</p>}
      <h2>{t("linkage.groups")}</h2>
      <ol class="linkage-groups">
        {groups.map((group, index) => (
          <li key={group.bodies.join()} class={`group-${index % 8}`}>
            <button
              type="button"
              class="linkage-row"
              aria-pressed={group.bodies.every((body) => editor.selection.value.bodies.includes(body))}
              onClick={() => editor.select({ bodies: group.bodies, joints: group.joints })}
            >
              <span class="swatch" aria-hidden="true" />
              <b>{textIfKnown(`linkage.group${group.kind}`, { symbol: group.symbol }) ?? group.kind}</b>
              <span>{group.bodies.join(", ")}</span>
              <small>{t("linkage.withJoints", { joints: group.joints.join(", ") })}</small>
            </button>
            {group.branch !== 0 && !group.drawn && (
              <Button
                size="small"
                onClick={() =>
                  editor.edit((data) => {
                    data.branches = { ...data.branches, [group.free]: -group.branch };
                  })
                }
              >
                {t("linkage.flip", { joint: group.free })}
              </Button>
            )}
          </li>
        ))}
      </ol>
      {groups.length === 0 && <p class="ui-muted">{t("linkage.noGroups")}</p>}
      {(left.length > 0 || loose.length > 0) && (
        <p class="ui-callout warn">{t("linkage.left", { bodies: [...left, ...loose].join(", ") })}</p>
      )}
      {missing && <Report fault={missing} kind="warn" />}
      {loose.length > 0 && <p class="ui-help">{t("linkage.looseHelp", { bodies: loose.join(", ") })}</p>}
    </div>
  );
}

/** All bodies, joints and points as lists, and the numbers of what is chosen. */
function Parts({ editor }: { editor: Editor }) {
  const data = editor.document.data.value ?? {};
  const selection = editor.selection.value;
  const figure = editor.figure.value;
  const free = (figure?.points ?? []).filter((point) => point.joint === undefined);
  return (
    <div class="linkage-parts">
      <ListOf
        title={t("linkage.bodies")}
        names={Object.keys(data.bodies ?? {})}
        chosen={selection.bodies}
        onChoose={(body) => editor.select({ bodies: [body] })}
      />
      <ListOf
        title={t("linkage.joints")}
        names={Object.keys(data.joints ?? {})}
        chosen={selection.joints}
        onChoose={(joint) => editor.select({ joints: [joint] })}
      />
      <ListOf
        title={t("linkage.points")}
        names={free.map((point) => `${point.body}.${point.name}`)}
        chosen={selection.points}
        onChoose={(point) => editor.select({ points: [point] })}
      />
      <Others editor={editor} />
    </div>
  );
}

interface ListProps {
  title: string;
  names: readonly string[];
  chosen: readonly string[];
  onChoose: (name: string) => void;
}

function ListOf({ title, names, chosen, onChoose }: ListProps) {
  return (
    <section>
      <h2>{`${title} (${names.length})`}</h2>
      <div class="linkage-list">
        {names.map((name) => (
          <Button key={name} size="small" pressed={chosen.includes(name)} onClick={() => onChoose(name)}>
            {name}
          </Button>
        ))}
      </div>
    </section>
  );
}

const TABLES = ["values", "couplings", "loads", "springs", "dampers", "friction"] as const;

/** Named values, gears, loads: with their numbers. */
function Others({ editor }: { editor: Editor }) {
  const data = editor.document.data.value ?? {};
  return (
    <>
      {TABLES.filter((key) => data[key] !== undefined).map((key) => (
        <section key={key} class="linkage-numbers">
          <h2>{t(`linkage.${key}`)}</h2>
          {Object.entries(data[key] as Record<string, unknown>).map(([name, entry]) => (
            <div key={name} class="linkage-other">
              <Entries editor={editor} path={[key]} table={{ [name]: entry }} />
              <IconButton
                icon="remove"
                size="small"
                label={t("linkage.removeOf", { name })}
                onClick={() =>
                  editor.edit((copy) => {
                    const table = copy[key] as Record<string, unknown>;
                    delete table[name];
                    if (Object.keys(table).length === 0) delete copy[key];
                  })
                }
              />
            </div>
          ))}
        </section>
      ))}
    </>
  );
}

function Checks({ editor }: { editor: Editor }) {
  const quality = editor.quality.value;
  if (!quality) return <p class="ui-muted">{t("app.loading")}</p>;
  const checks = quality.checks as unknown as { name: string; value: number; limit: number; unit: string; ok: boolean; relation: string; cure: string }[]; // biome-ignore format: the check's record
  return (
    <div class="linkage-checks">
      {checks.length === 0 && !quality.fault && (
        <p class="ui-muted">{t(quality.has_forces ? "linkage.noLimits" : "linkage.noChecks")}</p>
      )}
      <ul>
        {checks.map((check) => (
          <li key={check.name} class={check.ok ? "good" : "bad"}>
            <Icon name={check.ok ? "good" : "error"} label={check.ok ? t("ui.holds") : t("ui.fails")} />
            <span>{check.name.replaceAll("_", " ")}</span>
            {!check.ok && check.cure && <small>{check.cure}</small>}
          </li>
        ))}
      </ul>
      {[...quality.warnings, ...quality.left_out].map((warning) => (
        <p key={warning} class="ui-callout warn">
          {warning}
        </p>
      ))}
      {quality.fault && <Report fault={quality.fault} kind="warn" />}
    </div>
  );
}
