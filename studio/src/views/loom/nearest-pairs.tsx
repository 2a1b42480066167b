/** The pairs of parts that come nearest to each other, or are through each other: a press shows two of them. */
import { t } from "../../text";
import { Button, formatQuantity, Progress } from "../../ui";
import { type NearPair, partsOf, type SceneAbout } from "./scene";

interface NearestProps {
  about: SceneAbout;
  chosen: NearPair | null;
  /** Shows a pair; null: the loom is not moved by hand. */
  onChoose: ((pair: NearPair) => void) | null;
}

export function NearestPairs({ about, chosen, onChoose }: NearestProps) {
  if (about.nearest === null) return <Progress label={t("loom.comparing")} />;
  if (about.nearest.length === 0) return <p class="ui-muted">{t("loom.noneNear")}</p>;
  return (
    <section class="loom-nearest" aria-label={t("loom.clearances")}>
      <p class="ui-muted">{t("loom.clearancesHelp")}</p>
      <ul>
        {about.nearest.map((pair) => (
          <li key={`${pair.parts.join()} ${pair.cyclogram} ${pair.angle}`} class={pair.distance < 0 ? "bad" : ""}>
            <Button
              size="small"
              pressed={pair === chosen}
              disabled={onChoose === null}
              onClick={() => onChoose?.(pair)}
            >
              {partsOf(about, pair)
                .map((part) => part.title)
                .join(" – ")}
            </Button>
            <b>{formatQuantity(pair.distance, "mm")}</b>
            <span class="ui-muted">{occasion(pair)}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}

const AT: Partial<Record<string, "loom.atOfRow" | "loom.atOfKnot" | "loom.atOfShed" | "loom.atOfBeat">> = {
  row: "loom.atOfRow",
  knot: "loom.atOfKnot",
  shed: "loom.atOfShed",
  beat: "loom.atOfBeat",
};

/** When two parts come nearest: the angle of what turns, and where the heads stand. */
function occasion({ cyclogram, angle, heads_shift }: NearPair): string {
  const heads = Math.abs(heads_shift) < 1e-6 ? "" : t("loom.headsBeside", { shift: formatQuantity(heads_shift, "mm") });
  const at = AT[cyclogram];
  if (at === undefined) return heads === "" ? t("loom.always") : heads;
  const when = t(at, { angle: formatQuantity(angle, "deg") });
  return heads === "" ? when : `${when}, ${heads}`;
}
