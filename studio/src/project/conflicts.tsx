import { signal } from "@preact/signals";
import { t } from "../text";
import { Button, Dialog } from "../ui";
import { differences } from "./differences";
import type { Conflict, Document } from "./document";
import { openDocuments } from "./project";

/** Paths of conflicts that are decided later. */
const postponed = signal<ReadonlySet<string>>(new Set());

/** Shows the question of a conflict again that was closed. */
export function decide(path: string): void {
  postponed.value = new Set([...postponed.peek()].filter((one) => one !== path));
}

/** Asks which state to keep of a file that two programs or tabs changed; part of the frame. */
export function Conflicts() {
  const found = openDocuments.value.find(
    (document) => document.conflict.value !== null && !postponed.value.has(document.path),
  );
  const conflict = found?.conflict.value;
  if (found === undefined || conflict === undefined || conflict === null) return null;
  return <Question key={found.path} document={found} conflict={conflict} />;
}

function Question({ document, conflict }: { document: Document<object>; conflict: Conflict }) {
  const gone = conflict.theirs.digest === "";
  return (
    <Dialog
      open
      wide
      title={t("project.conflictTitle", { path: document.path })}
      onClose={() => {
        postponed.value = new Set([...postponed.peek(), document.path]);
      }}
      actions={
        <>
          <Button onClick={() => void document.resolve("theirs")}>{t("project.takeTheirs")}</Button>
          <Button kind="primary" onClick={() => void document.resolve("mine")}>
            {t("project.keepMine")}
          </Button>
        </>
      }
    >
      <p>{gone ? t("project.conflictGone") : t("project.conflictHelp")}</p>
      {document.problem.value !== "" && (
        <p class="ui-callout bad" role="alert">
          {document.problem.value}
        </p>
      )}
      {!gone && <Differences conflict={conflict} />}
    </Dialog>
  );
}

function Differences({ conflict: { mine, theirs } }: { conflict: Conflict }) {
  const byData = mine.data !== undefined && theirs.data !== null;
  const rows = byData
    ? differences(mine.data, theirs.data)
    : differences((mine.text ?? "").split("\n"), theirs.text.split("\n"));
  return (
    <div class="ui-table-scroll" tabIndex={0} role="region" aria-label={t("project.difference")}>
      <table class="ui-table">
        <thead>
          <tr>
            <th scope="col">{byData ? t("project.value") : t("project.line")}</th>
            <th scope="col">{t("project.mine")}</th>
            <th scope="col">{t("project.theirs")}</th>
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <tr key={row.path}>
              <th scope="row">{row.path}</th>
              <td>{row.mine}</td>
              <td>{row.theirs}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
