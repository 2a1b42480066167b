/** The loom of the project in space: its file chosen, its model loaded, its plates drawn, its GLB saved. */
import type { ComponentChildren, ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { type ApiError, answered, postPacked } from "../../api/request";
import { useReady } from "../../app/ready";
import { rename, type ViewProps } from "../../app/routes";
import { project } from "../../project";
import { t } from "../../text";
import { Button, CopyCommand, Progress, Select, toast } from "../../ui";
import type { Live } from "./live";
import { PlateSketch } from "./plate";
import { RunPanel } from "./run-panel";
import { type SceneAbout, type SceneModel, sceneModel } from "./scene";
import "./loom.css";

const RECIPE = "carpet.toml";

export default function Loom({ name }: ViewProps) {
  const file = name || RECIPE;
  const [model, setModel] = useState<SceneModel | null>(null);
  const [live, setLive] = useState<Live | null>(null);
  const [error, setError] = useState<ApiError | Error | null>(null);
  const [workbench, setWorkbench] = useState<ComponentType<WorkbenchProps> | null>(null);
  useEffect(() => {
    const control = new AbortController();
    setError(null);
    setModel(null);
    setLive(null);
    Promise.all([loadModel(file, control.signal), import("./workbench")]).then(
      ([found, module]) => {
        setWorkbench(() => module.Workbench);
        setModel(found);
      },
      (reason: unknown) => {
        if (!control.signal.aborted) setError(reason instanceof Error ? reason : new Error(String(reason)));
      },
    );
    return () => control.abort();
  }, [file]);
  useReady(model !== null && workbench !== null);
  if (!hasWebgl()) return <Sorry text={t("loom.noWebgl")} file={file} />;
  if (error !== null) return <Sorry text={`${t("loom.failed")}: ${error.message}`} file={file} />;
  if (model === null || workbench === null)
    return (
      <div class="app-plain">
        <h1>{t("loom.title")}</h1>
        <Progress label={t("loom.loading")} />
      </div>
    );
  const Shown = workbench;
  const below = (
    <>
      <RunPanel key={file} file={file} model={model} onLive={setLive} />
      <Files file={file} />
    </>
  );
  return (
    <Shown
      key={file}
      model={model}
      above={<Source file={file} title={model.about.title} />}
      below={below}
      live={live}
      drawing={(plate) => <PlateSketch file={file} plate={plate} />}
    />
  );
}

interface WorkbenchProps {
  model: SceneModel;
  above?: ComponentChildren;
  below?: ComponentChildren;
  drawing?: (plate: string) => ComponentChildren;
  live?: Live | null;
}

async function loadModel(file: string, signal: AbortSignal): Promise<SceneModel> {
  const answer = await postPacked<SceneAbout>("/loom/scene", { file }, signal);
  const [floats, integers, knots] = answer.parts(answer.about.lengths);
  if (!floats || !integers || !knots) throw new Error("a scene without its numbers");
  return sceneModel(answer.about, exact(floats), exact(integers), knots);
}

function exact(part: Uint8Array<ArrayBuffer>): ArrayBuffer {
  return part.buffer.slice(part.byteOffset, part.byteOffset + part.byteLength);
}

let webgl: boolean | null = null;
function hasWebgl(): boolean {
  webgl ??= document.createElement("canvas").getContext("webgl2") !== null;
  return webgl;
}

/** The files of the project that a loom can be made of: the recipe, and machine files. */
function Source({ file, title }: { file: string; title: string }) {
  const paths = (project.value?.files ?? [])
    .filter((one) => one.kind === "carpet" || (one.kind === "machine" && /loom/.test(one.path)))
    .map((one) => one.path);
  const choices = [...new Set([file, ...paths])].map((path) => ({ value: path, label: path }));
  return (
    <div>
      <h1>{title}</h1>
      <Select label={t("loom.file")} value={file} choices={choices} onChange={rename} />
    </div>
  );
}

function Files({ file }: { file: string }) {
  const save = async () => {
    try {
      const body = { body: JSON.stringify({ file }), type: "application/json" };
      const blob = await (await answered("POST", "/loom/glb", body)).blob();
      const link = document.createElement("a");
      link.href = URL.createObjectURL(blob);
      link.download = "loom.glb";
      link.click();
      URL.revokeObjectURL(link.href);
      toast(t("loom.glbSaved"), "good");
    } catch (reason) {
      toast(reason instanceof Error ? reason.message : String(reason), "bad");
    }
  };
  return (
    <details class="loom-files">
      <summary>{t("loom.export")}</summary>
      <Button icon="download" onClick={save}>
        {t("loom.glb")}
      </Button>
      <CopyCommand command={command(file)} />
    </details>
  );
}

function command(file: string): string {
  return file === RECIPE ? `ilmek weave ${file}` : `ilmek design ${file} --glb loom.glb`;
}

function Sorry({ text, file }: { text: string; file: string }) {
  return (
    <div class="app-plain">
      <h1>{t("loom.title")}</h1>
      <p class="ui-callout bad" role="alert">
        {text}
      </p>
      <Source file={file} title="" />
      <CopyCommand command={command(file)} />
    </div>
  );
}
