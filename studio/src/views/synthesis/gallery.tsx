import { useState } from "preact/hooks";
import type { ShownFourBar, SynthesisAnswer } from "../../api/messages";
import { formatNumber, t, textIfKnown } from "../../text";
import { Button, formatQuantity, Icon, QuantityField, Select, Toggle } from "../../ui";
import { accepted, type Filter, NO_FILTER, type Order, ordered } from "./filter";
import { StillThumbnail, Thumbnail } from "./thumbnail";

interface GalleryProps {
  answer: SynthesisAnswer;
  chosen: number;
  onChoose: (number: number) => void;
  onLoosen: (name: string, value: string) => void;
}

/** The candidates, moving, in the order of their rank; filters; those left out with their reasons. */
export function Gallery({ answer, chosen, onChoose, onLoosen }: GalleryProps) {
  const [filter, setFilter] = useState<Filter>(NO_FILTER);
  const [order, setOrder] = useState<Order>("rank");
  const shown = ordered(
    answer.candidates.filter((one) => accepted(one, filter)),
    order,
  );
  const hidden = answer.candidates.length - shown.length;
  return (
    <section class="ui-stack" aria-label={t("synthesis.gallery")}>
      <h2>{t("synthesis.gallery")}</h2>
      <Jammed answer={answer} />
      {answer.candidates.length > 1 && (
        <details class="ui-details">
          <summary>{t("synthesis.filter")}</summary>
          <Filters filter={filter} order={order} onFilter={setFilter} onOrder={setOrder} />
        </details>
      )}
      {hidden > 0 && (
        <p class="ui-row ui-muted" role="status">
          {t("synthesis.hidden", { count: hidden })}
          <Button size="small" onClick={() => setFilter(NO_FILTER)}>
            {t("synthesis.showAll")}
          </Button>
        </p>
      )}
      {answer.candidates.length === 0 && <NoAnswer answer={answer} onLoosen={onLoosen} />}
      <ul class="synthesis-cards">
        {shown.map((one) => (
          <li key={one.number}>
            <Card one={one} chosen={one.number === chosen} onChoose={() => onChoose(one.number)} />
          </li>
        ))}
      </ul>
      <LeftOut answer={answer} />
    </section>
  );
}

/** How many were left out because they cannot transmit. */
function Jammed({ answer }: { answer: SynthesisAnswer }) {
  const count = answer.left_out.find((reason) => reason.name === "transmits")?.count ?? 0;
  if (count === 0) return null;
  return <p class="ui-muted">{t("synthesis.jammed", { count, limit: formatQuantity(answer.jam ?? 0, "deg") })}</p>;
}

function Card({ one, chosen, onChoose }: { one: ShownFourBar; chosen: boolean; onChoose: () => void }) {
  return (
    <button type="button" class="synthesis-card" aria-pressed={chosen} onClick={onChoose}>
      <span class="synthesis-card-head">
        <strong>{one.number}</strong>
        <span>{classText(one.class_name)}</span>
        {chosen && <Icon name="good" label={t("synthesis.isChosen")} />}
      </span>
      <Thumbnail one={one} />
      <dl>
        {one.merit && <Fact name={t("synthesis.merit")} value={meritText(one.merit.value)} />}
        {errorText(one) !== "" && <Fact name={t("synthesis.error")} value={errorText(one)} />}
        <Fact name="μ" value={formatQuantity(one.transmission, "deg", 3)} />
        <Fact name={t("synthesis.size")} value={formatQuantity(one.size, "mm", 3)} />
      </dl>
    </button>
  );
}

export function Fact({ name, value }: { name: string; value: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>{value}</dd>
    </div>
  );
}

/** Class of a four-bar by Grashof. */
export function classText(name: string): string {
  return textIfKnown(`synthesis.class_${name.replaceAll("-", "_")}`) ?? name;
}

/** Least merit, and least error as a number in mm or degrees, that is written out. */
const LEAST = 0.001;

/** A merit with three digits; a very small one as such, never as a power of ten. */
export function meritText(value: number): string {
  return value < LEAST ? `< ${formatNumber(LEAST)}` : formatNumber(value, 3);
}

