import { useEffect, useState } from "preact/hooks";
import type { OutEntry, OutFile } from "../../api/messages";
import { fileAddress } from "../../project";
import { language, t } from "../../text";
import { Icon, IconButton } from "../../ui";
import { sizeText } from "./size";
import { out, refreshOut, removeWritten } from "./work";

/** What was written into out/, with links; pages open in a sandbox of their own. */
export function Written() {
  const [problem, setProblem] = useState("");
  useEffect(() => {
    refreshOut().catch(() => setProblem(t("files.noList")));
  }, []);
  const entries = out.value?.entries ?? [];
  return (
    <section class="ui-stack" aria-label={t("files.inOut")}>
      <h2>{t("files.inOut")}</h2>
      {problem !== "" && (
        <p class="ui-callout bad" role="alert">
          {problem}
        </p>
      )}
      {entries.length === 0 && <p class="ui-muted">{t("files.nothingWritten")}</p>}
      <ul class="files-written">
        {entries.map((entry) => (
          <Entry key={entry.path} entry={entry} onDelete={async () => setProblem(await removeWritten(entry.path))} />
        ))}
      </ul>
    </section>
  );
}

function Entry({ entry, onDelete }: { entry: OutEntry; onDelete: () => Promise<void> }) {
  const single = entry.files.length === 1 && entry.files[0]?.path === entry.path;
  const when = new Intl.DateTimeFormat(language.value, { dateStyle: "short", timeStyle: "short" });
  return (
    <li>
      <div class="ui-row">
        <Icon name={single ? "copy" : "files"} />
        <span class="ui-grow files-name">
          {single && entry.files[0] !== undefined ? <Link file={entry.files[0]} label={entry.path} /> : entry.path}
        </span>
        <span class="ui-muted">{sizeText(entry.size)}</span>
        <span class="ui-muted">{when.format(new Date(1000 * entry.time))}</span>
        {single && <Download path={entry.path} />}
        <IconButton
          icon="remove"
          size="small"
          label={t("files.deleteWritten", { path: entry.path })}
          onClick={() => void onDelete()}
        />
      </div>
      {!single && (
        <ul>
          {entry.files.map((file) => (
            <li key={file.path} class="ui-row">
              <span class="ui-grow files-name">
                <Link file={file} label={file.path.slice(entry.path.length + 1)} />
              </span>
              <span class="ui-muted">{sizeText(file.size)}</span>
              <Download path={file.path} />
            </li>
          ))}
        </ul>
      )}
    </li>
  );
}

const SHOWN = /\.(html|png|jpe?g|gif|webp|pdf|txt|csv|json|toml|mp4|svg)$/i;

function Link({ file, label }: { file: OutFile; label: string }) {
  if (!SHOWN.test(file.path)) return <>{label}</>;
  return (
    <a href={fileAddress(file.path)} target="_blank" rel="noreferrer">
      {label}
    </a>
  );
}

function Download({ path }: { path: string }) {
  return (
    <a
      class="ui-button quiet small icon"
      href={`${fileAddress(path)}?download=1`}
      download
      aria-label={t("files.download", { path })}
      title={t("files.download", { path })}
    >
      <Icon name="download" />
    </a>
  );
}
