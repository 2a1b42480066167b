/** The panel of the motion: drive, transmission angle, where it closes, circuits, coupler curves. */

import { Fragment } from "preact";
import { CursorContext } from "../../draw";
import { formatNumber, t } from "../../text";
import { formatQuantity, QuantityField } from "../../ui";
import { Curve, useDriveCursor } from "./curve";
import type { Editor } from "./editor";
import { EntryField } from "./entries";

/** Least transmission angle that links are usually designed for [rad]. */
const USUAL = (40 * Math.PI) / 180;

export function Motion({ editor }: { editor: Editor }) {
  const answer = editor.answer.value;
  const motion = answer?.motion;
  const turning = motion?.kind !== "displacement";
  const cursors = useDriveCursor(editor);
  return (
    <div class="linkage-motion">
      <DriveFields editor={editor} turning={turning} />
      {motion && (
        <CursorContext.Provider value={cursors}>
          <Curve
            motion={motion}
            title={t("linkage.transmission")}
            unit="deg"
            series={motion.transmission}
            limit={{ value: USUAL, label: t("linkage.usual") }}
          />
          {motion.forces && (
            <Curve
              motion={motion}
              title={t("linkage.effort")}
              unit={turning ? "N*m" : "N"}
              series={{ [motion.driving]: motion.forces.effort }}
            />
          )}
          <MotionFacts editor={editor} />
        </CursorContext.Provider>
      )}
      <Quality editor={editor} shown={(value) => driveText(turning, value)} />
    </div>
  );
}

function driveText(turning: boolean, value: number): string {
  return formatQuantity(value, turning ? "deg" : "mm", 5);
}

/** Where the mechanism closes, its dead centres and least transmission angles: they follow a drag. */
export function MotionFacts({ editor }: { editor: Editor }) {
  const motion = editor.answer.value?.motion;
  if (!motion) return null;
  const shown = (value: number) => driveText(motion.kind !== "displacement", value);
  return (
    <dl class="linkage-facts wide">
      <dt>{t("linkage.closes")}</dt>
      <dd>{motion.closing.map(([low, high]) => `${shown(low)} … ${shown(high)}`).join(", ") || "–"}</dd>
      <dt>{t("linkage.deadCentres")}</dt>
      <dd>
        {motion.dead_centres.map((one) => `${shown(one.value)} (${one.bodies.join(", ")})`).join(", ") ||
          t("linkage.noneFound")}
      </dd>
      {motion.change_points.length > 0 && (
        <>
          <dt>{t("linkage.changePoints")}</dt>
          <dd>{motion.change_points.map(shown).join(", ")}</dd>
        </>
      )}
      {Object.entries(motion.transmission).map(([pin, angles]) => {
        const least = leastOf(angles);
        return least === null ? null : (
          <Fragment key={pin}>
            <dt>{t("linkage.leastTransmission", { pin })}</dt>
            <dd>
              {t("linkage.atValue", {
                angle: formatQuantity(angles[least] ?? 0, "deg"),
                value: shown(motion.values[least] ?? 0),
              })}
            </dd>
          </Fragment>
        );
      })}
    </dl>
  );
}

/** The sample of the least number; null where there is none. */
function leastOf(numbers: readonly (number | null)[]): number | null {
  let found: number | null = null;
  numbers.forEach((one, index) => {
    if (one !== null && (found === null || one < (numbers[found] ?? 0))) found = index;
  });
  return found;
}

function DriveFields({ editor, turning }: { editor: Editor; turning: boolean }) {
  const answer = editor.answer.value;
  const drive = editor.drive.value;
  const others = (answer?.inputs ?? []).filter((input) => input.name !== answer?.motion?.driving);
  return (
    <div class="linkage-drive">
      <EntryField
        label={t("linkage.over")}
        value={drive.over}
        onCommit={(over) => {
          editor.drive.value = { ...editor.drive.peek(), over };
        }}
      />
      <p class="ui-help">{t(turning ? "linkage.overTurn" : "linkage.overSlide")}</p>
      <EntryField
        label={t("linkage.speedOf")}
        value={drive.speed}
        onCommit={(speed) => {
          editor.drive.value = { ...editor.drive.peek(), speed };
        }}
      />
      <p class="ui-help">{t("linkage.speedHelp")}</p>
      {others.map((input) => (
        <QuantityField
          key={input.name}
          label={t("linkage.fixed", { name: input.name })}
          unit={input.kind === "rotation" ? "deg" : "mm"}
          optional
          placeholder="0"
          value={drive.fixed[input.name] ?? ""}
          onChange={(text) => {
            const { [input.name]: _, ...fixed } = drive.fixed;
            editor.drive.value = {
              ...editor.drive.peek(),
              fixed: text === "" ? fixed : { ...fixed, [input.name]: text },
            };
          }}
        />
      ))}
    </div>
  );
}

function Quality({ editor, shown }: { editor: Editor; shown: (value: number) => string }) {
  const quality = editor.quality.value;
  if (!quality) return null;
  return (
    <>
      {quality.circuits.length > 0 && (
        <section>
          <h2>{t("linkage.circuits", { count: quality.circuits.length })}</h2>
          <ol class="linkage-circuits">
            {quality.circuits.map((circuit, index) => (
              <li key={index} aria-current={circuit.current}>
                {circuit.current && <b>{t("linkage.asDrawn")} </b>}
                {circuit.branches
                  .map((branch) =>
                    branch.full ? t("linkage.fullTurn") : `${shown(branch.start)} … ${shown(branch.stop)}`,
                  )
                  .join("; ")}
                {circuit.crossings.length > 0 &&
                  ` ${t("linkage.crosses", { at: circuit.crossings.map(shown).join(", ") })}`}
              </li>
            ))}
          </ol>
        </section>
      )}
      {quality.curves.length > 0 && (
        <section>
          <h2>{t("linkage.curves")}</h2>
          <ul>
            {quality.curves.map((curve) => (
              <li key={`${curve.body}.${curve.point}`}>
                {t("linkage.curve", {
                  point: `${curve.body}.${curve.point}`,
                  length: formatQuantity(curve.length, "mm"),
                  cusps: formatNumber(curve.cusps.length),
                  crossings: formatNumber(curve.crossings.length),
                  inflections: formatNumber(curve.inflections.length),
                })}
              </li>
            ))}
          </ul>
        </section>
      )}
    </>
  );
}
