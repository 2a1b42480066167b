import { t } from "../../text";
import { Segments, Slider } from "../../ui";
import type { CarpetModel } from "./model";

/** The slider between the chart, or the picture, at the left and the woven carpet at the right. */
export function Compare({ model }: { model: CarpetModel }) {
  const share = Math.round(100 * model.split.value);
  const left = leftName(model);
  return (
    <div class="carpet-compare">
      <span>{t("carpet.share", { name: left, share })}</span>
      <Slider
        bare
        label={t("carpet.compare")}
        value={model.split.value}
        min={0}
        max={1}
        step={0.01}
        text={t("carpet.compareText", { left, share })}
        onInput={(value) => {
          model.split.value = value;
        }}
      />
      <span>{t("carpet.share", { name: t("carpet.carpet"), share: 100 - share })}</span>
      <Segments
        label={t("carpet.left")}
        labelHidden
        value={model.left.value}
        choices={[
          { value: "chart", label: t("carpet.chart") },
          { value: "source", label: t("carpet.sourcePicture") },
        ]}
        onChange={(chosen) => {
          model.left.value = chosen;
          if (model.split.peek() < 0.05) model.split.value = 0.5;
        }}
      />
    </div>
  );
}

/** The line over the chart, which is dragged, and what lies on its sides. */
export function CompareLine({ model }: { model: CarpetModel }) {
  const split = model.split.value;
  const drag = (event: PointerEvent) => {
    const grip = event.currentTarget as HTMLElement;
    const box = grip.parentElement?.getBoundingClientRect();
    if (box === undefined || !grip.hasPointerCapture(event.pointerId)) return;
    model.split.value = Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1);
  };
  const left = `${100 * split}%`;
  return (
    <>
      {split > 0.05 && split < 0.95 && (
        <div class="carpet-sides" style={{ left }} aria-hidden="true">
          <span>{leftName(model)}</span>
          <span>{t("carpet.carpet")}</span>
        </div>
      )}
      <div
        class="carpet-grip"
        role="presentation"
        style={{ left }}
        title={t("carpet.compare")}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={drag}
      />
    </>
  );
}

function leftName(model: CarpetModel): string {
  return model.left.value === "chart" ? t("carpet.chart") : t("carpet.sourcePicture");
}
