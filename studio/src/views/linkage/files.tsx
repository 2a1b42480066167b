/** Mechanism files: the one that is shown, a new one, one from the user's disc, a copy under another name. */
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import type { ForeignAnswer } from "../../api/messages";
import { upload } from "../../api/request";
import { rename } from "../../app/routes";
import { freePath, newFile } from "../../project";
import { t } from "../../text";
import { Button, Dialog, Select, TextField, toast } from "../../ui";
import { emptyMechanism } from "./mechanism";

const FOLDER = "linkages";

export function pathOf(name: string): string {
  return `${FOLDER}/${name}.toml`;
}

export function nameOf(path: string): string {
  return path.replace(/^linkages\//, "").replace(/\.toml$/, "");
}

/** Creates a mechanism file under a free name and shows it; reports why it could not. */
async function create(stem: string, content: (name: string) => Parameters<typeof newFile>[1]): Promise<void> {
  const path = freePath(FOLDER, stem);
  const name = nameOf(path);
  try {
    await newFile(path, content(name));
    rename(name);
  } catch (error) {
    toast(t("linkage.notCreated"), "bad", error instanceof Error ? error.message : String(error));
  }
}

export function createEmpty(): Promise<void> {
  return create("linkage", (name) => ({ text: emptyMechanism(name) }));
}

/** Largest mechanism file [bytes]. */
const LARGEST = 1_000_000;

/** Takes a mechanism file of the user's disc into the project, or a file of another program. */
export async function openFile(file: File): Promise<void> {
  const stem = file.name.replace(/\.[^.]*$/, "").replace(/[^\w-]+/g, "-") || "linkage";
  if (file.size > LARGEST) {
    toast(t("linkage.notMechanismFile", { name: file.name }), "bad");
    return;
  }
  if (/\.toml$/i.test(file.name)) {
    const text = await file.text();
    return create(stem, () => ({ text }));
  }
  if (/\.json$/i.test(file.name)) {
    try {
      const data = JSON.parse(await file.text()) as { joints?: unknown };
      if (!Array.isArray(data.joints)) return await create(stem, () => ({ data }));
    } catch (error) {
      toast(t("linkage.notJson", { name: file.name }), "bad", String(error));
      return;
    }
  }
  await importFile(file, stem);
}

async function importFile(file: File, stem: string): Promise<void> {
  try {
    const path = `/mechanism/foreign?name=${encodeURIComponent(file.name)}`;
    const { text, left_out } = await upload<ForeignAnswer>(path, file);
    await create(stem, () => ({ text }));
    if (left_out.length > 0) toast(t("linkage.leftOut", { name: file.name }), "info", left_out.join("; "));
  } catch (error) {
    toast(t("linkage.notCreated"), "bad", error instanceof Error ? error.message : String(error));
  }
}

export function FileBar({ name, names }: { name: string; names: readonly string[] }) {
  const input = useRef<HTMLInputElement>(null);
  const copy = useSignal<string | null>(null);
  const choices = [...new Set([name, ...names])].sort().map((one) => ({ value: one, label: one }));
  const save = () => {
    const stem = (copy.peek() ?? "").trim().replace(/\.toml$/, "");
    copy.value = null;
    if (stem !== "") void create(stem, () => ({ source: pathOf(name) }));
  };
  return (
    <>
      <Select label={t("linkage.file")} value={name} choices={choices} onChange={(one) => rename(one)} />
      <Button icon="add" onClick={() => void createEmpty()}>
        {t("linkage.new")}
      </Button>
      <Button icon="open" onClick={() => input.current?.click()}>
        {t("linkage.openFile")}
      </Button>
      <input
        ref={input}
        type="file"
        accept=".toml,.json,.linkage2,.slvs,.dxf,.urdf,.xml,.txt,.pyslvs"
        hidden
        aria-label={t("linkage.openFile")}
        onChange={(event) => {
          const [file] = event.currentTarget.files ?? [];
          if (file) void openFile(file);
          event.currentTarget.value = "";
        }}
      />
      <Button
        icon="copy"
        onClick={() => {
          copy.value = `${name}-2`;
        }}
      >
        {t("linkage.saveAs")}
      </Button>
      <Dialog
        title={t("linkage.saveAsTitle")}
        open={copy.value !== null}
        onClose={() => {
          copy.value = null;
        }}
        actions={
          <Button kind="primary" onClick={save}>
            {t("linkage.saveCopy")}
          </Button>
        }
      >
        <form
          onSubmit={(event) => {
            event.preventDefault();
            save();
          }}
        >
          <TextField
            label={t("linkage.newName")}
            value={copy.value ?? ""}
            help={t("linkage.newNameHelp", { folder: FOLDER })}
            onChange={(to) => {
              copy.value = to;
            }}
          />
        </form>
      </Dialog>
    </>
  );
}
