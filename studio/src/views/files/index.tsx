import { useEffect } from "preact/hooks";
import { useReady } from "../../app/ready";
import { goTo, type ViewProps } from "../../app/routes";
import { project, projectProblem, refreshProject, ViewHead } from "../../project";
import { t } from "../../text";
import { Button } from "../../ui";
import { FileList } from "./file-list";
import { CHOSEN, FileSide } from "./file-side";
import { followOut, out } from "./work";
import { Written } from "./written";
import "./files.css";

/** Pages of this width and less show the list or one file, not both. */
const NARROW = "(max-width: 899px)";

function choose(path: string): void {
  goTo("files", path);
  if (path !== "" && matchMedia(NARROW).matches) requestAnimationFrame(() => document.getElementById(CHOSEN)?.focus());
}

/** The files of the project, and everything that the command line writes of them. */
export default function Files({ name }: ViewProps) {
  const found = project.value;
  useReady(found !== null && out.value !== null);
  useEffect(followOut, []);
  if (found === null) return <NoProject />;
  const named = found.files.find((file) => file.path === name);
  const chosen = named ?? found.files[0];
  return (
    <div class={`files${named ? " detail" : ""}`}>
      <ViewHead title={t("files.title")}>
        <p>{found.folder}</p>
      </ViewHead>
      <div class="files-problems">
        <NoProject />
        {(found.problems ?? []).map((problem) => (
          <p key={problem} class="ui-callout bad" role="alert">
            {problem}
          </p>
        ))}
      </div>
      <FileList chosen={chosen?.path ?? ""} onChoose={choose} />
      <div class="files-side">
        {chosen && <FileSide key={chosen.path} file={chosen} onChoose={choose} />}
        <Written folder={found.folder} />
      </div>
    </div>
  );
}

/** Why the project's files cannot be read; before the first answer that they are being read. */
function NoProject() {
  if (projectProblem.value === "") return project.value === null ? <p class="app-loading">{t("app.loading")}</p> : null;
  return (
    <div class="ui-callout bad ui-row" role="alert">
      <p class="ui-grow">{projectProblem.value}</p>
      <Button onClick={() => void refreshProject().catch(() => undefined)}>{t("app.tryAgain")}</Button>
    </div>
  );
}
