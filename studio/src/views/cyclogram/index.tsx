import { useEffect, useState } from "preact/hooks";
import type { MachineCyclograms } from "../../api/messages";
import { post } from "../../api/request";
import { useReady } from "../../app/ready";
import { goTo, type ViewProps } from "../../app/routes";
import { filesOf, freePath, newFile, project, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, Dialog, Progress, Select, toast } from "../../ui";
import { CyclogramEditor } from "./editor";
import { NEW_CYCLOGRAM } from "./structure";
import "./cyclogram.css";

/** Creates a cyclogram to begin with, and opens it. */
async function create(): Promise<void> {
  const path = freePath(FOLDER, "cyclogram");
  try {
    await newFile(path, { text: NEW_CYCLOGRAM });
    goTo("cyclogram", stemOf(path));
  } catch (error) {
    toast(t("cyclogram.notCreated"), "bad", error instanceof Error ? error.message : String(error));
  }
}

const FOLDER = "cyclograms";

function stemOf(path: string): string {
  return path.replace(/^[^/]+\//, "").replace(/\.toml$/, "");
}

/** Motions over the master angle: files of the project, or the cyclograms of a machine. */
export default function Cyclogram({ name }: ViewProps) {
  const [opening, setOpening] = useState(false);
  useReady(project.value !== null && filesOf("cyclogram").length === 0);
  const files = filesOf("cyclogram");
  const first = files.find((one) => stemOf(one.path) === "press") ?? files[0];
  const stem = name || stemOf(first?.path ?? "");
  const head = (
    <>
      {files.length > 0 && (
        <Select
          label={t("cyclogram.file")}
          value={stem}
          choices={files.map((one) => ({ value: stemOf(one.path), label: stemOf(one.path) }))}
          onChange={(to) => goTo("cyclogram", to)}
        />
      )}
      <Button icon="add" onClick={create}>
        {t("cyclogram.new")}
      </Button>
      <Button icon="machine" onClick={() => setOpening(true)}>
        {t("cyclogram.ofMachine")}
      </Button>
    </>
  );
  return (
    <div class="cyclogram">
      {stem === "" || stem.includes(":") ? (
        <>
          <ViewHead title={t("cyclogram.title")}>{head}</ViewHead>
          {stem === "" && <p>{project.value === null ? t("app.loading") : t("cyclogram.noFile")}</p>}
          {stem !== "" && <Import key={stem} source={stem} />}
        </>
      ) : (
        <CyclogramEditor key={stem} path={`${FOLDER}/${stem}.toml`} head={head} />
      )}
      <Dialog title={t("cyclogram.ofMachine")} open={opening} onClose={() => setOpening(false)}>
        <p>{t("cyclogram.ofMachineHelp")}</p>
        <div class="ui-row">
          {SOURCES.map((source) => (
            <Button
              key={source}
              onClick={() => {
                setOpening(false);
                goTo("cyclogram", source);
              }}
            >
              {source}
            </Button>
          ))}
        </div>
      </Dialog>
    </div>
  );
}

/** Cyclograms of the catalogue's machines, as the command line names them. */
const SOURCES = ["automated-loom:row", "automated-loom:knot", "weaver:knot"];

/** Designs a machine and writes its cyclogram into the project. */
function Import({ source }: { source: string }) {
  const [failed, setFailed] = useState("");
  useEffect(() => {
    const abort = new AbortController();
    const [machine = "", which = ""] = source.split(":");
    post<MachineCyclograms>("/cyclogram/machine", { machine }, abort.signal)
      .then(async (found) => {
        const one = found.cyclograms.find((made) => made.name === which) ?? found.cyclograms[0];
        if (one === undefined) throw new Error(source);
        const path = freePath(FOLDER, `${machine}-${one.name}`);
        await newFile(path, { text: one.text });
        toast(t("cyclogram.written", { path }), "good");
        goTo("cyclogram", stemOf(path));
      })
      .catch((error: unknown) => {
        if (!abort.signal.aborted) setFailed(error instanceof Error ? error.message : String(error));
      });
    return () => abort.abort();
  }, []);
  if (failed !== "")
    return (
      <div class="ui-callout bad" role="alert">
        <strong>{t("cyclogram.notOpened", { source })}</strong>
        <p>{failed}</p>
      </div>
    );
  return <Progress label={t("cyclogram.designing", { source })} onCancel={() => goTo("cyclogram")} />;
}
