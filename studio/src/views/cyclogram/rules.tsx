import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { Button, Icon, IconButton, type Judged } from "../../ui";
import type { Shown } from "./curves";
import { type CyclogramData, DEGREE } from "./model";
import { ExclusionForm, RelationForm } from "./rule-forms";
import {
  type ExclusionData,
  exclusionsOf,
  type RelationData,
  relationsOf,
  withNewExclusion,
  withNewRelation,
  withRules,
} from "./structure";

interface RulesProps {
  data: CyclogramData;
  shown: Shown;
  /** A solution is compared: rules are shown, not changed. */
  locked: boolean;
  onChange: (data: CyclogramData) => void;
}

/** Relations, exclusions and limits: what each requires, what is there, whether it holds; added, changed, removed. */
export function Rules({ data, shown, locked, onChange }: RulesProps) {
  const { about } = shown;
  const [edited, setEdited] = useState("");
  const [relations, exclusions] = [relationsOf(data), exclusionsOf(data)];
  const relate = (index: number, one: RelationData | null) =>
    onChange(withRules(data, put(relations, index, one), exclusions));
  const exclude = (index: number, one: ExclusionData | null) =>
    onChange(withRules(data, relations, put(exclusions, index, one)));
  const tools = (key: string, label: string, form: () => ComponentChildren, onRemove: () => void) =>
    locked ? null : (
      <>
        <div class="cyclogram-rule-tools">
          <IconButton
            icon="pencil"
            size="small"
            label={t("cyclogram.change", { name: label })}
            aria-expanded={edited === key}
            onClick={() => setEdited(edited === key ? "" : key)}
          />
          <IconButton
            icon="remove"
            size="small"
            label={t("cyclogram.remove", { name: label })}
            onClick={() => {
              setEdited("");
              onRemove();
            }}
          />
        </div>
        {edited === key && form()}
      </>
    );
  return (
    <>
      <ul class="cyclogram-rules">
        {relations.map((rule, index) => {
          const one = about.relations[index];
          const label = one?.label ?? t("cyclogram.relation", { number: index + 1 });
          return (
            <Rule key={`r${index}`} ok={one?.ok} label={label} why={rule.why ?? ""}>
              <span>
                {one &&
                  one.least !== null &&
                  t("cyclogram.gapLeast", { gap: degrees(one.gap), least: degrees(one.least) })}
                {one && one.least !== null && one.most !== null && "; "}
                {one && one.most !== null && t("cyclogram.gapMost", { gap: degrees(one.gap), most: degrees(one.most) })}
                {one && !one.ok && <Missing margin={one.margin} />}
              </span>
              {tools(
                `r${index}`,
                label,
                () => (
                  <RelationForm data={data} rule={rule} onChange={(next) => relate(index, next)} />
                ),
                () => relate(index, null),
              )}
            </Rule>
          );
        })}
        {exclusions.map((rule, index) => {
          const one = about.exclusions[index];
          const label = one?.label ?? t("cyclogram.exclusion", { number: index + 1 });
          return (
            <Rule key={`e${index}`} ok={one?.ok} label={label} why={rule.why ?? ""}>
              <span>
                {one && t("cyclogram.apart", { apart: degrees(one.apart), gap: degrees(one.gap) })}
                {one && !one.ok && <Missing margin={one.margin} />}
              </span>
              {tools(
                `e${index}`,
                label,
                () => (
                  <ExclusionForm data={data} rule={rule} onChange={(next) => exclude(index, next)} />
                ),
                () => exclude(index, null),
              )}
            </Rule>
          );
        })}
        {about.limits.map((one, index) => (
          <Rule key={`l${index}`} ok={one.ok} label={one.name} why={one.source}>
            <span>
              {one.value_text} {one.limit_text}
            </span>
          </Rule>
        ))}
      </ul>
      {!locked && (
        <div class="ui-row">
          <Button
            size="small"
            icon="add"
            onClick={() => {
              onChange(withNewRelation(data));
              setEdited(`r${relations.length}`);
            }}
          >
            {t("cyclogram.addRelation")}
          </Button>
          <Button
            size="small"
            icon="add"
            onClick={() => {
              onChange(withNewExclusion(data, about.tracks));
              setEdited(`e${exclusions.length}`);
            }}
          >
            {t("cyclogram.addExclusion")}
          </Button>
        </div>
      )}
    </>
  );
}

/** A list with one entry replaced, or left out. */
function put<T>(list: readonly T[], index: number, one: T | null): T[] {
  return list.flatMap((old, at) => (at === index ? (one === null ? [] : [one]) : [old]));
}

function Missing({ margin }: { margin: number }) {
  return <strong class="cyclogram-missing"> {t("cyclogram.missing", { angle: degrees(-margin) })}</strong>;
}

/** All rules as checks. */
export function rulesOf({ about }: Shown): Judged[] {
  const named = <T extends { label: string; ok: boolean }>(one: T) => ({ ...one, name: one.label });
  return [
    ...about.relations.map((one) => ({ ...named(one), value: one.gap, limit: one.least, relation: ">=" })),
    ...about.exclusions.map((one) => ({ ...named(one), value: one.apart, limit: one.gap, relation: ">=" })),
    ...about.limits,
  ];
}

interface RuleProps {
  /** Whether it holds; undefined: not known yet. */
  ok: boolean | undefined;
  label: string;
  why: string;
  children: ComponentChildren;
}

function Rule({ ok, label, why, children }: RuleProps) {
  return (
    <li class={ok === false ? "bad" : ""}>
      <Icon name={ok === false ? "error" : "good"} label={t(ok === false ? "cyclogram.violated" : "cyclogram.holds")} />
      <div>
        <strong>{label}</strong>
        {why && <span class="ui-muted">{why}</span>}
        {children}
      </div>
    </li>
  );
}

function degrees(angle: number): string {
  return `${formatNumber(angle / DEGREE, 4)}°`;
}
