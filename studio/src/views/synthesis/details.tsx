import type { ShownFourBar } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button, formatQuantity, Table } from "../../ui";
import { classText, errorText, Fact, meritText } from "./gallery";

/** The chosen candidate in numbers: links, merit, what each position is met by. */
export function Details({ one, busy, onTake }: { one: ShownFourBar; busy: boolean; onTake: () => void }) {
  const { merit, links } = one;
  return (
    <section class="ui-stack synthesis-details" aria-label={t("synthesis.candidate", { number: one.number })}>
      <div class="ui-row">
        <h2 class="ui-grow">{t("synthesis.candidate", { number: one.number })}</h2>
        <Button kind="primary" icon="open" disabled={busy} onClick={onTake}>
          {t("synthesis.toEditor")}
        </Button>
      </div>
      <dl class="synthesis-facts">
        {Object.entries(links).map(([name, length]) => (
          <Fact key={name} name={linkName(name)} value={formatQuantity(length, "mm", 5)} />
        ))}
        <Fact name={t("synthesis.class")} value={classText(one.class_name)} />
        <Fact name={t("synthesis.transmission")} value={formatQuantity(one.transmission, "deg", 4)} />
        <Fact name={t("synthesis.ratio")} value={formatNumber(one.link_ratio, 3)} />
        <Fact name={t("synthesis.size")} value={formatQuantity(one.size, "mm", 4)} />
        {errorText(one) !== "" && <Fact name={t("synthesis.errorMax")} value={errorText(one)} />}
        <Fact name={t("synthesis.circuits")} value={formatNumber(one.circuits)} />
        <Fact name={t("synthesis.proof")} value={t(one.certified ? "synthesis.proven" : "synthesis.notProven")} />
      </dl>
      {one.active.length > 0 && (
        <p class="ui-help">
          {t("synthesis.active")} {one.active.join("; ")}
        </p>
      )}
      {merit && <MeritBars merit={merit} />}
      {one.function ? <FunctionError one={one} /> : <Positions one={one} />}
    </section>
  );
}

function linkName(name: string): string {
  if (name === "ground") return t("synthesis.ground");
  if (name === "crank") return t("synthesis.crank");
  return name === "coupler" ? t("synthesis.coupler") : t("synthesis.rocker");
}

function MeritBars({ merit }: { merit: NonNullable<ShownFourBar["merit"]> }) {
  const terms: Record<string, [string, string]> = {
    transmission: [t("synthesis.transmission"), formatQuantity(merit.terms["transmission"] ?? Number.NaN, "deg", 3)],
    size: [t("synthesis.sizeTerm"), formatNumber(merit.terms["size"] ?? Number.NaN, 3)],
    ratio: [t("synthesis.ratio"), formatNumber(merit.terms["ratio"] ?? Number.NaN, 3)],
    sensitivity: [t("synthesis.sensitivity"), formatNumber(merit.terms["sensitivity"] ?? Number.NaN, 3)],
  };
  return (
    <div>
      <h3>
        {t("synthesis.merit")} {meritText(merit.value)}
      </h3>
      <ul class="synthesis-reasons">
        {Object.entries(terms).map(([name, [label, value]]) => (
          <li key={name}>
            <span>{label}</span>
            <span class="number">{value}</span>
            <meter
              min={0}
              max={1}
              value={merit.factors[name] ?? 0}
              aria-label={t("synthesis.factorOf", { term: label })}
            />
          </li>
        ))}
      </ul>
      {merit.point_shift !== null && (
        <p class="ui-help">{t("synthesis.shift", { shift: formatQuantity(merit.point_shift, "mm", 2) })}</p>
      )}
    </div>
  );
}

function Positions({ one }: { one: ShownFourBar }) {
  const angles = one.positions.some((met) => met.coupler_error !== null);
  return (
    <Table
      label={t("synthesis.positions")}
      columns={[
        { heading: t("synthesis.position") },
        { heading: t("synthesis.crankAngle"), unit: "deg" },
        { heading: t("synthesis.circuit") },
        { heading: t("synthesis.branch") },
        { heading: t("synthesis.error"), unit: "mm", digits: 3 },
        ...(angles ? [{ heading: t("synthesis.angleError"), unit: "deg", digits: 2 }] : []),
      ]}
      rows={one.positions.map((met, index) => [
        index + 1,
        met.crank_angle,
        met.circuit,
        met.branch,
        tiny(met.point_error, 1e-9),
        ...(angles ? [tiny(met.coupler_error, 1e-9)] : []),
      ])}
    />
  );
}

/** A value without its rounding noise. */
function tiny(value: number | null, least: number): number | null {
  return value !== null && Math.abs(value) < least ? 0 : value;
}

function FunctionError({ one }: { one: ShownFourBar }) {
  const { x, error } = one.function ?? { x: [], error: [] };
  const most = Math.max(1e-12, ...error.map(Math.abs));
  const [first, last] = [x[0] ?? 0, x.at(-1) ?? 1];
  const path = x
    .map((at, index) => {
      const [px, py] = [10 + (280 * (at - first)) / (last - first || 1), 50 - (40 * (error[index] ?? 0)) / most];
      return `${index ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`;
    })
    .join("");
  return (
    <figure class="synthesis-error-plot">
      <figcaption>{t("synthesis.structuralError", { error: formatQuantity(most, "deg", 3) })}</figcaption>
      <svg
        viewBox="0 0 300 100"
        role="img"
        aria-label={t("synthesis.structuralError", { error: formatQuantity(most, "deg", 3) })}
      >
        <line x1={10} x2={290} y1={50} y2={50} class="axis" />
        <path d={path} class="curve" />
        <text x={10} y={97}>
          {formatNumber(first)}
        </text>
        <text x={290} y={97} text-anchor="end">
          {formatNumber(last)}
        </text>
      </svg>
    </figure>
  );
}
