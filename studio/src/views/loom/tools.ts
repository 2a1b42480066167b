/** The tools of a head: which frames are of which. */
import type { Placed } from "./motion";
import type { SceneAbout } from "./scene";

export interface Tool {
  /** What people call it. */
  name: string;
  /** Among the tools of a head. */
  number: number;
}

/** The tool that a frame is of: its own, or that of the nearest frame that carries it; undefined: none. */
export function toolOf({ tools }: SceneAbout, placed: Placed | null): Tool | undefined {
  if (placed === null) return undefined;
  const number = Object.keys(tools).indexOf(placed.frame.name);
  return number < 0 ? toolOf({ tools } as SceneAbout, placed.parent) : { name: tools[placed.frame.name] ?? "", number };
}
