import { useEffect } from "preact/hooks";
import { useReady } from "../../app/ready";
import { rename, type ViewProps } from "../../app/routes";
import { openDocuments, project } from "../../project";
import { t } from "../../text";
import { FileList } from "./file-list";
import { FileSide } from "./file-side";
import { out, refreshOut } from "./work";
import { Written } from "./written";
import "./files.css";

/** The files of the project, and everything that the command line writes of them. */
export default function Files({ name }: ViewProps) {
  const found = project.value;
  useReady(found !== null && out.value !== null);
  useEffect(() => {
    void refreshOut().catch(() => undefined);
  }, [openDocuments.value.length]);
  if (found === null) return <p class="app-loading">{t("app.loading")}</p>;
  const known = found.files.some((file) => file.path === name);
  const chosen = known ? name : (found.files[0]?.path ?? "");
  return (
    <div class="files">
      <header class="files-title">
        <h1>{t("files.title")}</h1>
        <p class="ui-muted">{found.folder}</p>
      </header>
      <FileList chosen={chosen} onChoose={rename} />
      <div class="ui-stack files-side">
        {chosen !== "" && <FileSide key={chosen} path={chosen} />}
        <Written />
      </div>
    </div>
  );
}
