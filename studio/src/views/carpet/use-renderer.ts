import { useSignal, useSignalEffect } from "@preact/signals";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Size } from "./geometry";
import type { CarpetModel } from "./model";
import { Renderer } from "./renderer";

/**
 * The renderer of a canvas: it has the chart of the model and follows the size of the canvas.
 *
 * restored  counts how often a lost context came back: what was sent to the renderer is sent again
 * missing   the browser has no WebGL2
 */
export function useRenderer(model: CarpetModel) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const renderer = useRef<Renderer | null>(null);
  const size = useSignal<Size>({ width: 1, height: 1 });
  const restored = useSignal(0);
  const [missing, setMissing] = useState(false);
  useLayoutEffect(() => {
    const element = canvas.current;
    if (element === null) return undefined;
    const measure = () => {
      const ratio = Math.min(devicePixelRatio, 2);
      const [width, height] = [Math.max(1, element.clientWidth), Math.max(1, element.clientHeight)];
      size.value = { width, height };
      renderer.current?.resize(Math.round(width * ratio), Math.round(height * ratio));
    };
    const begin = () => {
      renderer.current = Renderer.of(element);
      setMissing(renderer.current === null);
    };
    const lost = (event: Event) => event.preventDefault();
    const back = () => {
      begin();
      measure();
      restored.value += 1;
    };
    begin();
    element.addEventListener("webglcontextlost", lost);
    element.addEventListener("webglcontextrestored", back);
    const watch = new ResizeObserver(measure);
    watch.observe(element);
    return () => {
      watch.disconnect();
      element.removeEventListener("webglcontextlost", lost);
      element.removeEventListener("webglcontextrestored", back);
      renderer.current?.end();
      renderer.current = null;
    };
  }, []);
  useSignalEffect(() => {
    restored.value;
    const chart = model.chart.value;
    if (chart === null) return;
    renderer.current?.setYarns(chart.about.yarns);
    renderer.current?.setChart(chart.grid, chart.knots);
  });
  return { canvas, renderer, size, restored, missing };
}
