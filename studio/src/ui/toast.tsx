/** Short messages at the edge of the page. */
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
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

const MOST = 4;
const ICONS = { info: "info", good: "good", warn: "warning", bad: "error" } as const;

/** Shows a message; all but bad ones go by themselves. Returns what takes it away. */
export function toast(text: string, kind: ToastKind = "info", more = ""): () => void {
  count += 1;
  const id = count;
  const others = toasts.peek().filter((one) => one.text !== text);
  toasts.value = [...others, { id, kind, text, more }].slice(-MOST);
  return () => dismiss(id);
}

function dismiss(id: number): void {
  toasts.value = toasts.peek().filter((one) => one.id !== id);
}

/** Time in which a message can be read, by a slow reader [ms]. */
function readingTime({ text, more }: Toast): number {
  return 5000 + 80 * (text.length + more.length);
}

function isUrgent({ kind }: Toast): boolean {
  return kind === "bad" || kind === "warn";
}

/** All messages: two regions that are always there, so that a screen reader reads each message once. */
export function Toasts() {
  const all = toasts.value;
  return (
    <section class="ui-toasts" aria-label={t("app.messages")}>
      <div role="alert">
        {all.filter(isUrgent).map((one) => (
          <Message key={one.id} one={one} />
        ))}
      </div>
      <div role="status">
        {all
          .filter((one) => !isUrgent(one))
          .map((one) => (
            <Message key={one.id} one={one} />
          ))}
      </div>
    </section>
  );
}

/** A message; it stays while the pointer or the focus is on it. */
function Message({ one }: { one: Toast }) {
  const [held, setHeld] = useState(false);
  useEffect(() => {
    if (held || one.kind === "bad") return undefined;
    const timer = setTimeout(() => dismiss(one.id), readingTime(one));
    return () => clearTimeout(timer);
  }, [held, one]);
  return (
    <div
      class={`ui-toast ${one.kind}`}
      onPointerEnter={() => setHeld(true)}
      onPointerLeave={() => setHeld(false)}
      onFocusIn={() => setHeld(true)}
      onFocusOut={() => setHeld(false)}
    >
      <div>
        <p class="ui-row">
          <Icon name={ICONS[one.kind]} />
          <span class="ui-grow">{one.text}</span>
        </p>
        {one.more && <p class="ui-help">{one.more}</p>}
      </div>
      <IconButton icon="close" size="small" label={t("app.dismiss")} onClick={() => dismiss(one.id)} />
    </div>
  );
}
