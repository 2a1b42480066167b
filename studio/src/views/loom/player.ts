/** An angle that goes on by itself, at the loom's speed or slower. */
import { type Signal, signal } from "@preact/signals";
import { useEffect, useMemo } from "preact/hooks";
import { TURN } from "./motion";

/** The angle after so many milliseconds of a drive whose turn takes `period` seconds. */
export function advanced(angle: number, milliseconds: number, period: number, speed: number): number {
  return (angle + (TURN * speed * Math.min(milliseconds, 250)) / (1000 * period)) % TURN;
}

/** Only what reads the signals is drawn anew while it plays. */
export interface Player {
  angle: Signal<number>;
  playing: Signal<boolean>;
  speed: Signal<number>;
}

export function usePlayer(period: number, show: (angle: number) => void): Player {
  const player = useMemo(() => ({ angle: signal(0), playing: signal(false), speed: signal(1) }), []);
  useEffect(() => {
    const { angle, playing, speed } = player;
    let [before, waiting] = [0, 0];
    const step = (time: number) => {
      angle.value = advanced(angle.peek(), before === 0 ? 0 : time - before, period, speed.peek());
      before = time;
      waiting = requestAnimationFrame(step);
    };
    const shown = angle.subscribe(show);
    const played = playing.subscribe((on) => {
      cancelAnimationFrame(waiting);
      before = 0;
      if (on) waiting = requestAnimationFrame(step);
    });
    return () => {
      shown();
      played();
      cancelAnimationFrame(waiting);
    };
  }, [period, show]);
  return player;
}
