import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { CommandRequest, ShownCommand } from "../api/messages";
import { post } from "../api/request";
import { address } from "../app/routes";
import { t } from "../text";
import { CopyCommand, Dialog, IconButton } from "../ui";
import type { AnyDocument } from "./document";
import { SaveState } from "./save-state";

interface ViewHeadProps {
  title: string;
  /** Its file with undo, redo and whether it is saved. */
  document?: AnyDocument;
  /** Whether what is shown does its work. */
  verdict?: ComponentChildren;
  command?: CommandRequest;
  /** The choice of the file, and what is done with files. */
  children?: ComponentChildren;
}

/** The head of every view: its name, its file, the verdict, undo, redo, saved, and the state as command and Python. */
export function ViewHead({ title, document, verdict, command, children }: ViewHeadProps) {
  return (
    <header class="ui-view-head">
      <h1>{title}</h1>
      {children}
      {verdict}
      <span class="ui-grow" />
      {document && document.saved.value !== "missing" && (
        <SaveState document={document} textAddress={address("files", document.path)} />
      )}
      {command && <CommandButton asked={command} />}
    </header>
  );
}

/** Shows the state as its command line and as Python. */
function CommandButton({ asked }: { asked: CommandRequest }) {
  const [open, setOpen] = useState(false);
  return (
    <>
      <IconButton icon="terminal" label={t("ui.commands")} onClick={() => setOpen(true)} />
      <Dialog title={t("ui.commands")} open={open} onClose={() => setOpen(false)}>
        <Command asked={asked} />
      </Dialog>
    </>
  );
}

function Command({ asked }: { asked: CommandRequest }) {
  const [shown, setShown] = useState<ShownCommand | null>(null);
  useEffect(() => {
    const abort = new AbortController();
    post<ShownCommand>("/commands", asked, abort.signal).then(setShown, () => undefined);
    return () => abort.abort();
  }, []);
  return shown && <CopyCommand command={shown.command} python={shown.python} />;
}
