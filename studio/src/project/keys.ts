/** Keys for the document in hand: Ctrl-Z, Ctrl-Shift-Z or Ctrl-Y, Ctrl-S; on a Mac with the command key. */
import { activeDocument, saveAll } from "./project";

const TEXT_INPUTS = new Set(["text", "search", "number", "email", "url", "password", "tel", "date", "time"]);

/** Whether an element has an undo of its own, which the browser gives. */
function editsText(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return TEXT_INPUTS.has(target.type);
  return target instanceof HTMLTextAreaElement || (target instanceof HTMLElement && target.isContentEditable);
}

/** What a key does to the document in hand; null: nothing. */
export function documentKey(event: KeyboardEvent): "undo" | "redo" | "save" | null {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return null;
  const key = event.key.toLowerCase();
  if (key === "s" && !event.shiftKey) return "save";
  if (editsText(event.target)) return null;
  if (key === "z") return event.shiftKey ? "redo" : "undo";
  return key === "y" && !event.shiftKey ? "redo" : null;
}

/** Listens to the keys; returns what ends it. */
export function listenToKeys(target: Window = window): () => void {
  const pressed = (event: KeyboardEvent) => {
    const action = documentKey(event);
    if (action === null || event.defaultPrevented) return;
    event.preventDefault();
    if (action === "save") void saveAll();
    else if (action === "undo") void activeDocument.peek()?.undo();
    else void activeDocument.peek()?.redo();
  };
  target.addEventListener("keydown", pressed);
  return () => target.removeEventListener("keydown", pressed);
}
