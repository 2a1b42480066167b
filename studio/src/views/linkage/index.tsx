/** The linkage editor. */
import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useRef } from "preact/hooks";
import { useReady } from "../../app/ready";
import { filesOf, project, useDocument, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, formatQuantity, IconButton, type Judged, Slider, Verdict, Zoom } from "../../ui";
import { Canvas } from "./canvas";
import { Editor } from "./editor";
import { range, wrapped } from "./figure";
import { createEmpty, FileBar, nameOf, openFile, pathOf } from "./files";
import { listenToKeys } from "./keys";
import { type MechanismData, nextStep } from "./mechanism";
import { Panels } from "./panels";
import { Pointer } from "./pointer";
import { ShownToggles, Toolbar, TypedSpot } from "./toolbar";
import { Tools } from "./tools";
import "./linkage.css";

const FIRST = "four-bar";

export default function Linkage({ name }: { name: string }) {
  const names = filesOf("linkage").map((file) => nameOf(file.path));
  const shown = name !== "" ? name : names.includes(FIRST) ? FIRST : names[0];
  useReady(project.value !== null && shown === undefined);
  if (project.value === null) return <p class="app-loading">{t("app.loading")}</p>;
  if (shown === undefined) {
    return (
      <div class="app-plain">
        <h1>{t("linkage.title")}</h1>
        <p>{t("linkage.noFiles")}</p>
        <Button kind="primary" onClick={() => void createEmpty()}>
          {t("linkage.new")}
        </Button>
      </div>
    );
  }
  return <LinkageFile key={shown} name={shown} names={names} />;
}

function LinkageFile({ name, names }: { name: string; names: readonly string[] }) {
  const path = pathOf(name);
  const document = useDocument<MechanismData>(path);
  const stage = useRef<HTMLDivElement>(null);
  const parts = useMemo(() => {
    const editor = new Editor(document);
    const tools = new Tools(editor);
    return { editor, tools, pointer: new Pointer(editor, tools) };
  }, [document]);
  const { editor, tools, pointer } = parts;
  const focus = () => stage.current?.querySelector<SVGElement>(".linkage-canvas")?.focus();
  useEffect(() => {
    const stop = listenToKeys(pointer, () => stage.current);
    return () => {
      stop();
      editor.dispose();
    };
  }, [parts]);
  useReady(editor.figure.value !== null || document.error.value !== null);
  return (
    <div
      class="linkage-view"
      role="group"
      aria-label={t("linkage.title")}
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        const [file] = event.dataTransfer?.files ?? [];
        if (file) void openFile(file);
      }}
    >
      <Head editor={editor} path={path}>
        <FileBar name={name} names={names} />
      </Head>
      <div class="linkage-body-area">
        <Toolbar tools={tools} onChoose={focus} />
        <div class="linkage-stage" ref={stage}>
          <Canvas editor={editor} tools={tools} pointer={pointer} />
          <p class="visually-hidden" id="linkage-keys">
            {t("linkage.keys")}
          </p>
          <Zoom onZoom={(factor) => pointer.zoom(factor)} onFit={() => pointer.fit()} />
          <TypedSpot tools={tools} onDone={focus} />
          <NextStep editor={editor} />
          <Player editor={editor} />
        </div>
        <aside class="linkage-aside" aria-label={t("linkage.panels")}>
          <ShownToggles editor={editor} />
          <Panels editor={editor} />
        </aside>
      </div>
    </div>
  );
}

function Head({ editor, path, children }: { editor: Editor; path: string; children: ComponentChildren }) {
  const { over, speed } = editor.drive.value;
  return (
    <ViewHead
      title={t("linkage.title")}
      document={editor.document}
      verdict={<Verdict checks={(editor.quality.value?.checks ?? []) as unknown as Judged[]} />}
      command={{ kind: "linkage", path, options: { over, speed } }}
    >
      {children}
    </ViewHead>
  );
}

/** What an unfinished drawing needs next. */
function NextStep({ editor }: { editor: Editor }) {
  const data = editor.document.data.value;
  const structure = editor.answer.value?.structure;
  if (data === null || !structure || editor.refused.value !== null) return null;
  const step = nextStep(data, structure);
  if (step === null) return null;
  const { degrees_of_freedom: count, driven } = structure;
  return (
    <p class="linkage-next" role="status">
      {t(`linkage.next_${step}`, { count, driven })}
    </p>
  );
}

/** Seconds that the drive takes over its range. */
const DURATION = 5;

function Player({ editor }: { editor: Editor }) {
  const playing = editor.isPlaying.value;
  const motion = editor.answer.value?.motion;
  useEffect(() => {
    if (!playing) return undefined;
    let frame = 0;
    let before = performance.now();
    let sense = 1;
    const step = (now: number) => {
      const current = editor.answer.peek()?.motion;
      if (current) {
        const [low, high] = range(current);
        const full = current.kind === "rotation" && high - low > 6.28 && current.fault === null;
        const by = (sense * (high - low) * (now - before)) / 1000 / DURATION;
        let value = editor.value.peek() + by;
        if (full) value = value > high ? value - (high - low) : value;
        else {
          const [from, to] = current.closing.find(([a, b]) => a - 1e-6 <= value - by && value - by <= b + 1e-6) ?? [
            low,
            high,
          ];
          if (value > to || value < from) sense = value > to ? -1 : 1;
          value = Math.min(Math.max(value, from), to);
        }
        editor.value.value = value;
      }
      before = now;
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  const [low, high] = motion ? range(motion) : [0, 1];
  const unit = motion?.kind === "displacement" ? "mm" : "deg";
  const value = motion ? wrapped(motion, editor.value.value) : 0;
  const closes = editor.figure.value?.closes ?? true;
  const text = formatQuantity(value, unit, 4);
  return (
    <div class="linkage-player">
      <IconButton
        icon={playing ? "pause" : "play"}
        label={t(playing ? "figure.pause" : "figure.play")}
        disabled={!motion}
        onClick={() => {
          editor.isPlaying.value = !playing;
        }}
      />
      <Slider
        bare
        label={t("linkage.driveOf", { name: motion?.driving ?? "" })}
        disabled={!motion}
        value={value}
        min={low}
        max={high}
        text={text}
        onInput={(to) => {
          editor.isPlaying.value = false;
          editor.value.value = to;
        }}
      />
      <output class={closes ? "" : "bad"}>
        {motion ? (closes ? text : t("linkage.open", { value: text })) : t("linkage.noDrive")}
      </output>
    </div>
  );
}
