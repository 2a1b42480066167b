import { useState } from "preact/hooks";
import type { AssignedColour } from "../../api/messages";
import { formatNumber, t } from "../../text";
import { Button } from "../../ui";
import { mapOf, mapWith } from "./assignment";
import type { CarpetModel } from "./model";

/** Colours that are listed at first: those with most knots. */
const SHOWN = 40;

/** Each colour of the drawing and its yarn, which a click changes. */
export function Assignment({ model }: { model: CarpetModel }) {
  const [opened, setOpened] = useState("");
  const [all, setAll] = useState(false);
  const about = model.chart.value?.about;
  if (about === undefined) return null;
  const colours = about.assignment;
  const chosen = mapOf(model.recipe.value);
  if (colours.length === 0) {
    return <p class="ui-help">{t(about.reading === "photo" ? "carpet.coloursOfPhoto" : "carpet.tooManyColours")}</p>;
  }
  const give = (colour: string, yarn: string) => {
    model.set({ map: mapWith(model.recipe.peek(), colour, yarn) });
    setOpened("");
  };
  return (
    <div class="ui-stack">
      <table class="ui-table carpet-assignment">
        <caption class="ui-help">{t("carpet.assignmentHelp")}</caption>
        <thead>
          <tr>
            <th scope="col">{t("carpet.drawnColour")}</th>
            <th scope="col">{t("carpet.yarn")}</th>
            <th scope="col" class="number">
              ΔE
            </th>
            <th scope="col" class="number">
              {t("carpet.knots")}
            </th>
          </tr>
        </thead>
        <tbody>
          {colours.slice(0, all ? colours.length : SHOWN).map((row) => (
            <Row
              key={row.colour}
              model={model}
              row={row}
              isGiven={chosen[row.colour] !== undefined}
              isOpen={opened === row.colour}
              onOpen={() => setOpened(opened === row.colour ? "" : row.colour)}
              onGive={(yarn) => give(row.colour, yarn)}
            />
          ))}
        </tbody>
      </table>
      <div class="ui-row">
        {colours.length > SHOWN && !all && (
          <Button size="small" onClick={() => setAll(true)}>
            {t("carpet.allColours", { count: colours.length })}
          </Button>
        )}
        {Object.keys(chosen).length > 0 && (
          <Button size="small" onClick={() => model.set({ map: null })}>
            {t("carpet.allAutomatic")}
          </Button>
        )}
      </div>
    </div>
  );
}

interface RowProps {
  model: CarpetModel;
  row: AssignedColour;
  isGiven: boolean;
  isOpen: boolean;
  onOpen: () => void;
  onGive: (yarn: string) => void;
}

function Row({ model, row, isGiven, isOpen, onOpen, onGive }: RowProps) {
  const { colour, yarn, merged_with: merged } = row;
  return (
    <>
      <tr>
        <th scope="row">
          <span class="carpet-colour">
            <span class="carpet-swatch" style={{ background: colour }} aria-hidden="true" />
            {colour}
          </span>
        </th>
        <td>
          <button
            type="button"
            class="carpet-yarn"
            aria-expanded={isOpen}
            aria-label={t("carpet.changeYarn", { colour, yarn })}
            onClick={onOpen}
          >
            <span class="carpet-swatch" style={{ background: model.colourOf(yarn) }} aria-hidden="true" />
            <span>{yarn}</span>
            {isGiven && <span class="carpet-given">{t("carpet.byHand")}</span>}
          </button>
          {merged.length > 0 && <Merged colours={merged} />}
        </td>
        <td class="number">{formatNumber(row.delta_e, 3)}</td>
        <td class="number">{formatNumber(row.knots)}</td>
      </tr>
      {isOpen && (
        <tr>
          <td colSpan={4}>
            <Shelf model={model} row={row} isGiven={isGiven} onGive={onGive} onClose={onOpen} />
          </td>
        </tr>
      )}
    </>
  );
}

/** The other colours of the same yarn. */
function Merged({ colours }: { colours: readonly string[] }) {
  return (
    <p class="ui-help carpet-colour">
      {t("carpet.mergedWith")}
      {colours.map((colour) => (
        <span key={colour} class="carpet-swatch" style={{ background: colour }} title={colour}>
          <span class="visually-hidden">{colour}</span>
        </span>
      ))}
    </p>
  );
}

/** The yarns of the list, to choose row. */
function Shelf({
  model,
  row,
  isGiven,
  onGive,
  onClose,
}: Omit<RowProps, "isOpen" | "onOpen"> & { onClose: () => void }) {
  const listed = model.chart.value?.about.listed ?? [];
  return (
    <fieldset
      class="carpet-shelf"
      aria-label={t("carpet.chooseYarn", { colour: row.colour })}
      onKeyDown={(event) => event.key === "Escape" && onClose()}
    >
      {listed.map((yarn) => (
        <button
          key={yarn.name}
          type="button"
          class="carpet-yarn"
          aria-pressed={yarn.name === row.yarn}
          onClick={() => onGive(yarn.name)}
        >
          <span class="carpet-swatch" style={{ background: yarn.srgb }} aria-hidden="true" />
          <span>{yarn.name}</span>
        </button>
      ))}
      {isGiven && (
        <Button size="small" onClick={() => onGive("")}>
          {t("carpet.automaticYarn")}
        </Button>
      )}
    </fieldset>
  );
}
