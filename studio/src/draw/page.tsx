/** Figures of a page that stands by itself: where scripts run, the client draws them in place of the static ones. */
import { render } from "preact";
import { setLanguage } from "../text";
import { CursorContext, type Cursors } from "./cursor";
import type { ShownFigure } from "./figures";
import { hostIn, inflated } from "./hosted";
import { tokens } from "./looks";
import { FigureBody } from "./report";

const STYLE =
  ":host{display:block;color:var(--ink);font:14px/1.45 system-ui,sans-serif;font-variant-numeric:tabular-nums}";

/** Figures of one machine share their cursors. */
const machines = new Map<Element, Cursors>();

function cursorsOf(figure: Element): Cursors {
  const machine = figure.closest(".machine") ?? document.body;
  const cursors = machines.get(machine) ?? new Map();
  machines.set(machine, cursors);
  return cursors;
}

/** Draws a figure from the data that it holds, as high as the static one, which is still printed. */
async function show(figure: HTMLElement, still: HTMLElement): Promise<void> {
  const data = figure.querySelector("script")?.textContent ?? "";
  const shown = JSON.parse(new TextDecoder().decode(await inflated(data))) as ShownFigure;
  const high = still.querySelector("svg")?.getBoundingClientRect().height ?? 0;
  const live = document.createElement("div");
  live.className = "live";
  still.before(live);
  const host = hostIn(live, STYLE);
  tokens.of = live;
  const cursors = cursorsOf(figure);
  render(
    <CursorContext.Provider value={cursors}>
      <FigureBody figure={shown} autoplay height={Math.min(Math.max(Math.round(high), 220), 560)} />
    </CursorContext.Provider>,
    host,
  );
  figure.classList.add("drawn");
  rests(live, cursors, shown.animation?.drive.label);
}

/** What plays rests while it is out of sight. */
function rests(live: HTMLElement, cursors: Cursors, drive: string | undefined): void {
  const cursor = drive === undefined ? undefined : cursors.get(drive);
  if (cursor === undefined) return;
  let player: object | null = null;
  new IntersectionObserver((seen) => {
    if (!seen.at(-1)?.isIntersecting) [player, cursor.player.value] = [cursor.player.peek(), null];
    else if (player !== null) [cursor.player.value, player] = [cursor.player.peek() ?? player, null];
  }).observe(live);
}

const sight = new IntersectionObserver(
  (entries) => {
    for (const { isIntersecting, target } of entries) {
      const still = target.querySelector<HTMLElement>(".still");
      if (!isIntersecting || still === null) continue;
      sight.unobserve(target);
      void show(target as HTMLElement, still);
    }
  },
  { rootMargin: "400px" },
);
void setLanguage(document.documentElement.lang === "tr" ? "tr" : "en");
for (const figure of document.querySelectorAll("figure.shown")) sight.observe(figure);
