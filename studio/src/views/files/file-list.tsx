import { useState } from "preact/hooks";
import { post } from "../../api/request";
import {
  deleteFile,
  type FileSummary,
  fileAddress,
  filesOf,
  freePath,
  newFile,
  type PictureSummary,
  project,
  refreshProject,
  renameFile,
  undoDelete,
  uploadPicture,
} from "../../project";
import { t } from "../../text";
import { Button, Dialog, Icon, IconButton, TextField } from "../../ui";
import { FOLDERS, KINDS, type Kind, renamed, STARTS, stemOf, viewAddress } from "./names";
import { sizeText } from "./size";

interface ListProps {
  chosen: string;
  onChoose: (path: string) => void;
}

/** The project's files by kind; what was deleted can be brought back. */
export function FileList({ chosen, onChoose }: ListProps) {
  const [problem, setProblem] = useState("");
  const [deleted, setDeleted] = useState("");
  const attempt = async (work: () => Promise<void>) => {
    setProblem("");
    try {
      await work();
    } catch (error) {
      setProblem(error instanceof Error ? error.message : String(error));
    }
  };
  return (
    <section class="files-list" aria-label={t("files.project")}>
      {problem !== "" && (
        <p class="ui-callout bad" role="alert">
          {problem}
        </p>
      )}
      {deleted !== "" && (
        <div class="ui-callout ui-row" role="status">
          <span class="ui-grow">{t("files.wasDeleted", { path: deleted })}</span>
          <Button
            size="small"
            icon="undo"
            onClick={() =>
              void attempt(async () => {
                await undoDelete(deleted);
                setDeleted("");
              })
            }
          >
            {t("files.bringBack")}
          </Button>
        </div>
      )}
      {KINDS.map((kind) => (
        <KindOfFiles
          key={kind}
          kind={kind}
          chosen={chosen}
          onChoose={onChoose}
          onNew={() =>
            void attempt(async () => {
              const path = freePath(FOLDERS[kind], kind === "carpet" ? "carpet" : "new");
              await newFile(path, { text: STARTS[kind] });
              onChoose(path);
            })
          }
          onCopy={(path) =>
            void attempt(async () => {
              const copy = freePath(FOLDERS[kind], `${stemOf(path)}-copy`);
              await newFile(copy, { source: path });
              onChoose(copy);
            })
          }
          onRename={(path, stem) =>
            attempt(async () => {
              await renameFile(path, renamed(path, stem));
              onChoose(renamed(path, stem));
            })
          }
          onDelete={(path) =>
            void attempt(async () => {
              await deleteFile(path);
              setDeleted(path);
              if (path === chosen) onChoose("");
            })
          }
        />
      ))}
      <Pictures attempt={attempt} />
    </section>
  );
}

interface KindProps extends ListProps {
  kind: Kind;
  onNew: () => void;
  onCopy: (path: string) => void;
  onRename: (path: string, stem: string) => Promise<void>;
  onDelete: (path: string) => void;
}

function KindOfFiles({ kind, chosen, onChoose, onNew, onCopy, onRename, onDelete }: KindProps) {
  const files = filesOf(kind);
  const [renaming, setRenaming] = useState("");
  return (
    <div class="files-kind">
      <div class="ui-row">
        <h2 class="ui-grow">{t(`files.${kind}`)}</h2>
        <IconButton icon="add" size="small" label={t("files.new", { kind: t(`files.${kind}`) })} onClick={onNew} />
      </div>
      {files.length === 0 && <p class="ui-muted">{t("files.noFiles")}</p>}
      <ul>
        {files.map((file) => (
          <li key={file.path} class={file.path === chosen ? "chosen" : ""}>
            <FileButton file={file} chosen={file.path === chosen} onChoose={onChoose} />
            {file.path === chosen && (
              <div class="files-actions">
                <OpenLink kind={kind} path={file.path} />
                <Button size="small" icon="copy" onClick={() => onCopy(file.path)}>
                  {t("files.duplicate")}
                </Button>
                <Button size="small" icon="pencil" onClick={() => setRenaming(file.path)}>
                  {t("files.rename")}
                </Button>
                <Button size="small" icon="remove" onClick={() => onDelete(file.path)}>
                  {t("files.delete")}
                </Button>
              </div>
            )}
          </li>
        ))}
      </ul>
      {renaming !== "" && (
        <Rename path={renaming} onClose={() => setRenaming("")} onRename={(stem) => onRename(renaming, stem)} />
      )}
    </div>
  );
}

