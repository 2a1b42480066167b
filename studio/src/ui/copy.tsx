import { useState } from "preact/hooks";
import { t } from "../text";
import { Button } from "./button";
import { Tabs } from "./tabs";
import { toast } from "./toast";

interface CopyProps {
  /** The state as a command line. */
  command: string;
  /** The state as Python; left out where there is none. */
  python?: string;
}

/** Copies a text; reports where the browser forbids it. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    toast(t("ui.copyFailed"), "warn");
    return false;
  }
}

/** The state shown as its command line and as Python, each to be copied. */
export function CopyCommand({ command, python }: CopyProps) {
  const [kind, setKind] = useState<"shell" | "python">("shell");
  if (python === undefined) return <Copy label={t("ui.commandLine")} text={command} />;
  return (
    <Tabs
      label={t("ui.commandLine")}
      value={kind}
      tabs={[
        { value: "shell", label: t("ui.commandLine") },
        { value: "python", label: t("ui.python") },
      ]}
      onChange={setKind}
    >
      {kind === "shell" ? (
        <Copy label={t("ui.commandLine")} text={command} />
      ) : (
        <Copy label={t("ui.python")} text={python} />
      )}
    </Tabs>
  );
}

function Copy({ label, text }: { label: string; text: string }) {
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    if (!(await copyText(text))) return;
    setCopied(true);
    setTimeout(() => setCopied(false), 2000);
  };
  return (
    <div class="ui-copy">
      <div class="ui-copy-head">
        <span>{label}</span>
        <Button kind="quiet" size="small" icon={copied ? "connected" : "copy"} onClick={copy}>
          {copied ? t("ui.copied") : t("ui.copy")}
        </Button>
      </div>
      <pre tabIndex={0} aria-label={label} role="group">
        <code>{text}</code>
      </pre>
    </div>
  );
}
