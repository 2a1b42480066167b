import { useEffect, useRef, useState } from "preact/hooks";
import { address } from "../../app/routes";
import { type FileSummary, fileAddress, SaveState, useDocument } from "../../project";
import { t } from "../../text";
import { Button, Dialog, Icon, TextField } from "../../ui";
import { duplicate, giveName, remove } from "./changes";
import { sizeText, timeText } from "./format";
import { type Kind, stemOf, viewAddress } from "./names";
import { Products } from "./products";
import { TextEditor } from "./text-editor";

interface SideProps {
  file: FileSummary;
  onChoose: (path: string) => void;
}

/** Mark of the heading that gets the focus when a file is chosen on a narrow page. */
export const CHOSEN = "files-chosen";

/** A file of the project: what it is, its actions, what can be written of it, its text. */
export function FileSide({ file, onChoose }: SideProps) {
  const { path } = file;
  const document = useDocument(path);
  return (
    <section class="ui-stack files-chosen" aria-labelledby={CHOSEN}>
      <div class="files-head">
        <a class="files-back" href={address("files")}>
          <Icon name="left" />
          {t("files.all")}
        </a>
        <h2 id={CHOSEN} tabIndex={-1}>
          {stemOf(path)}
        </h2>
        <span class="ui-muted">
          <code>{path}</code> · {sizeText(file.size)} · {t("files.changedAt", { time: timeText(file.time ?? 0) })}
        </span>
      </div>
      <SaveState document={document} />
      <Actions file={file} onChoose={onChoose} />
      <TextEditor document={document} />
      <Products path={path} digest={file.digest} />
    </section>
  );
}

function Actions({ file: { path, kind }, onChoose }: SideProps) {
  const [renaming, setRenaming] = useState(false);
  const view = viewAddress(kind, path);
  const copy = async () => {
    const made = await duplicate(kind as Kind, path);
    if (made !== "") onChoose(made);
  };
  const drop = async () => {
    if (await remove(path)) onChoose("");
  };
  return (
    <div class="ui-row">
      {view !== null && (
        <a class="ui-button primary small" href={view}>
          <Icon name="open" />
          {t("files.open")}
        </a>
      )}
      <Button size="small" icon="copy" onClick={copy}>
        {t("files.duplicate")}
      </Button>
      <Button size="small" icon="pencil" onClick={() => setRenaming(true)}>
        {t("files.rename")}
      </Button>
      <a class="ui-button small" href={`${fileAddress(path)}?download=1`} download>
        <Icon name="download" />
        {t("files.downloadText")}
      </a>
      <Button size="small" icon="remove" onClick={drop}>
        {t("files.delete")}
      </Button>
      {renaming && (
        <Rename
          path={path}
          onClose={() => setRenaming(false)}
          onRename={async (stem) => {
            setRenaming(false);
            onChoose(await giveName(path, stem));
          }}
        />
      )}
    </div>
  );
}

function Rename(props: { path: string; onClose: () => void; onRename: (stem: string) => Promise<void> }) {
  const [stem, setStem] = useState(stemOf(props.path));
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector("input")?.select(), []);
  return (
    <Dialog
      open
      title={t("files.renameTitle", { path: props.path })}
      onClose={props.onClose}
      actions={
        <>
          <Button onClick={props.onClose}>{t("ui.cancel")}</Button>
          <Button kind="primary" onClick={() => void props.onRename(stem)}>
            {t("files.rename")}
          </Button>
        </>
      }
    >
      <form
        ref={form}
        onSubmit={(event) => {
          event.preventDefault();
          void props.onRename(stem);
        }}
      >
        <TextField label={t("files.newName")} value={stem} onChange={setStem} />
      </form>
    </Dialog>
  );
}
