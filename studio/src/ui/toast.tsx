/** Short messages at the edge of the page. */
import { signal } from "@preact/signals";
import { t } from "../text";
import { IconButton } from "./button";
import { Icon } from "./icons";

export type ToastKind = "info" | "good" | "warn" | "bad";

interface Toast {
  id: number;
  kind: ToastKind;
  text: string;
  more: string;
}

const toasts = signal<readonly Toast[]>([]);
let count = 0;

const SHOWN = 6000;
const MOST = 4;

/** Shows a message; those that report nothing bad go by themselves. Returns what takes it away. */
export function toast(text: string, kind: ToastKind = "info", more = ""): () => void {
  count += 1;
  const id = count;
  const others = toasts.peek().filter((one) => one.text !== text);
  toasts.value = [...others, { id, kind, text, more }].slice(-MOST);
  const dismiss = () => {
    toasts.value = toasts.peek().filter((one) => one.id !== id);
  };
  if (kind === "info" || kind === "good") setTimeout(dismiss, SHOWN);
  return dismiss;
}

const ICONS = { info: "info", good: "good", warn: "warning", bad: "error" } as const;

export function Toasts() {
  return (
    <section class="ui-toasts" aria-label={t("app.messages")} aria-live="polite" aria-relevant="additions">
      {toasts.value.map((one) => (
        <div key={one.id} class={`ui-toast ${one.kind}`} role={one.kind === "bad" ? "alert" : undefined}>
          <div>
            <p class="ui-row">
              <Icon name={ICONS[one.kind]} />
              <span class="ui-grow">{one.text}</span>
            </p>
            {one.more && <p class="ui-help">{one.more}</p>}
          </div>
          <IconButton
            icon="close"
            size="small"
            label={t("app.dismiss")}
            onClick={() => {
              toasts.value = toasts.peek().filter((other) => other.id !== one.id);
            }}
          />
        </div>
      ))}
    </section>
  );
}
