/** The picture of a loom with everything that is set by hand, and its parts; it needs no server. */
import type { ComponentChildren } from "preact";
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { t } from "../../text";
import { Tabs } from "../../ui";
import { Controls, type PictureState } from "./controls";
import { DriveBar } from "./drive-bar";
import type { Live } from "./live";
import { openShed, TURN, underWay } from "./motion";
import { NearestPairs } from "./nearest-pairs";
import { Failures, neighbour, PartDetails, PartList } from "./parts";
import { type Player, usePlayer } from "./player";
import { type Drive, drivesOf, type NearPair, partsOf, type SceneModel } from "./scene";
import type { Stage } from "./stage";
import { graphics } from "./surroundings";
import { usePicture } from "./use-picture";
import type { ViewName } from "./views";

export interface WorkbenchProps {
  model: SceneModel;
  /** A run of the twin, where there is a server. */
  running?: ComponentChildren;
  /** The drawing of a plate, where it can be had. */
  drawing?: (plate: string) => ComponentChildren;
  /** Rows that a run has woven, its heads and angles; null: none. */
  live?: Live | null;
}

type Tab = "look" | "parts" | "clearances" | "run";

/** A press of "," or "." turns by so much, with Shift by ten times [rad]. */
const SCRUB = TURN / 360;

