import { useEffect, useRef, useState } from "preact/hooks";
import type { AnyDocument } from "../../project";
import { t } from "../../text";
import { Button } from "../../ui";

/** The text of a file with the numbers of its lines, for what no view edits and to mend errors. */
export function TextEditor({ document }: { document: AnyDocument }) {
  const [own, setOwn] = useState<string | null>(null);
  const [open, setOpen] = useState(false);
  const area = useRef<HTMLTextAreaElement>(null);
  const text = own ?? document.text.value;
  const state = document.saved.value;
  const error = document.error.value;
  const line = error?.line ?? null;
  useEffect(() => {
    if (state === "saved") setOwn(null);
  }, [state, document.text.value]);
  useEffect(() => {
    if (error !== null) setOpen(true);
  }, [error]);
  return (
    <details class="files-editor" open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
      <summary>{t("files.text")}</summary>
      {line !== null && (
        <Button size="small" icon="error" onClick={() => area.current && selectLine(area.current, line)}>
          {t("files.goToLine", { line })}
        </Button>
      )}
      <div class="files-text">
        <div class="files-numbers" aria-hidden="true">
          {text.split("\n").map((_, index) => (
            <span key={index} class={index + 1 === line ? "bad" : ""}>
              {index + 1}
            </span>
          ))}
        </div>
        <textarea
          ref={area}
          aria-label={t("files.textOf", { path: document.path })}
          aria-invalid={error !== null}
          spellcheck={false}
          wrap="off"
          rows={text.split("\n").length}
          value={text}
          disabled={state === "loading" || state === "missing"}
          onInput={(event) => {
            setOwn(event.currentTarget.value);
            document.setText(event.currentTarget.value);
          }}
        />
      </div>
    </details>
  );
}

/** Marks a line of a text field and brings it into view. */
function selectLine(area: HTMLTextAreaElement, line: number): void {
  const lines = area.value.split("\n");
  const begin = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  area.focus();
  area.setSelectionRange(begin, begin + (lines[line - 1]?.length ?? 0));
  area.parentElement?.scrollTo({ top: Math.max(0, (line - 4) * (area.scrollHeight / lines.length)) });
}
