import type { ComponentChildren } from "preact";
import type { ShownTrack } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { formatQuantity, Icon, QuantityField, quantityText, Select } from "../../ui";
import { type Curve, QUANTITIES, type Shown, unitOf, valueAt } from "./curves";
import { type CyclogramData, DEGREE, lawName, type Span, withBegin, withLevel, withMotion, withSpan } from "./model";

interface MotionsProps {
  data: CyclogramData;
  shown: Shown;
  onChange: (data: CyclogramData) => void;
}

/** The motions of all tracks as typed values: what the lanes show, for the keyboard. */
export function Motions({ data, shown, onChange }: MotionsProps) {
  return (
    <div class="ui-stack">
      {shown.about.tracks.map((track) => (
        <details key={track.name} class="ui-details" open={shown.about.tracks.length < 5}>
          <summary>
            {track.name} <span class="ui-muted">{track.actuator}</span>
          </summary>
          <div class="cyclogram-motions">
            {track.motions.map((part) => (
              <Motion
                key={part.name}
                data={data}
                track={track}
                part={part}
                laws={shown.about.laws}
                onChange={onChange}
              />
            ))}
          </div>
        </details>
      ))}
    </div>
  );
}

interface MotionProps {
  data: CyclogramData;
  track: ShownTrack;
  part: ShownTrack["motions"][number];
  laws: readonly string[];
  onChange: (data: CyclogramData) => void;
}

function Motion({ data, track, part, laws, onChange }: MotionProps) {
  const law = lawName(data.tracks?.[track.name]?.motions?.[part.name]?.law);
  const span = (change: Partial<Span>) => onChange(withSpan(data, track.name, part.name, { ...part, ...change }));
  const unit = track.unit;
  return (
    <fieldset class="cyclogram-motion">
      <legend>{part.name}</legend>
      <QuantityField
        label={t("cyclogram.start")}
        value={quantityText(part.start, "deg")}
        unit="deg"
        onChange={(_, si) => si !== null && span({ start: si })}
      />
      <QuantityField
        label={t("cyclogram.end")}
        value={quantityText(part.end, "deg")}
        unit="deg"
        onChange={(_, si) => si !== null && span({ end: si })}
      />
      <QuantityField
        label={t("cyclogram.from")}
        value={quantityText(part.begin, unit)}
        unit={unit}
        onChange={(_, si) => si !== null && onChange(withBegin(data, track, part.name, si))}
      />
      <QuantityField
        label={t("cyclogram.to")}
        value={quantityText(part.finish, unit)}
        unit={unit}
        onChange={(_, si) => si !== null && onChange(withLevel(data, track, part.name, si))}
      />
      <Select
        label={t("cyclogram.law")}
        value={law}
        choices={laws.map((name) => ({ value: name, label: name }))}
        onChange={(to) => onChange(withMotion(data, track.name, part.name, { law: to }))}
      />
    </fieldset>
  );
}

/** What every track does at the cursor, with units; beside it the largest values of the turn. */
export function Readings({ shown, cursor }: { shown: Shown; cursor: number }) {
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("cyclogram.atCursor")}>
      <table class="ui-table">
        <caption>
          {t("cyclogram.atAngle", {
            angle: formatQuantity(cursor, "deg", 4),
            time: formatQuantity((cursor / (2 * Math.PI)) * shown.about.period, "s", 3),
          })}
        </caption>
        <thead>
          <tr>
            <th scope="col">{t("cyclogram.track")}</th>
            {QUANTITIES.map((curve) => (
              <th key={curve} scope="col" class="number">
                {t(`cyclogram.${curve}`)}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {shown.about.tracks.map((track, index) => (
            <tr key={track.name}>
              <th scope="row">{track.name}</th>
              {QUANTITIES.map((curve) => (
                <td key={curve} class="number">
                  {reading(shown, index, track.unit, curve, cursor)}
                  {curve !== "position" && <span class="cyclogram-peak">{peakText(track, curve)}</span>}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function reading(shown: Shown, index: number, unit: string, curve: Curve, cursor: number): string {
  const curves = shown.curves[index];
  return curves === undefined ? "–" : formatQuantity(valueAt(curves, curve, cursor), unitOf(unit, curve), 4);
}

const PEAKS = { velocity: "speed", acceleration: "acceleration", jerk: "jerk" } as const;

function peakText(track: ShownTrack, curve: Exclude<Curve, "position">): string {
  const peak = track.peaks[PEAKS[curve]];
  return t("cyclogram.atMost", { value: peak == null ? "∞" : formatQuantity(peak, unitOf(track.unit, curve), 3) });
}

/** Relations, exclusions and limits: what each requires, what is there, and whether it holds. */
export function Rules({ shown }: { shown: Shown }) {
  const { relations, exclusions, limits } = shown.about;
  return (
    <ul class="cyclogram-rules">
      {relations.map((one, index) => (
        <Rule key={`r${index}`} ok={one.ok} label={one.label} why={one.why}>
          {one.least !== null && t("cyclogram.gapLeast", { gap: degrees(one.gap), least: degrees(one.least) })}
          {one.least !== null && one.most !== null && "; "}
          {one.most !== null && t("cyclogram.gapMost", { gap: degrees(one.gap), most: degrees(one.most) })}
        </Rule>
      ))}
      {exclusions.map((one, index) => (
        <Rule key={`e${index}`} ok={one.ok} label={one.label} why={one.why}>
          {t("cyclogram.apart", { apart: degrees(one.apart), gap: degrees(one.gap) })}
        </Rule>
      ))}
      {limits.map((one, index) => (
        <Rule key={`l${index}`} ok={one.ok} label={one.label} why={one.why}>
          {t("cyclogram.limit", {
            value: formatQuantity(one.value ?? Number.POSITIVE_INFINITY, one.unit, 4),
            limit: formatQuantity(one.limit, one.unit, 4),
          })}
        </Rule>
      ))}
    </ul>
  );
}

/** How many rules there are, and how many are violated. */
export function countOf({ about }: Shown): { all: number; bad: number } {
  const rules = [...about.relations, ...about.exclusions, ...about.limits];
  return { all: rules.length, bad: rules.filter((one) => !one.ok).length };
}

interface RuleProps {
  ok: boolean;
  label: string;
  why: string;
  children: ComponentChildren;
}

function Rule({ ok, label, why, children }: RuleProps) {
  return (
    <li class={ok ? "" : "bad"}>
      <Icon name={ok ? "good" : "error"} label={t(ok ? "cyclogram.holds" : "cyclogram.violated")} />
      <div>
        <strong>{label}</strong>
        <span>{children}</span>
        {why && <span class="ui-muted">{why}</span>}
      </div>
    </li>
  );
}

function degrees(angle: number): string {
  return `${formatNumber(angle / DEGREE, 4)}°`;
}
