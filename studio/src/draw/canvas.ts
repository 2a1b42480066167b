/** A canvas that keeps its sharpness and is painted once a frame, only while it is in sight. */
import type { ReadonlySignal } from "@preact/signals";
import { effect } from "@preact/signals";
import type { RefObject } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";
import { dark } from "../app/settings";

export type Paint = (context: CanvasRenderingContext2D, width: number, height: number) => void;

export const FONT = '"Helvetica Neue", Arial, "Liberation Sans", "DejaVu Sans", sans-serif';

/** A canvas that `paint` fills where one of `deps` or of the signals, its size or the theme has changed. */
export function useCanvas(
  paint: Paint,
  deps: readonly unknown[],
  signals: readonly ReadonlySignal<unknown>[] = [],
): RefObject<HTMLCanvasElement | null> {
  const canvas = useRef<HTMLCanvasElement>(null);
  const newest = useRef(paint);
  newest.current = paint;
  const schedule = useRef<() => void>(() => {});
  useLayoutEffect(() => {
    const element = canvas.current;
    const context = element?.getContext("2d");
    if (element == null || context == null) return undefined;
    let [queued, visible] = [0, false];
    const run = () => {
      queued = 0;
      const { clientWidth: width, clientHeight: height } = element;
      if (!visible || width === 0 || height === 0) return;
      const ratio = Math.min(window.devicePixelRatio || 1, 3);
      const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (element.width !== wide || element.height !== high) [element.width, element.height] = [wide, high];
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, width, height);
      newest.current(context, width, height);
    };
    schedule.current = () => {
      queued ||= requestAnimationFrame(run);
    };
    const sizes = new ResizeObserver(() => schedule.current());
    const sight = new IntersectionObserver(
      (seen) => {
        visible = seen.at(-1)?.isIntersecting ?? true;
        if (visible) schedule.current();
      },
      { rootMargin: "200px" },
    );
    sizes.observe(element);
    sight.observe(element);
    const stop = effect(() => {
      for (const one of [dark, ...signals]) one.value;
      schedule.current();
    });
    return () => {
      stop();
      sizes.disconnect();
      sight.disconnect();
      cancelAnimationFrame(queued);
    };
  }, signals as ReadonlySignal<unknown>[]);
  useLayoutEffect(() => schedule.current(), deps as unknown[]);
  return canvas;
}
