/** Keys of the linkage editor that act on the canvas. */
import type { Pointer } from "./pointer";

/** Listens to the keys of the page; returns what ends it. `stageOf`: what holds the canvas and the typed position. */
export function listenToKeys(pointer: Pointer, stageOf: () => HTMLElement | null): () => void {
  const pressed = (event: KeyboardEvent) => {
    const isTyping = (event.target as Element).matches?.("input, select, textarea, [contenteditable]");
    if (event.defaultPrevented || isTyping || event.altKey || document.querySelector("dialog[open]")) return;
    const stage = stageOf();
    if (stage !== null && isUsed(event, pointer, stage)) event.preventDefault();
  };
  window.addEventListener("keydown", pressed);
  return () => window.removeEventListener("keydown", pressed);
}

/** Does what a key stands for; returns whether it did, so that the browser does nothing of its own. */
function isUsed(event: KeyboardEvent, pointer: Pointer, stage: HTMLElement): boolean {
  const { editor } = pointer;
  const canvas = stage.querySelector<SVGElement>(".linkage-canvas");
  const target = event.target as Element;
  const isDrawing = canvas?.contains(target) || target.matches("body, main");
  if (event.ctrlKey || event.metaKey) {
    if (!isDrawing || event.key.toLowerCase() !== "a") return false;
    editor.selectAll();
    return true;
  }
  if (!isDrawing) return false;
  if (/^[\d.]$/.test(event.key) && editor.tool.peek() !== "select") {
    stage.querySelector<HTMLInputElement>(".linkage-typed input")?.focus();
    return false; // the browser types the digit into the field
  }
  return pointer.key(event.key, event.shiftKey);
}
