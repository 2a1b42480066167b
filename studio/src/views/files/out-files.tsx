import type { OutEntry, OutFile } from "../../api/messages";
import { fileAddress } from "../../project";
import { t } from "../../text";
import { Icon } from "../../ui";

/** Largest picture that is shown small [bytes]. */
const LARGEST_PREVIEW = 3_000_000;

const SHOWN = /\.(html|png|jpe?g|gif|webp|pdf|txt|csv|json|toml|mp4|svg)$/i;

/** What is shown first of a folder. */
const FIRST = ["report.html", "index.html", "chart.html", "chart.pdf", "chart.png"];

/** Whether an entry is a file, no folder. */
export function isSingle(entry: OutEntry): boolean {
  return entry.files.length === 1 && entry.files[0]?.path === entry.path;
}

/** A picture of an entry, small; nothing where it has none, or a moving one where motion is not wanted. */
export function Preview({ entry }: { entry: OutEntry }) {
  const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
  const kinds = [/carpet\.png$/, /chart\.png$/, /\.(png|jpe?g|webp|svg)$/i, ...(calm ? [] : [/\.gif$/i])];
  const small = entry.files.filter((file) => file.size <= LARGEST_PREVIEW);
  const found = kinds.map((kind) => small.find((file) => kind.test(file.path))).find((file) => file !== undefined);
  if (found === undefined) return null;
  return (
    <a class="files-preview" href={fileAddress(found.path)} target="_blank" rel="noreferrer">
      <img src={`${fileAddress(found.path)}?time=${found.time}`} alt={t("files.preview", { path: found.path })} />
    </a>
  );
}

/** Links that open an entry and get it: a file as it is, a folder as ZIP. */
export function Downloads({ entry }: { entry: OutEntry }) {
  const main = isSingle(entry) ? entry.files[0] : FIRST.map((name) => fileOf(entry, name)).find(Boolean);
  const address = isSingle(entry) ? `${fileAddress(entry.path)}?download=1` : zipAddress(entry.path);
  const words = isSingle(entry) ? t("files.get") : t("files.getZip");
  return (
    <>
      {main && SHOWN.test(main.path) && (
        <a
          class="ui-button small"
          href={fileAddress(main.path)}
          target="_blank"
          rel="noreferrer"
          aria-label={t("files.showFile", { path: main.path })}
        >
          <Icon name="open" />
          {t("files.show")}
        </a>
      )}
      <a
        class="ui-button small"
        href={address}
        download={isSingle(entry) ? "" : `${entry.path.slice("out/".length)}.zip`}
        aria-label={t("files.downloadNamed", { words, path: entry.path })}
      >
        <Icon name="download" />
        {words}
      </a>
    </>
  );
}

function fileOf(entry: OutEntry, name: string): OutFile | undefined {
  return entry.files.find((file) => file.path === `${entry.path}/${name}`);
}

function zipAddress(path: string): string {
  return `/api/project/archive/${path.split("/").map(encodeURIComponent).join("/")}`;
}

/** The name of a file in out/, as a link where the browser shows such a file. */
export function FileLink({ file, label }: { file: OutFile; label: string }) {
  if (!SHOWN.test(file.path)) return <>{label}</>;
  return (
    <a href={fileAddress(file.path)} target="_blank" rel="noreferrer">
      {label}
    </a>
  );
}
