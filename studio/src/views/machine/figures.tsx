import { useState } from "preact/hooks";
import type { MachineFigures, ShownFigure } from "../../api/messages";
import { aboutOf, Figure, SharedCursor } from "../../draw";
import { t } from "../../text";
import { Toggle } from "../../ui";
import { CompareButtons, Differences } from "./compare";
import type { MachineModel } from "./model";
import { overlaid } from "./overlay";

/** The chosen figures of the design; those of one machine share a cursor. */
export function Figures({ model }: { model: MachineModel }) {
  const [dashed, setDashed] = useState(true);
  const found = model.figures.value;
  if (found === null) return null;
  const chosen = model.chosen.value ?? [];
  const b = model.b.value === null || !dashed ? null : model.figuresOfB.value;
  const shown = ordered(b === null ? found.figures : overlaid(found.figures, b.figures), chosen);
  return (
    <section class="machine-figures ui-stack" aria-label={t("machine.figures")}>
      <div class="ui-row">
        <CompareButtons model={model} />
        {model.b.value !== null && <Toggle label={t("machine.overlay")} value={dashed} onChange={setDashed} />}
        <Differences model={model} />
      </div>
      {shown.length === 0 && <p class="ui-muted">{t("machine.noFigures")}</p>}
      <SharedCursor key={`${model.machine.value} ${model.part.value}`}>
        <div class="fig-grid">
          {shown.map((figure) => (
            <Figure
              key={aboutOf(figure).name}
              figure={figure}
              ghost={b?.figures.find((one) => aboutOf(one).name === aboutOf(figure).name)}
            />
          ))}
        </div>
      </SharedCursor>
      <Choose model={model} found={found} />
    </section>
  );
}

function ordered(figures: readonly ShownFigure[], names: readonly string[]): ShownFigure[] {
  return names.flatMap((name) => figures.find((figure) => aboutOf(figure).name === name) ?? []);
}

function Choose({ model, found }: { model: MachineModel; found: MachineFigures }) {
  const chosen = model.chosen.value ?? [];
  const known = found.known.filter((figure) => chosen.includes(figure.name));
  const set = (name: string, on: boolean) => {
    const names = new Set(chosen);
    if (on) names.add(name);
    else names.delete(name);
    model.chooseFigures(found.known.map((figure) => figure.name).filter((one) => names.has(one)));
  };
  return (
    <details class="ui-details">
      <summary>{t("machine.figuresShown", { count: known.length, all: found.known.length })}</summary>
      {found.parts.length > 0 && (
        <label class="ui-field machine-part">
          <span class="ui-label">{t("machine.figuresOf")}</span>
          <select
            class="ui-input"
            value={model.part.value}
            onChange={(event) => model.showPart(event.currentTarget.value)}
          >
            {[{ name: "", title: t("machine.itself") }, ...found.parts].map((part) => (
              <option key={part.name} value={part.name} selected={part.name === model.part.value}>
                {part.title}
              </option>
            ))}
          </select>
        </label>
      )}
      <div class="machine-chosen">
        {found.known.map((figure) => (
          <label key={figure.name}>
            <input
              type="checkbox"
              checked={chosen.includes(figure.name)}
              onChange={(event) => set(figure.name, event.currentTarget.checked)}
            />
            {figure.title}
          </label>
        ))}
      </div>
    </details>
  );
}
