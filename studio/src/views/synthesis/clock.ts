/** One clock for everything that moves: each drawing moves its own lines at a frame, without a new rendering. */
import { signal } from "@preact/signals";

type Frame = (phase: number) => void;

const frames = new Set<Frame>();

/** Time of one turn [ms]. */
const TURN = 4000;

export const playing = signal(!matchMedia("(prefers-reduced-motion: reduce)").matches);

let phase = 0;
let before = 0;
let waiting = 0;

function tick(now: number): void {
  waiting = 0;
  phase = (phase + Math.min(now - before, 100) / TURN) % 1;
  before = now;
  for (const frame of frames) frame(phase);
  schedule();
}

function schedule(): void {
  if (waiting === 0 && playing.peek() && frames.size > 0) waiting = requestAnimationFrame(tick);
}

/** Calls a function at each frame with the phase, 0 to 1; returns what ends it. */
export function follow(frame: Frame): () => void {
  frames.add(frame);
  frame(phase);
  before = performance.now();
  schedule();
  return () => {
    frames.delete(frame);
  };
}

export function setPlaying(on: boolean): void {
  playing.value = on;
  before = performance.now();
  schedule();
}
