/** The loom in space in a page by itself, loom.html: its data stand in the page, no server is needed. */
import { render } from "preact";
import { unpacked } from "../../api/request";
import shared from "../../ui/style.css?inline";
import own from "./loom.css?inline";
import { modelOf, type SceneAbout } from "./scene";
import { Workbench } from "./workbench";

const PAGE =
  ":host{display:block;height:min(86vh,900px);border:1px solid var(--line);color:var(--ink);font:14px/1.45 system-ui,sans-serif}.loom-host{height:100%}";

/** Styles of a whole page for an element of another page: rules of the root hold for the element. */
export function hosted(css: string): string {
  return css.replace(/:root(\[[^\]]*\])/g, ":host($1)").replaceAll(":root", ":host");
}

/** The bytes of a text of base64 of compressed bytes. */
async function inflated(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** Shows the scene in an element; its data are the text of the element with the id `loom-scene`. */
async function show(into: HTMLElement): Promise<void> {
  const content = await inflated(document.getElementById("loom-scene")?.textContent ?? "");
  const root = into.attachShadow({ mode: "open" });
  const style = document.createElement("style");
  style.textContent = hosted(shared) + hosted(own) + PAGE;
  const host = document.createElement("div");
  host.className = "loom-host";
  root.append(style, host);
  theme(into);
  render(<Workbench model={modelOf(unpacked<SceneAbout>(content))} />, host);
}

/** The colours that the reader's system prefers. */
function theme(into: HTMLElement): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const paint = () => {
    for (const element of [into, document.documentElement]) element.dataset["theme"] = dark.matches ? "dark" : "light";
  };
  dark.addEventListener("change", paint);
  paint();
}

const into = document.getElementById("loom-in-space");
if (into !== null) void show(into);
