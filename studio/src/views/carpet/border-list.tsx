import { project } from "../../project";
import { t } from "../../text";
import { Button, IconButton, NumberField, Select } from "../../ui";
import { asKind, BORDER_KINDS, type Border, bordersOf, kindOf, movedBorder } from "./borders";
import type { CarpetModel } from "./model";

/** The borders of the recipe, from the edge inwards: stripes, teeth, and patterns with corners. */
export function Borders({ model }: { model: CarpetModel }) {
  const borders = bordersOf(model.recipe.value);
  const yarns = [...new Set(model.yarns().map((yarn) => yarn.name))];
  const set = (all: readonly Border[]) => model.set({ border: all.length > 0 ? all : null });
  return (
    <div class="ui-stack">
      <p class="ui-help">{t("carpet.bordersHelp")}</p>
      <ol class="carpet-borders" aria-label={t("carpet.borders")}>
        {borders.map((border, place) => (
          <li key={place}>
            <BorderForm
              border={border}
              number={place + 1}
              yarns={yarns}
              onChange={(changed) => set(borders.map((other, index) => (index === place ? changed : other)))}
            />
            <span class="ui-row">
              <IconButton
                icon="up"
                size="small"
                label={t("carpet.outwards", { number: place + 1 })}
                disabled={place === 0}
                onClick={() => set(movedBorder(borders, place, place - 1))}
              />
              <IconButton
                icon="down"
                size="small"
                label={t("carpet.inwards", { number: place + 1 })}
                disabled={place === borders.length - 1}
                onClick={() => set(movedBorder(borders, place, place + 1))}
              />
              <IconButton
                icon="remove"
                size="small"
                label={t("carpet.dropBorder", { number: place + 1 })}
                onClick={() => set(borders.filter((_, index) => index !== place))}
              />
            </span>
          </li>
        ))}
      </ol>
      <div class="ui-row">
        <Button
          disabled={yarns.length === 0}
          onClick={() => {
            set([...borders, { width: 3, yarn: model.yarn.peek() || (yarns[0] ?? "") }]);
            model.takeTool("border");
          }}
        >
          {t("carpet.addBorder")}
        </Button>
      </div>
    </div>
  );
}

interface FormProps {
  border: Border;
  number: number;
  yarns: readonly string[];
  onChange: (border: Border) => void;
}

function BorderForm({ border, number, yarns, onChange }: FormProps) {
  const kind = kindOf(border);
  // The smallest first: a tile is seldom a large picture.
  const tiles = [...(project.value?.pictures ?? [])].sort((a, b) => a.size - b.size).map((picture) => picture.path);
  const [first = "", second = ""] = border.teeth ?? [];
  const yarnOf = (label: string, value: string, give: (yarn: string) => void) => (
    <Select label={label} value={value} choices={choicesOf([...new Set([value, ...yarns])])} onChange={give} />
  );
  return (
    <div class="carpet-pair">
      <Select
        label={t("carpet.borderKind", { number })}
        value={kind}
        choices={BORDER_KINDS.filter((kind) => kind !== "tile" || tiles.length > 0).map((kind) => ({
          value: kind,
          label: t(`carpet.${kind}Border`),
        }))}
        onChange={(chosen) => onChange(asKind(border, chosen, yarns, tiles))}
      />
      {typeof border.width === "number" && (
        <NumberField
          label={t("carpet.borderWidth")}
          value={border.width}
          min={1}
          max={1000}
          onChange={(width) => onChange({ ...border, width: Math.round(width) })}
        />
      )}
      {kind === "stripe" && yarnOf(t("carpet.yarn"), border.yarn ?? "", (yarn) => onChange({ ...border, yarn }))}
      {kind === "teeth" &&
        yarnOf(t("carpet.outerTeeth"), first, (yarn) => onChange({ ...border, teeth: [yarn, second] }))}
      {kind === "teeth" &&
        yarnOf(t("carpet.innerTeeth"), second, (yarn) => onChange({ ...border, teeth: [first, yarn] }))}
      {kind === "tile" && (
        <Select
          label={t("carpet.tile")}
          value={border.tile ?? ""}
          choices={choicesOf(tiles)}
          onChange={(tile) => onChange({ ...border, tile })}
        />
      )}
      {kind === "tile" && (
        <Select
          label={t("carpet.corner")}
          value={border.corner ?? ""}
          choices={[{ value: "", label: t("carpet.ownCorner") }, ...choicesOf(tiles)]}
          onChange={(corner) => onChange(withCorner(border, corner))}
        />
      )}
    </div>
  );
}

function withCorner({ corner: _, ...border }: Border, corner: string): Border {
  return corner === "" ? border : { ...border, corner };
}

function choicesOf(names: readonly string[]) {
  return names.map((name) => ({ value: name, label: name.replace(/^pictures\//, "") }));
}
