import { useEffect, useState } from "preact/hooks";
import type { ShownCommand } from "../api/messages";
import { post } from "../api/request";
import { ready } from "../app/ready";
import { CopyCommand } from "../ui";

interface FileCommandProps {
  kind: "machine" | "linkage" | "cyclogram" | "carpet" | "chart";
  path: string;
  options?: Record<string, string>;
}

/** What is done with a file of the project, as command line and as Python; after the view's first content. */
export function FileCommand({ kind, path, options = {} }: FileCommandProps) {
  const [shown, setShown] = useState<ShownCommand | null>(null);
  const key = JSON.stringify(options);
  const isReady = ready.value;
  useEffect(() => {
    if (!isReady) return;
    const abort = new AbortController();
    post<ShownCommand>("/commands", { kind, path, options }, abort.signal).then(setShown, () => undefined);
    return () => abort.abort();
  }, [kind, path, key, isReady]);
  return shown && <CopyCommand command={shown.command} python={shown.python} />;
}
