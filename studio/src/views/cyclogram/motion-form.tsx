import type { ShownTrack } from "../../api/messages";
import { t } from "../../text";
import { Button, QuantityField, quantityText, Select } from "../../ui";
import { NameField } from "./fields";
import { type CyclogramData, lawName, type Span, withBegin, withLevel, withMotion, withSpan } from "./model";
import { renamedMotion, withoutMotion } from "./structure";

interface MotionProps {
  data: CyclogramData;
  track: ShownTrack;
  part: ShownTrack["motions"][number];
  laws: readonly string[];
  onChange: (data: CyclogramData) => void;
}

/** A motion as typed values: its name, beginning, end, levels and law. */
export function MotionForm({ data, track, part, laws, onChange }: MotionProps) {
  const law = lawName(data.tracks?.[track.name]?.motions?.[part.name]?.law);
  const span = (change: Partial<Span>) => onChange(withSpan(data, track.name, part.name, { ...part, ...change }));
  const unit = track.shown_unit;
  return (
    <fieldset class="cyclogram-motion">
      <legend>
        {track.name}, {part.name}
      </legend>
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
      <NameField
        label={t("cyclogram.name")}
        value={part.name}
        taken={track.motions.map((one) => one.name)}
        onCommit={(name) => onChange(renamedMotion(data, track.name, part.name, name))}
      />
      <Button size="small" icon="remove" onClick={() => onChange(withoutMotion(data, track, part.name))}>
        {t("cyclogram.removeMotion")}
      </Button>
    </fieldset>
  );
}
