/** Colours of the scene in both themes. */
import type { ScenePart } from "./scene";
import type { Finish } from "./solid-material";
import type { Tool } from "./tools";

export interface Look {
  ground: string;
  line: string;
  warp: string;
  weft: string;
  pile: string;
  carpet: string;
  chosen: string;
  failed: string;
  envelope: string;
  steel: string;
  hard: string;
  aluminium: string;
  bought: string;
  wood: string;
  floor: string;
  machines: Record<string, string>;
}

const LIGHT: Look = {
  ground: "#eef0f2",
  line: "#52606d",
  warp: "#8a7a55",
  weft: "#8c2f2b",
  pile: "#1f4e8c",
  carpet: "#b9ad94",
  chosen: "#e8a200",
  failed: "#d22f27",
  envelope: "#5b86b8",
  steel: "#9aa5b1",
  hard: "#7b8794",
  aluminium: "#c3cad1",
  bought: "#4d5965",
  wood: "#c19a62",
  floor: "#d5d9dd",
  machines: { "beat-up": "#b4613a", hammer: "#b4613a", weft: "#3f8f6b", weaver: "#6d6fae", shedding: "#7d93a8" },
};

const DARK: Look = {
  ground: "#171c21",
  line: "#a9b4bf",
  warp: "#b9a878",
  weft: "#e58079",
  pile: "#8fbcf5",
  carpet: "#8d836c",
  chosen: "#ffc53d",
  failed: "#ff6b5e",
  envelope: "#5b86b8",
  steel: "#8b97a3",
  hard: "#75808b",
  aluminium: "#aeb8c1",
  bought: "#56626e",
  wood: "#b08a55",
  floor: "#252c33",
  machines: { "beat-up": "#c9764c", hammer: "#c9764c", weft: "#46a37b", weaver: "#8486c9", shedding: "#6f8aa6" },
};

export function look(theme: string | null): Look {
  return theme === "dark" ? DARK : LIGHT;
}

/** Colours of the tools of a head, so that each is told from its neighbours: the first is large. */
const TOOLS = ["#7f8fb0", "#c8553d", "#3f7fb0", "#3f8f6b", "#8a5aa5", "#d98f2b", "#b0487a"];

/** The colour of a part, which may be of a tool. */
export function colourOf(part: ScenePart, shown: Look, tool?: Tool): string {
  if (tool !== undefined) return TOOLS[tool.number % TOOLS.length] as string;
  if (isRoom(part)) return shown.envelope;
  if (part.envelope) return shown.bought;
  if (part.material === "beech") return shown.wood;
  if (part.material.includes("aluminium") && part.machine !== "weaver") return shown.aluminium;
  return shown.machines[part.machine] ?? (part.material.includes("hardened") ? shown.hard : shown.steel);
}

/** Whether a part is no more than a room that is kept free: the parts list has none of it. */
export function isRoom(part: ScenePart): boolean {
  return part.number === 0;
}

/** How the surface of a part looks. */
export function finishOf(part: ScenePart): Finish {
  if (part.material === "beech") return { gloss: 0, grain: 0.09 };
  return { gloss: part.envelope ? 0.25 : part.material.includes("cast iron") ? 0.4 : 1, grain: 0 };
}
