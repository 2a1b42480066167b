/** The loom of the project in space: its file chosen, its model loaded, its run shown, its plates drawn, its GLB saved. */
import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { answered, postPacked } from "../../api/request";
import { useReady } from "../../app/ready";
import { goTo, rename, type ViewProps } from "../../app/routes";
import { filesOf, project, useDocument, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, Progress, Select, toast, Verdict, VerdictBadge } from "../../ui";
import { type Live, liveOf } from "./live";
import { PlateSketch } from "./plate";
import { findRun, run } from "./run";
import { RunPanel } from "./run-panel";
import { type Comparison, modelOf, type SceneAbout, type SceneModel, takeComparison } from "./scene";
import type { WorkbenchProps } from "./workbench";
import "./loom.css";

const RECIPE = "carpet.toml";

export default function Loom({ name }: ViewProps) {
  useEffect(() => void findRun(), []);
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
  const document = useDocument(file);
  const isRead = !["loading", "changed", "saving"].includes(document.saved.value);
  const text = document.text.value;
  useEffect(() => {
    const refused = document.error.peek();
    setError(refused === null ? "" : [refused.given, refused.allowed, refused.do].filter(Boolean).join("; "));
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
  }, [isRead, text]);
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
  const Shown = workbench;
  return (
    <div class="loom-view">
      <ViewHead
        title={t("loom.title")}
        document={document}
        verdict={model?.about.nearest && <Found failures={model.about.failures} />}
        command={{ kind: file === RECIPE ? "carpet" : "machine", path: file }}
      >
        <Select label={t("loom.file")} value={file} choices={choicesOf(files)} onChange={rename} />
        <Button icon="download" onClick={() => void saveGlb(file)}>
          {t("loom.glb")}
        </Button>
      </ViewHead>
      {error !== "" ? (
        <p class="ui-callout bad" role="alert">
          {`${t("loom.failed")}: ${error}`}
        </p>
      ) : model === null || Shown === null ? (
        <Progress label={t("loom.loading")} />
      ) : (
        <Shown
          key={model.about.title}
          model={model}
          running={model.about.periods.knot && <RunPanel file={file} weaves={model.about.chart !== null} />}
          live={live}
          drawing={(plate) => <PlateSketch file={file} plate={plate} />}
        />
      )}
    </div>
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

/** The verdict once the parts are compared in space. */
function Found({ failures }: Pick<SceneAbout, "failures">) {
  return failures.length > 0 ? <Verdict checks={failures} /> : <VerdictBadge ok>{t("ui.allHold")}</VerdictBadge>;
}

function choicesOf(files: readonly string[]) {
  return files.map((path) => ({ value: path, label: path }));
}

async function saveGlb(file: string): Promise<void> {
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
}
