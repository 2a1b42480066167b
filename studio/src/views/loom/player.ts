/** An angle that goes on by itself, at the loom's speed or slower. */
import { useEffect, useRef, useState } from "preact/hooks";
import { TURN } from "./motion";

export interface Player {
  angle: number;
  playing: boolean;
  speed: number;
  set: (angle: number) => void;
  toggle: () => void;
  setSpeed: (speed: number) => void;
}

/** The angle after so many milliseconds of a drive whose turn takes `period` seconds. */
export function advanced(angle: number, milliseconds: number, period: number, speed: number): number {
  return (angle + (TURN * speed * Math.min(milliseconds, 250)) / (1000 * period)) % TURN;
}

export function usePlayer(period: number, show: (angle: number) => void): Player {
  const [angle, setAngle] = useState(0);
  const [playing, setPlaying] = useState(false);
  const [speed, setSpeed] = useState(1);
  const now = useRef(0);
  const shown = useRef(show);
  shown.current = show;
  const set = (to: number) => {
    now.current = to;
    setAngle(to);
    shown.current(to);
  };
  useEffect(() => {
    if (!playing) return;
    let before = performance.now();
    let waiting = 0;
    const step = (time: number) => {
      set(advanced(now.current, time - before, period, speed));
      before = time;
      waiting = requestAnimationFrame(step);
    };
    waiting = requestAnimationFrame(step);
    return () => cancelAnimationFrame(waiting);
  }, [playing, period, speed]);
  return { angle, playing, speed, set, toggle: () => setPlaying((one) => !one), setSpeed };
}
