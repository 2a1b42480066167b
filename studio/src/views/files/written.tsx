import { useState } from "preact/hooks";
import type { OutEntry } from "../../api/messages";
import { fileAddress } from "../../project";
import { t } from "../../text";
import { Icon, IconButton } from "../../ui";
import { sizeText, timeText } from "./format";
import { Downloads, FileLink, isSingle, Preview } from "./out-files";
import { Stale } from "./products";
import { out, outProblem, removeWritten } from "./work";

/** All that was written into out/, with links; pages open in a sandbox of their own. */
export function Written({ folder }: { folder: string }) {
  const [failure, setFailure] = useState("");
  const entries = out.value?.entries ?? [];
  const problem = outProblem.value || failure;
  return (
    <section class="ui-stack files-all" aria-labelledby="files-written">
      <div>
        <h2 id="files-written">{t("files.inOut")}</h2>
        <p class="ui-muted">
          <code>{folder}/out</code>
        </p>
      </div>
      {problem !== "" && (
        <p class="ui-callout bad" role="alert">
          {problem}
        </p>
      )}
      {entries.length === 0 && problem === "" && <p class="ui-muted">{t("files.nothingWritten")}</p>}
      <ul class="files-written">
        {entries.map((entry) => (
          <Entry key={entry.path} entry={entry} onDelete={async () => setFailure(await removeWritten(entry.path))} />
        ))}
      </ul>
    </section>
  );
}

function Entry({ entry, onDelete }: { entry: OutEntry; onDelete: () => Promise<void> }) {
  const single = isSingle(entry);
  return (
    <li>
      <div class="files-product-head">
        <Preview entry={entry} />
        <div class="ui-grow">
          <strong class="files-name">{entry.path.slice("out/".length)}</strong>
          {!single && <span class="ui-muted"> {t("files.count", { count: entry.files.length })}</span>}
          <p class="files-age">
            {sizeText(entry.size)} · {timeText(entry.time)} <Stale entry={entry} />
          </p>
        </div>
        <div class="ui-row files-buttons">
          <Downloads entry={entry} />
          <IconButton
            icon="remove"
            size="small"
            label={t("files.deleteWritten", { path: entry.path })}
            onClick={() => void onDelete()}
          />
        </div>
      </div>
      {!single && <FolderFiles entry={entry} />}
    </li>
  );
}

function FolderFiles({ entry }: { entry: OutEntry }) {
  return (
    <details class="files-command">
      <summary>{t("files.filesOf", { path: entry.path })}</summary>
      <ul>
        {entry.files.map((file) => (
          <li key={file.path} class="ui-row">
            <span class="ui-grow files-name">
              <FileLink file={file} label={file.path.slice(entry.path.length + 1)} />
            </span>
            <span class="ui-muted">{sizeText(file.size)}</span>
            <a
              class="ui-button quiet small icon"
              href={`${fileAddress(file.path)}?download=1`}
              download
              aria-label={t("files.downloadNamed", { words: t("files.get"), path: file.path })}
            >
              <Icon name="download" />
            </a>
          </li>
        ))}
      </ul>
    </details>
  );
}
