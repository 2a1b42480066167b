/** The picture of a loom with everything that is set by hand; it needs no server. */
import type { ComponentChildren } from "preact";
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { formatNumber, t } from "../../text";
import { Button, Select, Slider, Toggle } from "../../ui";
import { DriveBar } from "./drive-bar";
import type { Live } from "./live";
import { PartDetails, PartList } from "./parts";
import { usePlayer } from "./player";
import type { Drive, SceneModel } from "./scene";
import { usePicture } from "./use-picture";
import { VIEW_NAMES } from "./views";

interface WorkbenchProps {
  model: SceneModel;
  /** What a server adds: the source of the loom above, files and a run below. */
  above?: ComponentChildren;
  below?: ComponentChildren;
  /** The drawing of a plate, where it can be had. */
  drawing?: (plate: string) => ComponentChildren;
  /** Rows that a run has woven, and the positions of its heads across [m]; null: set by hand. */
  live?: Live | null;
}

type Axis = "none" | "x" | "y" | "z";

export function Workbench({ model, above, below, drawing, live = null }: WorkbenchProps) {
  const { about } = model;
  const all = about.carpet.rows;
  const [drive, setDrive] = useState<Drive>("row");
  const [chosen, setChosen] = useState("");
  const [followed, setFollowed] = useState("");
  const [axis, setAxis] = useState<Axis>("none");
  const [cut, setCut] = useState(0.5);
  const [apart, setApart] = useState(0);
  const [names, setNames] = useState(false);
  const [rows, setRows] = useState(Math.round(0.6 * all));
  const canvas = useRef<HTMLCanvasElement>(null);
  const labels = useRef<HTMLDivElement>(null);
  const stage = usePicture(model, canvas, labels, { names, onPick: setChosen });
  const show = useCallback(
    (angle: number) => stage.current?.turn({ row: drive === "row" ? angle : 0, knot: drive === "knot" ? angle : 0 }),
    [drive, model],
  );
  const player = usePlayer(about.periods[drive], show);
  useEffect(() => stage.current?.choose(chosen), [chosen]);
  useEffect(() => stage.current?.followHead(followed === "" ? null : Number(followed)), [followed]);
  useEffect(() => stage.current?.section(axis === "none" ? null : axis, cut), [axis, cut]);
  useEffect(() => stage.current?.explode(apart), [apart]);
  useEffect(() => stage.current?.weave(live?.rows ?? rows), [rows, live?.rows]);
  useEffect(() => {
    if (live === null) return;
    stage.current?.putHeads(live.heads);
    stage.current?.turn(live.angles);
  }, [live]);
  const key = (event: KeyboardEvent) => {
    if (event.key === " ") player.playing.value = !player.playing.peek();
    else if (event.key === "Home") stage.current?.show("iso");
    else if (!stage.current?.key(event.key, event.shiftKey)) return;
    event.preventDefault();
  };
  const part = about.parts.find((one) => one.name === chosen);
  const heads = about.frames.find((one) => one.name === about.heads)?.origins[1] ?? 0;
  const copies = heads / 3;
  return (
    <div class="loom">
      <div class="loom-picture">
        {/* biome-ignore lint/a11y/noInteractiveElementToNoninteractiveRole: the picture is worked by keys */}
        <canvas
          ref={canvas}
          tabIndex={0}
          role="application"
          aria-label={t("loom.picture")}
          aria-description={t("loom.pictureHelp")}
          title={t("loom.pictureHelp")}
          onKeyDown={key}
        />
        <div class="loom-labels" ref={labels} aria-hidden="true" />
        <DriveBar
          player={player}
          drive={drive}
          period={about.periods[drive]}
          onDrive={(to) => {
            setDrive(to);
            player.angle.value = 0;
          }}
        />
      </div>
      <div class="loom-side">
        {above}
        <fieldset class="loom-views">
          <legend>{t("loom.views")}</legend>
          {VIEW_NAMES.map((name) => (
            <Button key={name} size="small" onClick={() => stage.current?.show(name)}>
              {t(`loom.${name}`)}
            </Button>
          ))}
        </fieldset>
        <Select
          label={t("loom.follow")}
          value={followed}
          choices={[
            { value: "", label: t("loom.nobody") },
            ...Array.from({ length: copies }, (_, k) => ({
              value: String(k),
              label: t("loom.headNumber", { number: k + 1 }),
            })),
          ]}
          onChange={setFollowed}
        />
        <Select
          label={t("loom.section")}
          value={axis}
          choices={[
            { value: "none" as Axis, label: t("loom.none") },
            { value: "x" as Axis, label: t("loom.across") },
            { value: "y" as Axis, label: t("loom.level") },
            { value: "z" as Axis, label: t("loom.depth") },
          ]}
          onChange={setAxis}
        />
        {axis !== "none" && (
          <Slider label={t("loom.cut")} value={cut} min={0} max={1} text={percent(cut)} onInput={setCut} />
        )}
        <Slider label={t("loom.explode")} value={apart} min={0} max={1} text={percent(apart)} onInput={setApart} />
        {live === null && (
          <Slider
            label={t("loom.rows")}
            value={rows}
            min={0}
            max={all}
            step={1}
            text={t("loom.rowsText", { rows, all })}
            onInput={setRows}
          />
        )}
        <Toggle label={t("loom.labels")} value={names} onChange={setNames} />
        {below}
        <PartList parts={about.parts} chosen={chosen} onChoose={setChosen} />
        {part && (
          <PartDetails part={part} onLook={() => stage.current?.lookAt(part.name)}>
            {part.plate !== "" && drawing?.(part.plate)}
          </PartDetails>
        )}
      </div>
    </div>
  );
}

function percent(share: number): string {
  return `${formatNumber(Math.round(100 * share))} %`;
}
