import { t } from "../text";
import { Button, Icon, IconButton } from "../ui";
import { decide } from "./conflicts";
import type { AnyDocument, SaveState as State } from "./document";

const ICONS = {
  loading: "connecting",
  saved: "good",
  changed: "connecting",
  saving: "connecting",
  lost: "lost",
  refused: "error",
  conflict: "warning",
  missing: "error",
} as const satisfies Record<State, string>;

interface SaveStateProps {
  document: AnyDocument;
  /** Address where the text of the file is edited, for its error; left out where it is shown anyway. */
  textAddress?: string;
}

/** Whether a document is saved, with undo and redo, and its first error. */
export function SaveState({ document, textAddress }: SaveStateProps) {
  const state = document.saved.value;
  const error = document.error.value;
  return (
    <>
      <div class="ui-row">
        <IconButton
          icon="undo"
          label={t("project.undo")}
          disabled={!document.canUndo.value}
          onClick={() => void document.undo()}
        />
        <IconButton
          icon="redo"
          label={t("project.redo")}
          disabled={!document.canRedo.value}
          onClick={() => void document.redo()}
        />
        <span class={`project-saved ${state}`} role="status">
          <Icon name={ICONS[state]} />
          {t(`project.${state}`)}
        </span>
        {state === "conflict" && (
          <Button size="small" onClick={() => decide(document.path)}>
            {t("project.decide")}
          </Button>
        )}
        {state === "refused" && (
          <Button size="small" onClick={() => void document.flush()}>
            {t("app.tryAgain")}
          </Button>
        )}
      </div>
      {document.problem.value !== "" && (
        <p class="ui-callout bad" role="alert">
          {document.problem.value}
        </p>
      )}
      {error !== null && (
        <p class="ui-callout bad">
          {[error.given, error.allowed, error.do].filter(Boolean).join("; ")}
          {textAddress !== undefined && state !== "missing" && (
            <>
              {" "}
              <a href={textAddress}>{t("project.editText")}</a>
            </>
          )}
        </p>
      )}
    </>
  );
}