/** The greatest error: a length of points, an angle of functions; of a task that is met exactly in words. */
export function errorText(one: ShownFourBar): string {
  if (one.error_max === null || one.error_max === undefined) return "";
  if (!one.function && one.error_max < 1e-9) return t("synthesis.exact");
  const unit = one.function ? "deg" : "mm";
  const least = LEAST * (one.function ? Math.PI / 180 : 1e-3);
  return one.error_max < least ? `< ${formatQuantity(least, unit)}` : formatQuantity(one.error_max, unit, 3);
}

interface FiltersProps {
  filter: Filter;
  order: Order;
  onFilter: (filter: Filter) => void;
  onOrder: (order: Order) => void;
}

function Filters({ filter, order, onFilter, onOrder }: FiltersProps) {
  return (
    <div class="synthesis-filters">
      <Select
        label={t("synthesis.order")}
        value={order}
        choices={[
          { value: "rank", label: t("synthesis.byRank") },
          { value: "error", label: t("synthesis.byError") },
          { value: "transmission", label: t("synthesis.byTransmission") },
          { value: "size", label: t("synthesis.bySize") },
        ]}
        onChange={onOrder}
      />
      <QuantityField
        label={t("synthesis.leastTransmission")}
        value={filter.transmission}
        unit="deg"
        optional
        bounds={{ at_least: 0, at_most: Math.PI / 2 }}
        onChange={(text) => onFilter({ ...filter, transmission: text })}
      />
      <QuantityField
        label={t("synthesis.greatestSize")}
        value={filter.size}
        unit="mm"
        optional
        bounds={{ above: 0 }}
        onChange={(text) => onFilter({ ...filter, size: text })}
      />
      <Toggle
        label={t("synthesis.turnsOnly")}
        value={filter.turns}
        onChange={(turns) => onFilter({ ...filter, turns })}
      />
      <Toggle
        label={t("synthesis.provenOnly")}
        value={filter.certified}
        onChange={(certified) => onFilter({ ...filter, certified })}
      />
    </div>
  );
}

function NoAnswer({ answer, onLoosen }: { answer: SynthesisAnswer; onLoosen: (name: string, value: string) => void }) {
  const settable = answer.loosened.filter((one) => one.name && one.value);
  const remarks = answer.loosened.filter((one) => !settable.includes(one));
  return (
    <div class="ui-callout warn" role="status">
      <strong>{t("synthesis.noAnswer")}</strong>
      {[...answer.no_four_bar, ...remarks.map((one) => one.words)].map((words) => (
        <p key={words}>{words}</p>
      ))}
      {settable.length > 0 && <p>{t("synthesis.loosenHelp")}</p>}
      <ul class="synthesis-loosened">
        {settable.map((one) => (
          <li key={one.words}>
            <span>{one.words}</span>
            <Button size="small" onClick={() => onLoosen(one.name ?? "", one.value ?? "")}>
              {t("synthesis.setTo", { name: one.name ?? "", value: one.value ?? "" })}
            </Button>
          </li>
        ))}
      </ul>
      <p>{answer.quick ? t("synthesis.causesFollow") : t("synthesis.changeTask")}</p>
    </div>
  );
}

function LeftOut({ answer }: { answer: SynthesisAnswer }) {
  if (answer.left_out.length === 0) return null;
  const most = Math.max(1, ...answer.left_out.map((one) => one.count));
  return (
    <details class="ui-details" open={answer.candidates.length === 0}>
      <summary>{t("synthesis.leftOut")}</summary>
      <p class="ui-help">{t("synthesis.leftOutHelp")}</p>
      <ul class="synthesis-reasons">
        {answer.left_out.map((one) => (
          <li key={one.name}>
            <span>{textIfKnown(`synthesis.reason_${one.name}`) ?? one.words}</span>
            <span class="number">{formatNumber(one.count, 9)}</span>
            <meter min={0} max={most} value={one.count} aria-label={one.words} />
          </li>
        ))}
      </ul>
      <ul class="synthesis-removed">
        {answer.removed.map((one, index) => (
          <li key={index}>
            <StillThumbnail pins={one.pins} />
            <span>{Object.values(one.reasons).join("; ")}</span>
          </li>
        ))}
      </ul>
    </details>
  );
}
