import { useEffect, useState } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { Button, Slider, Toggle } from "../../ui";
import type { CarpetModel } from "./model";
import { countOf, findSpecks, speckEdits } from "./specks";
import { TextSetting } from "./text-setting";

/** Knots of the largest speck that is looked for. */
const MOST = 12;

/** The specks of the chart: how many of which size, shown, merged by the reading, or taken out as edits. */
export function SpecksPanel({ model }: { model: CarpetModel }) {
  const [most, setMost] = useState(3);
  const [problem, setProblem] = useState(false);
  const chart = model.chart.value;
  const specks = model.specks.value;
  useEffect(() => {
    const recipe = model.recipe.peek();
    model.specks.value = null;
    // A draft's specks are not those of the carpet.
    if (chart === null || recipe === null || chart.about.draft) return undefined;
    const abort = new AbortController();
    findSpecks(recipe, model.path, most, abort.signal).then(
      (specks) => {
        if (abort.signal.aborted) return;
        setProblem(false);
        model.specks.value = specks;
      },
      () => !abort.signal.aborted && setProblem(true),
    );
    return () => abort.abort();
  }, [model, chart, most]);
  useEffect(
    () => () => {
      model.specks.value = null;
      model.specksShown.value = false;
    },
    [model],
  );
  const count = specks === null ? 0 : countOf(specks);
  const takeOut = () => {
    if (specks !== null && chart !== null) model.edit(speckEdits(specks, chart.grid));
  };
  return (
    <div class="ui-stack">
      <TextSetting model={model} name="least_patch" label={t("carpet.leastPatch")} help={t("carpet.leastPatchHelp")} />
      <Slider
        label={t("carpet.speckSize")}
        value={most}
        min={1}
        max={MOST}
        step={1}
        text={formatNumber(most)}
        onInput={setMost}
      />
      <p class="ui-help" role="status">
        {problem ? t("carpet.noSpecks") : specks !== null && countText(count, specks.sizes)}
      </p>
      <div class="ui-row">
        <Toggle
          label={t("carpet.showSpecks")}
          value={model.specksShown.value}
          onChange={(on) => {
            model.specksShown.value = on;
          }}
        />
        <Button size="small" onClick={() => model.set({ least_patch: most + 1 })}>
          {t("carpet.mergeSpecks")}
        </Button>
        <Button size="small" disabled={count === 0} onClick={takeOut}>
          {t("carpet.takeSpecksOut", { count })}
        </Button>
      </div>
    </div>
  );
}

function countText(count: number, sizes: readonly number[]): string {
  const text = t("carpet.speckCount", { count });
  const each = sizes.flatMap((number, index) =>
    number > 0 ? [t("carpet.specksOfSize", { number: formatNumber(number), size: index + 1 })] : [],
  );
  return each.length > 0 ? `${text}: ${each.join(", ")}` : text;
}
