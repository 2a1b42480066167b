import { useState } from "preact/hooks";
import { type FileSummary, filesOf, openDocuments } from "../../project";
import { t } from "../../text";
import { Button, Icon, IconButton, SearchField } from "../../ui";
import { bringBack, create, deleted, problem } from "./changes";
import { FOLDERS, KINDS, type Kind, stemOf } from "./names";
import { Pictures } from "./pictures";

interface ListProps {
  chosen: string;
  onChoose: (path: string) => void;
}

/** The project's files by kind; what was deleted can be brought back. */
export function FileList({ chosen, onChoose }: ListProps) {
  const [words, setWords] = useState("");
  return (
    <section class="files-list" aria-label={t("files.project")}>
      <SearchField label={t("files.search")} value={words} onChange={setWords} />
      {problem.value !== "" && (
        <p class="ui-callout bad" role="alert">
          {problem.value}
        </p>
      )}
      {deleted.value.map((path) => (
        <div key={path} class="ui-callout ui-row" role="status">
          <span class="ui-grow">{t("files.wasDeleted", { path })}</span>
          <Button
            size="small"
            icon="undo"
            onClick={async () => {
              if (await bringBack(path)) onChoose(path);
            }}
          >
            {t("files.bringBack")}
          </Button>
        </div>
      ))}
      {KINDS.map((kind) => (
        <KindOfFiles key={kind} kind={kind} words={words} chosen={chosen} onChoose={onChoose} />
      ))}
      <Pictures />
    </section>
  );
}

function KindOfFiles({ kind, words, chosen, onChoose }: ListProps & { kind: Kind; words: string }) {
  const files = filesOf(kind).filter((file) => file.path.toLowerCase().includes(words.trim().toLowerCase()));
  if (words !== "" && files.length === 0) return null;
  const add = async () => {
    const path = await create(kind);
    if (path !== "") onChoose(path);
  };
  return (
    <div class="files-kind">
      <div class="ui-row">
        <h2 class="ui-grow">
          {t(`files.${kind}`)} <span class="files-folder">{FOLDERS[kind] !== "" && `${FOLDERS[kind]}/`}</span>
        </h2>
        <IconButton icon="add" size="small" label={t("files.new", { kind: t(`files.${kind}`) })} onClick={add} />
      </div>
      {files.length === 0 && <p class="ui-muted">{t("files.noFiles")}</p>}
      <ul>
        {files.map((file) => (
          <li key={file.path}>
            <FileButton file={file} chosen={file.path === chosen} onChoose={onChoose} />
          </li>
        ))}
      </ul>
    </div>
  );
}

function FileButton({
  file,
  chosen,
  onChoose,
}: { file: FileSummary } & Omit<ListProps, "chosen"> & { chosen: boolean }) {
  return (
    <button
      type="button"
      class="files-file"
      title={file.path}
      aria-current={chosen ? "true" : undefined}
      onClick={() => onChoose(file.path)}
    >
      <span class="ui-grow">{stemOf(file.path)}</span>
      <Unsaved path={file.path} />
      {file.error?.unfinished && <span class="ui-badge">{t("files.unfinished")}</span>}
      {file.error && !file.error.unfinished && (
        <span class="ui-badge bad">
          <Icon name="error" />
          {typeof file.error.line === "number"
            ? t("files.errorInLine", { line: file.error.line })
            : t("files.hasError")}
        </span>
      )}
    </button>
  );
}

/** A mark at a file whose edits are not in the file yet. */
function Unsaved({ path }: { path: string }) {
  const state = openDocuments.value.find((document) => document.path === path)?.saved.value;
  if (state !== "lost" && state !== "refused" && state !== "conflict") return null;
  return (
    <span class="ui-badge warn">
      <Icon name="warning" />
      {t(`project.${state}`)}
    </span>
  );
}
