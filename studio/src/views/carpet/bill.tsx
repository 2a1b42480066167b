import { formatNumber, t } from "../../text";
import { Button, Icon, Table } from "../../ui";
import type { CarpetModel } from "./model";

/** What the carpet needs and costs, what is hard in it, and whether it can be made. */
export function Bill({ model, onWeave }: { model: CarpetModel; onWeave: (row: number) => void }) {
  const chart = model.chart.value;
  if (chart === null) return null;
  const { about } = chart;
  const yarns = about.yarns
    .filter((yarn) => yarn.knots > 0)
    .map((yarn) => [`${yarn.symbol} ${yarn.name}`, yarn.knots, yarn.length, yarn.mass, yarn.to_buy, yarn.price]);
  const ground = about.ground.map((yarn) => [yarn.name, null, yarn.length, yarn.mass, yarn.to_buy, yarn.price]);
  const hasReading = about.reading === "exact" || about.reading === "flat" || about.reading === "photo";
  return (
    <div class="ui-stack carpet-bill">
      <dl class="carpet-facts">
        <Fact name={t("carpet.knots")} value={formatNumber(about.rows * about.columns)} />
        <Fact name={t("carpet.mass")} value={`${formatNumber(about.mass, 3)} kg`} />
        <Fact name={t("carpet.massPerArea")} value={`${formatNumber(about.mass_per_area, 3)} kg/m²`} />
        <Fact
          name={t("carpet.cost")}
          value={about.price === null ? t("carpet.noPrice") : `${formatNumber(about.price, 4)} ${about.currency}`}
        />
        <Fact name={t("carpet.difference")} value={formatNumber(about.mean_delta_e, 3)} />
        <Fact name={t("carpet.smallPatches")} value={formatNumber(about.small_patches)} />
        <Fact name={t("carpet.edited")} value={formatNumber(about.edited)} />
        {about.half_knots > 0 && <Fact name={t("carpet.halfKnots")} value={formatNumber(about.half_knots)} />}
        {about.jufti_knots > 0 && <Fact name={t("carpet.juftiKnots")} value={formatNumber(about.jufti_knots)} />}
        <Fact
          name={t("carpet.readAs")}
          value={hasReading ? t(`carpet.${about.reading as "exact" | "flat" | "photo"}`) : about.reading}
          note={about.reason}
        />
      </dl>
      <Checks model={model} />
      <h2>{t("carpet.bill")}</h2>
      <Table
        label={t("carpet.bill")}
        columns={[
          { heading: t("carpet.yarn") },
          { heading: t("carpet.knots") },
          { heading: t("carpet.length"), unit: "m", digits: 3 },
          { heading: t("carpet.massShort"), unit: "kg", digits: 3 },
          { heading: t("carpet.toBuy"), unit: "kg", digits: 3 },
          { heading: t("carpet.price", { currency: about.currency }), digits: 3 },
        ]}
        rows={[...yarns, ...ground]}
        height="420px"
      />
      <h2>{t("carpet.hardest")}</h2>
      <ul class="carpet-rows">
        {about.hardest.map((hard) => (
          <li key={hard.row}>
            <Button
              size="small"
              kind="quiet"
              title={t("carpet.showRow")}
              onClick={() => {
                model.sought.value = hard.row;
              }}
            >
              {t("carpet.hardRow", { row: hard.row, changes: hard.changes })}
            </Button>
            <Button
              size="small"
              aria-label={t("carpet.weaveRow", { row: hard.row })}
              title={t("carpet.weaveRow", { row: hard.row })}
              onClick={() => onWeave(hard.row)}
            >
              {t("carpet.weave")}
            </Button>
          </li>
        ))}
      </ul>
      <p class="ui-help">{t("carpet.meanChanges", { mean: formatNumber(about.mean_changes, 3) })}</p>
    </div>
  );
}

function Fact({ name, value, note }: { name: string; value: string; note?: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>
        {value}
        {note && <span class="ui-help">{note}</span>}
      </dd>
    </div>
  );
}

function Checks({ model }: { model: CarpetModel }) {
  const about = model.chart.value?.about;
  if (about === undefined) return null;
  return (
    <ul class="carpet-checks">
      {about.checks.map((check) => (
        <li key={check.name} class={check.ok ? "good" : "bad"}>
          <Icon name={check.ok ? "good" : "error"} label={check.ok ? t("carpet.holds") : t("carpet.fails")} />
          <span>{`${check.name}: ${check.value_text} ${check.limit_text}`}</span>
        </li>
      ))}
      {about.warnings.map((warning) => (
        <li key={warning} class="warn">
          <Icon name="warning" label={t("carpet.warning")} />
          <span>{warning}</span>
        </li>
      ))}
      {about.notes.map((note) => (
        <li key={note}>
          <Icon name="info" label={t("carpet.note")} />
          <span>{note}</span>
        </li>
      ))}
    </ul>
  );
}
