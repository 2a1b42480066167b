/** Parts of the client in pages that stand by themselves: their data stand in the page, no server is needed. */
import { effect } from "@preact/signals";
import { dark } from "../app/settings";
import parts from "../ui/parts.css?inline";
import variables from "../ui/tokens.css?inline";
import figures from "./draw.css?inline";

/** Styles of a whole page for an element of another page: rules of the root hold for the element. */
function hosted(css: string): string {
  return css.replace(/:root(\[[^\]]*\])/g, ":host($1)").replaceAll(":root", ":host");
}

/** The bytes of a text of base64 of compressed bytes. */
export async function inflated(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** An element inside an element of the page, with the client's styles and theme, and apart from those of the page. */
export function hostIn(element: HTMLElement, css: string): HTMLElement {
  const root = element.attachShadow({ mode: "open" });
  const style = document.createElement("style");
  style.textContent = hosted(variables + parts + figures + css);
  const host = document.createElement("div");
  root.append(style, host);
  effect(() => {
    element.dataset["theme"] = dark.value ? "dark" : "light";
  });
  return host;
}
