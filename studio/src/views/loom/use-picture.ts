/** A stage on a canvas: made when the canvas is there, as large as it, in the colours of the theme. */
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { SceneModel } from "./scene";
import { type Label, Stage } from "./stage";

interface PictureOptions {
  names: boolean;
  onPick: (name: string) => void;
}

const STILL = 4;
const MOST_NAMES = 24;

/** Height of a label [px], and where it may stand beside its point, in lines. */
const LINE = 20;
const BESIDE = [0, -1, 1, -2, 2, -3, 3];

interface SpacedLabel {
  text: string;
  left: number;
  top: number;
  width: number;
}

export function usePicture(
  model: SceneModel,
  canvas: RefObject<HTMLCanvasElement | null>,
  labels: RefObject<HTMLDivElement | null>,
  options: PictureOptions,
): RefObject<Stage | null> {
  const stage = useRef<Stage | null>(null);
  const wanted = useRef(options);
  wanted.current = options;
  useEffect(() => {
    const element = canvas.current;
    if (element === null) return;
    const made = new Stage(model, element);
    stage.current = made;
    made.drawn = () => {
      if (labels.current) drawLabels(made, labels.current, wanted.current.names, element);
    };
    made.weave(Math.round(0.6 * model.about.carpet.rows));
    const root = document.documentElement;
    const paint = () => made.setTheme(root.dataset["theme"] ?? null);
    const sized = () => made.resize(element.clientWidth, element.clientHeight);
    const [watch, size] = [new MutationObserver(paint), new ResizeObserver(sized)];
    watch.observe(root, { attributes: true, attributeFilter: ["data-theme"] });
    size.observe(element);
    paint();
    sized();
    made.show("iso");
    const end = clicks(element, (x, y) => (made.measures ? made.mark(x, y) : wanted.current.onPick(made.pick(x, y))));
    return () => {
      end();
      watch.disconnect();
      size.disconnect();
      made.dispose();
      stage.current = null;
    };
  }, [model]);
  useEffect(() => stage.current?.invalidate(), [options.names]);
  return stage;
}

/** Calls back with the position, from -1 to 1, of a press that is not a drag. */
function clicks(element: HTMLElement, chosen: (x: number, y: number) => void): () => void {
  let at: [number, number] = [0, 0];
  const down = (event: PointerEvent) => {
    at = [event.clientX, event.clientY];
  };
  const up = (event: PointerEvent) => {
    if (event.button !== 0 || Math.hypot(event.clientX - at[0], event.clientY - at[1]) > STILL) return;
    const box = element.getBoundingClientRect();
    chosen((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
  };
  element.addEventListener("pointerdown", down);
  element.addEventListener("pointerup", up);
  return () => {
    element.removeEventListener("pointerdown", down);
    element.removeEventListener("pointerup", up);
  };
}

function drawLabels(stage: Stage, into: HTMLElement, shown: boolean, canvas: HTMLElement): void {
  const distance = stage.distance();
  const labels = shown || stage.looksInside ? stage.labels() : [];
  const kept = spaced(distance === null ? labels : [distance, ...labels], canvas, stage.looksInside);
  while (into.children.length > kept.length) into.lastElementChild?.remove();
  while (into.children.length < kept.length) into.append(document.createElement("span"));
  kept.forEach((one, k) => {
    const label = into.children[k] as HTMLElement;
    label.textContent = one.text;
    label.style.transform = `translate(${Math.round(one.left)}px, ${Math.round(one.top)}px)`;
  });
}

const pen = document.createElement("canvas").getContext("2d");

/** Width of a label [px]. */
function widthOf(text: string): number {
  if (pen === null) return 8 * text.length;
  pen.font = "12px system-ui, sans-serif";
  return pen.measureText(text).width + 12;
}

/** Texts that do not lie upon each other; all: one whose point is covered stands above or below it. */
function spaced(labels: readonly Label[], canvas: HTMLElement, all: boolean): SpacedLabel[] {
  const kept: SpacedLabel[] = [];
  for (const { text, x, y } of labels) {
    if (kept.length >= MOST_NAMES) break;
    const width = widthOf(text);
    const left = Math.min(((x + 1) / 2) * canvas.clientWidth, canvas.clientWidth - width - 8);
    const isFree = (top: number) =>
      kept.every((one) => Math.abs(one.top - top) > LINE || one.left > left + width || left > one.left + one.width);
    const top = ((1 - y) / 2) * canvas.clientHeight;
    const free = (all ? BESIDE : [0]).map((lines) => top + lines * (LINE + 1)).find(isFree);
    if (free !== undefined) kept.push({ text, left, top: free, width });
  }
  return kept;
}
