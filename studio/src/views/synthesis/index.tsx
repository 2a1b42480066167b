import { useState } from "preact/hooks";
import { useReady } from "../../app/ready";
import { goTo, type ViewProps } from "../../app/routes";
import { filesOf, freePath, newFile, project, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, Dialog, Segments, Select, toast } from "../../ui";
import { LISTS, MACHINES, type Machine } from "./task";
import { TaskView } from "./task-view";
import "./synthesis.css";

const FOLDER = "synthesis";

/** The name of a file in the address: without folder and suffix. */
export function stemOf(path: string): string {
  return path.replace(/^[^/]+\//, "").replace(/\.toml$/, "");
}

/** Four-bars from clicked points, poses or a function. */
export default function Synthesis({ name }: ViewProps) {
  const [creating, setCreating] = useState(false);
  useReady(project.value !== null && filesOf(FOLDER).length === 0);
  const files = filesOf(FOLDER);
  const stem = name || stemOf(files[0]?.path ?? "");
  const head = (
    <>
      {files.length > 0 && (
        <Select
          label={t("synthesis.file")}
          value={stem}
          choices={files.map((one) => ({ value: stemOf(one.path), label: stemOf(one.path) }))}
          onChange={(to) => goTo("synthesis", to)}
        />
      )}
      <Button icon="add" onClick={() => setCreating(true)}>
        {t("synthesis.new")}
      </Button>
    </>
  );
  return (
    <div class="synthesis">
      {stem === "" ? (
        <>
          <ViewHead title={t("synthesis.title")}>{head}</ViewHead>
          <p>{project.value === null ? t("app.loading") : t("synthesis.noFile")}</p>
        </>
      ) : (
        <TaskView key={stem} path={`${FOLDER}/${stem}.toml`} stem={stem} head={head} />
      )}
      <NewTask open={creating} onClose={() => setCreating(false)} />
    </div>
  );
}

const STEMS: Record<Machine, string> = {
  "path-four-bar": "path",
  "motion-four-bar": "motion",
  "function-four-bar": "function",
};

/** A task to begin with: no points yet; a function by its name. */
function textOf(machine: Machine): string {
  const list = machine === "function-four-bar" ? 'function = "x^2"' : `${LISTS[machine].setting} = ""`;
  return `machine = "${machine}"\n\n[settings]\n${list}\n`;
}

function NewTask({ open, onClose }: { open: boolean; onClose: () => void }) {
  const [machine, setMachine] = useState<Machine>("path-four-bar");
  const create = async () => {
    const path = freePath(FOLDER, STEMS[machine]);
    try {
      await newFile(path, { text: textOf(machine) });
      onClose();
      goTo("synthesis", stemOf(path));
    } catch (error) {
      toast(error instanceof Error ? error.message : String(error), "bad");
    }
  };
  return (
    <Dialog
      title={t("synthesis.new")}
      open={open}
      onClose={onClose}
      actions={
        <Button kind="primary" onClick={create}>
          {t("synthesis.create")}
        </Button>
      }
    >
      <Segments
        label={t("synthesis.taskKind")}
        value={machine}
        choices={MACHINES.map((value) => ({ value, label: kindText(value) }))}
        onChange={setMachine}
      />
    </Dialog>
  );
}

/** What a machine's task is made of. */
export function kindText(machine: Machine): string {
  if (machine === "path-four-bar") return t("synthesis.path");
  return machine === "motion-four-bar" ? t("synthesis.motion") : t("synthesis.function");
}
