/** The loom of the project in space: its file chosen, its model loaded, its run shown, its plates drawn, its GLB saved. */
import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { answered, postPacked } from "../../api/request";
import { useReady } from "../../app/ready";
import { goTo, rename, type ViewProps } from "../../app/routes";
import { filesOf, openDocument, project, refreshProject } from "../../project";
import { t } from "../../text";
import { Button, CopyCommand, Progress, Select, toast } from "../../ui";
import { type Live, liveOf } from "./live";
import { PlateSketch } from "./plate";
import { findRun, run } from "./run";
import { RunPanel } from "./run-panel";
import { type Comparison, modelOf, type SceneAbout, type SceneModel, takeComparison } from "./scene";
import type { WorkbenchProps } from "./workbench";
import "./loom.css";

const RECIPE = "carpet.toml";

export default function Loom({ name }: ViewProps) {
  useEffect(() => {
    if (project.peek() === null) void refreshProject().catch(() => undefined);
    void findRun();
  }, []);
  const files = loomFiles();
  const file = name || files[0];
  if (file === undefined) return project.value === null ? <Loading /> : <NoLoom />;
  return <LoomOf key={file} file={file} files={[...new Set([file, ...files])]} />;
}

/** The files of the project that a loom can be made of: the recipe, and machine files. */
function loomFiles(): string[] {
  const machines = filesOf("machine").filter((one) => /loom/.test(one.path));
  return [...filesOf("carpet"), ...machines].map((one) => one.path);
}

interface LoomOfProps {
  file: string;
  files: readonly string[];
}

function LoomOf({ file, files }: LoomOfProps) {
  const [model, setModel] = useState<SceneModel | null>(null);
  const [workbench, setWorkbench] = useState<ComponentType<WorkbenchProps> | null>(null);
  const [error, setError] = useState("");
  const document = openDocument(file);
  const isRead = document.saved.value !== "loading";
  useEffect(() => {
    const refused = document.error.peek();
    if (refused !== null) setError([refused.given, refused.allowed, refused.do].filter(Boolean).join("; "));
    if (!isRead || refused !== null) return undefined;
    const control = new AbortController();
    Promise.all([postPacked<SceneAbout>("/loom/scene", { file }, control.signal), import("./workbench")]).then(
      ([answer, module]) => {
        setWorkbench(() => module.Workbench);
        setModel(modelOf(answer));
      },
      (reason: unknown) => {
        if (!control.signal.aborted) setError(reason instanceof Error ? reason.message : String(reason));
      },
    );
    return () => control.abort();
  }, [isRead]);
  const [, setCompared] = useState(false);
  useEffect(() => {
    if (model === null || model.about.nearest !== null) return undefined;
    const control = new AbortController();
    postPacked<Comparison>("/loom/space", { file }, control.signal).then(
      ({ about }) => {
        takeComparison(model, about);
        setCompared(true);
      },
      (reason: unknown) => {
        if (!control.signal.aborted) toast(reason instanceof Error ? reason.message : String(reason));
      },
    );
    return () => control.abort();
  }, [model]);
  const live = useLive(file, model);
  useReady(model !== null || error !== "");
  if (error !== "") return <Sorry file={file} files={files} reason={error} />;
  if (model === null || workbench === null) return <Loading />;
  const Shown = workbench;
  const ties = model.about.periods.knot !== undefined;
  return (
    <Shown
      model={model}
      above={
        <div>
          <h1>{model.about.title}</h1>
          <Source file={file} files={files} />
        </div>
      }
      below={<Files file={file} />}
      running={ties && <RunPanel file={file} weaves={model.about.chart !== null} />}
      live={live}
      drawing={(plate) => <PlateSketch file={file} plate={plate} />}
    />
  );
}

/** What the run of a file shows; null: it does not run. */
function useLive(file: string, model: SceneModel | null): Live | null {
  const [live, setLive] = useState<Live | null>(null);
  useEffect(() => {
    let before: Live | null = null;
    return run.subscribe((now) => {
      if (model === null || now?.file !== file || now.news === null) return;
      before = liveOf(model, now, now.news, before);
      setLive(before);
    });
  }, [model]);
  return live;
}

function Loading() {
  return (
    <div class="app-plain">
      <h1>{t("loom.title")}</h1>
      <Progress label={t("loom.loading")} />
    </div>
  );
}

function NoLoom() {
  useReady(true);
  return (
    <div class="app-plain">
      <h1>{t("loom.title")}</h1>
      <p>{t("loom.noLoom")}</p>
      <div class="ui-row">
        <Button kind="primary" onClick={() => goTo("machine", "automated-loom")}>
          {t("loom.designOne")}
        </Button>
        <Button onClick={() => goTo("carpet")}>{t("loom.toCarpet")}</Button>
      </div>
    </div>
  );
}

function Source({ file, files }: LoomOfProps) {
  const choices = files.map((path) => ({ value: path, label: path }));
  return <Select label={t("loom.file")} value={file} choices={choices} onChange={rename} />;
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

function Sorry({ file, files, reason }: LoomOfProps & { reason: string }) {
  return (
    <div class="app-plain">
      <h1>{t("loom.title")}</h1>
      <p class="ui-callout bad" role="alert">
        {`${t("loom.failed")}: ${reason}`}
      </p>
      <Source file={file} files={files} />
      <CopyCommand command={command(file)} />
    </div>
  );
}
