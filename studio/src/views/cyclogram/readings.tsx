import type { ShownTrack } from "../../api/messages";
import { t } from "../../text";
import { formatQuantity } from "../../ui";
import { type Curve, QUANTITIES, rangeOf, type Shown, unitOf, valueAt } from "./curves";
import { TURN } from "./model";

/** What every track does at the cursor, with units; beside it the largest values of the turn. */
export function Readings({ shown, cursor }: { shown: Shown; cursor: number }) {
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("cyclogram.atCursor")}>
      <table class="ui-table">
        <caption>
          {t("cyclogram.atAngle", {
            angle: formatQuantity(cursor, "deg", 4),
            time: formatQuantity((cursor / TURN) * shown.about.period, "s", 3),
          })}
        </caption>
        <thead>
          <tr>
            <th scope="col">{t("cyclogram.track")}</th>
            {QUANTITIES.map((curve) => (
              <th key={curve} scope="col" class="number">
                {t(`cyclogram.${curve}`)}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {shown.about.tracks.map((track, index) => (
            <tr key={track.name}>
              <th scope="row">{track.name}</th>
              {QUANTITIES.map((curve) => (
                <td key={curve} class="number">
                  {reading(shown, index, track.shown_unit, curve, cursor)}
                  {curve !== "position" && <span class="cyclogram-peak">{peakText(track, curve)}</span>}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function reading(shown: Shown, index: number, unit: string, curve: Curve, cursor: number): string {
  const curves = shown.curves[index];
  if (curves === undefined) return "–";
  const { low, high } = rangeOf(curves[curve], curve);
  const value = valueAt(curves, curve, cursor);
  const isNoise = Math.abs(value) < 1e-6 * (high - low);
  return formatQuantity(isNoise ? 0 : value, unitOf(unit, curve), 4);
}

const PEAKS = { velocity: "speed", acceleration: "acceleration", jerk: "jerk" } as const;

function peakText(track: ShownTrack, curve: Exclude<Curve, "position">): string {
  const peak = track.peaks[PEAKS[curve]];
  return t("cyclogram.atMost", {
    value: peak == null ? "∞" : formatQuantity(peak, unitOf(track.shown_unit, curve), 3),
  });
}
