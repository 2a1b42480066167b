import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { ShownTrack } from "../../api/messages";
import { useReady } from "../../app/ready";
import { goTo } from "../../app/routes";
import { useDocument, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, FaultNote, formatQuantity, QuantityField, quantityText, Segments, Slider, Verdict } from "../../ui";
import { type Curve, QUANTITIES } from "./curves";
import { Lanes } from "./lanes";
import { type CyclogramData, DEGREE, dragged, type Grip, levelStep, TURN, withLevel, withSpan } from "./model";
import { MotionForm } from "./motion-form";
import { Readings } from "./readings";
import { Rules, rulesOf } from "./rules";
import { Solve } from "./solution";
import { CyclogramStore } from "./store";
import { Tracks } from "./tracks";

/** One cyclogram: its lanes, the cursor, its rules, its solutions, and its values typed. */
export function CyclogramEditor({ path, head }: { path: string; head: ComponentChildren }) {
  const file = useDocument<CyclogramData>(path);
  const store = useMemo(() => new CyclogramStore(), []);
  const [draft, setDraft] = useState<CyclogramData | null>(null);
  const [curve, setCurve] = useState<Curve>("position");
  const [cursor, setCursor] = useState(0);
  const [chosen, setChosen] = useState({ track: "", motion: "" });
  const base = useRef<{ data: CyclogramData; track: ShownTrack } | null>(null);
  const last = useRef<CyclogramData | null>(null);
  const saved = file.data.value;
  const data = draft ?? saved;
  useEffect(() => () => store.close(), []);
  useEffect(() => {
    if (data !== null) store.follow(data);
  }, [data]);
  const shown = store.shown.value;
  const compared = store.compared.value;
  const track = shown?.about.tracks.find((one) => one.name === chosen.track);
  const part = track?.motions.find((one) => one.name === chosen.motion);
  useReady(shown !== null || file.error.value !== null || store.fault.value !== null || file.saved.value === "missing");
  const change = (next: CyclogramData) => {
    setDraft(null);
    file.update(() => next);
  };
  /** Drags from the state at the drag's beginning, so that the pointer and what it drags stay together. */
  const drag = (track: ShownTrack, made: (from: CyclogramData, own: ShownTrack) => CyclogramData) => {
    if (saved === null) return;
    base.current ??= { data: saved, track };
    last.current = made(base.current.data, base.current.track);
    setDraft(last.current);
  };
  const onSpan = (track: ShownTrack, motion: string, grip: Grip, by: number) =>
    drag(track, (from, own) => {
      const span = dragged(own, motion, grip, by);
      return span === null ? from : withSpan(from, own.name, motion, span);
    });
  const onLevel = (track: ShownTrack, motion: string, level: number) =>
    drag(track, (from, own) => {
      const step = levelStep(own);
      return withLevel(from, own, motion, Math.round(level / step) * step);
    });
  const onEnd = () => {
    const made = last.current;
    base.current = null;
    last.current = null;
    if (made !== null) change(made);
  };
  return (
    <>
      <ViewHead
        title={t("cyclogram.title")}
        document={file}
        verdict={shown && <Verdict checks={rulesOf(shown)} />}
        command={{ kind: "cyclogram", path, options: compared ? { solve: compared.solution.goal } : {} }}
      >
        {head}
      </ViewHead>
      {/* The error of the file is shown beside its state. */}
      <FaultNote fault={file.error.value === null ? store.fault.value : null} />
      {shown === null && file.error.value !== null && (
        <div>
          <Button onClick={() => goTo("files", path)}>{t("ui.toFiles")}</Button>
        </div>
      )}
      {data === null && file.saved.value === "missing" && (
        <p class="ui-callout warn" role="alert">
          {t("cyclogram.missingFile")}
        </p>
      )}
      {data !== null && shown !== null && (
        <div class="cyclogram-columns">
          <div class="ui-stack cyclogram-main">
            <Segments
              label={t("cyclogram.curve")}
              labelHidden
              value={curve}
              choices={QUANTITIES.map((value) => ({ value, label: t(`cyclogram.${value}`) }))}
              onChange={setCurve}
            />
            <div class="cyclogram-scroll">
              <Lanes
                shown={shown}
                before={compared?.before ?? null}
                curve={curve}
                cursor={cursor}
                locked={compared !== null}
                onCursor={setCursor}
                onSpan={onSpan}
                onLevel={onLevel}
                onEnd={onEnd}
                chosen={chosen}
                onChoose={setChosen}
              />
            </div>
            <Slider
              label={t("cyclogram.cursor")}
              value={cursor}
              min={0}
              max={TURN}
              step={DEGREE}
              text={formatQuantity(cursor, "deg", 4)}
              onInput={setCursor}
            />
            <Readings shown={shown} cursor={cursor} />
            {track && part && compared === null && (
              <div class="cyclogram-chosen">
                <MotionForm data={data} track={track} part={part} laws={shown.about.laws} onChange={change} />
              </div>
            )}
            {compared === null && (
              <>
                <h2>{t("cyclogram.tracks")}</h2>
                <Tracks data={data} shown={shown} onChange={change} />
              </>
            )}
          </div>
          <div class="ui-stack cyclogram-side">
            <div class="cyclogram-period">
              <QuantityField
                label={t("cyclogram.period")}
                value={quantityText(shown.about.period, "s")}
                unit="s"
                bounds={{ above: 0 }}
                disabled={compared !== null}
                onChange={(text) => change({ ...data, period: text })}
              />
            </div>
            <Solve store={store} data={data} onTake={change} />
            <h2>{t("cyclogram.rules")}</h2>
            <Rules data={data} shown={shown} locked={compared !== null} onChange={change} />
          </div>
        </div>
      )}
    </>
  );
}