function FileButton({
  file,
  chosen,
  onChoose,
}: {
  file: FileSummary;
  chosen: boolean;
  onChoose: (path: string) => void;
}) {
  const line = file.error?.line;
  return (
    <button
      type="button"
      class="files-file"
      aria-current={chosen ? "true" : undefined}
      onClick={() => onChoose(file.path)}
    >
      <Icon name={file.error ? "error" : "good"} label={file.error ? t("files.hasError") : t("files.isGood")} />
      <span class="ui-grow">{file.path}</span>
      {typeof line === "number" && <span class="files-line">{t("files.inLine", { line })}</span>}
    </button>
  );
}

function OpenLink({ kind, path }: { kind: Kind; path: string }) {
  const to = viewAddress(kind, path);
  if (to === null) return null;
  return (
    <a class="ui-button primary small" href={to}>
      <Icon name="open" />
      {t("files.open")}
    </a>
  );
}

function Rename(props: { path: string; onClose: () => void; onRename: (stem: string) => Promise<void> }) {
  const [stem, setStem] = useState(stemOf(props.path));
  const rename = async () => {
    props.onClose();
    if (stem.trim() !== "" && stem !== stemOf(props.path)) await props.onRename(stem);
  };
  return (
    <Dialog
      open
      title={t("files.renameTitle", { path: props.path })}
      onClose={props.onClose}
      actions={
        <>
          <Button onClick={props.onClose}>{t("ui.cancel")}</Button>
          <Button kind="primary" onClick={() => void rename()}>
            {t("files.rename")}
          </Button>
        </>
      }
    >
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void rename();
        }}
      >
        <TextField label={t("files.newName")} value={stem} onChange={setStem} />
      </form>
    </Dialog>
  );
}

function Pictures({ attempt }: { attempt: (work: () => Promise<void>) => Promise<void> }) {
  const pictures = project.value?.pictures ?? [];
  const add = (files: FileList | null) =>
    void attempt(async () => {
      for (const file of Array.from(files ?? [])) await uploadPicture(file);
    });
  const remove = (picture: PictureSummary) =>
    void attempt(async () => {
      await post("/project/pictures/delete", { path: picture.path });
      await refreshProject();
    });
  return (
    <div
      class="files-kind"
      role="group"
      aria-label={t("files.pictures")}
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        add((event.dataTransfer?.files ?? null) as never);
      }}
    >
      <div class="ui-row">
        <h2 class="ui-grow">{t("files.pictures")}</h2>
        <label class="ui-button small files-upload">
          <Icon name="upload" />
          {t("files.upload")}
          <input
            type="file"
            accept="image/*,.oxs"
            multiple
            onChange={(event) => {
              add(event.currentTarget.files as never);
              event.currentTarget.value = "";
            }}
          />
        </label>
      </div>
      <ul class="files-pictures">
        {pictures.map((picture) => (
          <li key={picture.path}>
            <a href={fileAddress(picture.path)} target="_blank" rel="noreferrer">
              <img src={fileAddress(picture.path)} alt="" width={56} height={56} loading="lazy" />
              <span>{picture.path.replace("pictures/", "")}</span>
            </a>
            <span class="ui-muted">{sizeText(picture.size)}</span>
            <IconButton
              icon="remove"
              size="small"
              label={t("files.deletePicture", { path: picture.path })}
              onClick={() => remove(picture)}
            />
          </li>
        ))}
      </ul>
    </div>
  );
}
