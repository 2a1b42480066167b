/** The loom in space in a page by itself, loom.html: its data stand in the page, no server is needed. */
import { render } from "preact";
import { unpacked } from "../../api/request";
import { hostIn, inflated } from "../../draw/hosted";
import shared from "../../ui/style.css?inline";
import own from "./loom.css?inline";
import { modelOf, type SceneAbout } from "./scene";
import { Workbench } from "./workbench";

const PAGE =
  ":host{display:block;height:min(86vh,900px);border:1px solid var(--line);color:var(--ink);font:14px/1.45 system-ui,sans-serif}.loom-host{height:100%}";

/** Shows the scene in an element; its data are the text of the element with the id `loom-scene`. */
async function show(into: HTMLElement): Promise<void> {
  const content = await inflated(document.getElementById("loom-scene")?.textContent ?? "");
  const host = hostIn(into, shared + own + PAGE);
  host.className = "loom-host";
  render(<Workbench model={modelOf(unpacked<SceneAbout>(content))} />, host);
}

const into = document.getElementById("loom-in-space");
if (into !== null) void show(into);