export function Workbench({ model, running, drawing, live = null }: WorkbenchProps) {
  const { about } = model;
  const drawn = graphics() !== "none";
  const drives = drivesOf(about);
  const [drive, setDrive] = useState<Drive>(drives[0] ?? "row");
  const period = about.periods[drive] ?? 1;
  const [chosen, setChosen] = useState("");
  const [shown, setShown] = useState<ViewName>("iso");
  const [pair, setPair] = useState<NearPair | null>(null);
  const [tab, setTab] = useState<Tab>(drawn ? "look" : "parts");
  const [state, setState] = useState<PictureState>(() => ({
    followed: "",
    axis: "none",
    cut: 0.5,
    apart: 0,
    names: false,
    measures: false,
    guards: false,
    rows: Math.round(0.6 * about.carpet.rows),
  }));
  const canvas = useRef<HTMLCanvasElement>(null);
  const labels = useRef<HTMLDivElement>(null);
  const pick = (name: string) => {
    setChosen(name);
    setPair(null);
    if (name !== "") setTab("parts");
  };
  const stage = usePicture(model, canvas, labels, { names: state.names, onPick: pick });
  const show = useCallback((angle: number) => stage.current?.turn({ [drive]: angle }), [drive, model]);
  const player = usePlayer(period, show);
  useEffect(() => {
    if (pair === null) {
      stage.current?.choose([chosen]);
      return undefined;
    }
    const names = partsOf(about, pair).map((part) => part.name);
    stage.current?.shiftHeads(pair.heads_shift);
    stage.current?.choose(names, true);
    stage.current?.lookAt(...names);
    return () => stage.current?.shiftHeads(0);
  }, [chosen, pair]);
  useEffect(() => stage.current?.followHead(state.followed === "" ? null : Number(state.followed)), [state.followed]);
  useEffect(
    () => stage.current?.section(state.axis === "none" ? null : state.axis, state.cut),
    [state.axis, state.cut],
  );
  useEffect(() => stage.current?.explode(state.apart), [state.apart]);
  useEffect(() => stage.current?.guard(state.guards), [state.guards, model]);
  useEffect(() => stage.current?.measureByPress(state.measures), [state.measures]);
  useEffect(() => stage.current?.weave(state.rows), [state.rows]);
  useEffect(() => {
    if (live === null) return;
    if (live.going) player.playing.value = false;
    setState((now) => (now.rows === live.rows ? now : { ...now, rows: live.rows }));
    stage.current?.putHeads(live.heads);
    stage.current?.turn(live.angles);
  }, [live]);
  const byHand = live?.going !== true;
  useEffect(() => {
    if (live?.going) setTab("run");
  }, [live?.going]);
  const onPair = (next: NearPair) => {
    const turns = drives.find((one) => one === next.cyclogram) ?? null;
    player.playing.value = false;
    if (turns !== null && turns !== drive) setDrive(turns);
    player.angle.value = turns === null ? 0 : next.angle;
    setPair(next);
  };
  const onShow = (view: ViewName) => {
    const open = openShed(model);
    const turns = view === "head" ? "knot" : view === "shed" ? open.drive : null;
    if (byHand && turns !== null) {
      setDrive(turns);
      if (turns !== drive) player.angle.value = 0;
      if (view === "shed") player.angle.value = open.angle;
    }
    const cut =
      view === "shed" ? { axis: "x" as const, cut: stage.current?.shedCut ?? 0.5 } : { axis: "none" as const };
    if (view === "shed" || shown === "shed") setState((now) => ({ ...now, ...cut }));
    setShown(view);
    stage.current?.show(view);
  };
  const onLook = (name: string) => {
    stage.current?.choose([name], true);
    stage.current?.lookAt(name);
  };
  const onKey = (event: KeyboardEvent) => {
    const next = neighbour(about.parts, chosen, event.key);
    if (next !== null) pick(next);
    else if (!turned(event, player, byHand) && !moved(event, stage.current)) return;
    event.preventDefault();
  };
  const part = about.parts.find((one) => one.name === chosen);
  const heads = about.frames.find((one) => one.name === about.heads)?.origins[1] ?? 0;
  const tabs = [
    ...(drawn ? [{ value: "look" as Tab, label: t("loom.look") }] : []),
    { value: "parts" as Tab, label: t("loom.parts") },
    { value: "clearances" as Tab, label: t("loom.clearances") },
    ...(!running ? [] : [{ value: "run" as Tab, label: t("loom.run") }]),
  ];
  return (
    <div class="loom">
      <div class="loom-picture">
        {drawn ? (
          <>
            {/* biome-ignore lint/a11y/noInteractiveElementToNoninteractiveRole: the picture is worked by keys */}
            <canvas
              ref={canvas}
              tabIndex={0}
              role="application"
              aria-label={t("loom.picture")}
              aria-description={t("loom.pictureHelp")}
              title={t("loom.pictureHelp")}
              onKeyDown={onKey}
            />
            <div class="loom-labels" ref={labels} aria-hidden="true" />
            {byHand && (
              <DriveBar
                player={player}
                drive={drive}
                period={period}
                drives={drives}
                motions={(angle) => underWay(model, drive, angle)}
                onDrive={(to) => {
                  setDrive(to);
                  player.angle.value = 0;
                }}
              />
            )}
          </>
        ) : (
          <p class="ui-callout warn">{t("loom.noWebgl")}</p>
        )}
      </div>
      <div class="loom-side">
        <Failures checks={about.failures} parts={about.parts} onChoose={pick} />
        <Tabs label={t("loom.sides")} value={tab} tabs={tabs} onChange={setTab}>
          <div class="loom-tab">
            {tab === "look" && (
              <Controls
                state={state}
                heads={heads / 3}
                guarded={about.guards.length > 0}
                rows={byHand ? about.carpet.rows : null}
                onShow={onShow}
                onChange={(change) => setState((now) => ({ ...now, ...change }))}
              />
            )}
            {tab === "parts" && <PartList parts={about.parts} chosen={chosen} onChoose={pick} />}
            {tab === "parts" && part && (
              <PartDetails model={model} part={part} onLook={drawn ? () => onLook(part.name) : null}>
                {part.plate !== "" && drawing?.(part.plate)}
              </PartDetails>
            )}
            {tab === "clearances" && <NearestPairs about={about} chosen={pair} onChoose={byHand ? onPair : null} />}
            {tab === "run" && running}
          </div>
        </Tabs>
      </div>
    </div>
  );
}

/** What a key does to the camera; whether it does anything. */
function moved({ key, shiftKey }: KeyboardEvent, stage: Stage | null): boolean {
  if (key !== "Home") return stage?.key(key, shiftKey) ?? false;
  stage?.show("iso");
  return true;
}

/** What a key does to the master angle; whether it does anything. */
function turned({ key }: KeyboardEvent, { playing, angle }: Player, byHand: boolean): boolean {
  const steps = { ",": -1, ".": 1, "<": -10, ">": 10 }[key];
  if (!byHand || (steps === undefined && key !== " ")) return false;
  if (steps === undefined) playing.value = !playing.peek();
  else angle.value = (angle.peek() + steps * SCRUB + TURN) % TURN;
  return true;
}
