/** Names of files and their views. */
import { address, type View } from "../../app/routes";

/** Kinds of text files in the order in which they are listed, with their folders. */
export const FOLDERS = {
  carpet: "",
  machine: "machines",
  linkage: "linkages",
  synthesis: "synthesis",
  cyclogram: "cyclograms",
  yarns: "yarns",
} as const;
export type Kind = keyof typeof FOLDERS;
export const KINDS = Object.keys(FOLDERS) as Kind[];

/** The name of a file without folder and ending. */
export function stemOf(path: string): string {
  return path.replace(/^.*\//, "").replace(/\.toml$/, "");
}

/** The address of the view that edits a file; null: this one, as text. */
export function viewAddress(kind: string, path: string): string | null {
  const view = kind as View | "yarns";
  if (view === "yarns" || !(kind in FOLDERS)) return null;
  const stem = stemOf(path);
  return address(view, view === "carpet" && stem === "carpet" ? "" : stem);
}

/** A path of the same folder with another name. */
export function renamed(path: string, stem: string): string {
  return `${path.replace(/[^/]*$/, "")}${stem.trim()}.toml`;
}

/** The content of a new file of a kind. */
export const STARTS: Record<Kind, string> = {
  carpet: 'plain = "ivory"\nsize = "60x90cm"\nquality = "25x25/dm"\n',
  machine: 'machine = "beat-up"\n\n[settings]\n',
  linkage: `name = "four-bar"
paths = [["coupler", "P"]]
inputs = { A0 = "crank" }
branches = { B = 1 }
motions = { A0 = "60rpm" }

[bodies]
crank.length = "40mm"
rocker.length = "90mm"
coupler = { length = "120mm", points.P = ["60mm", "40mm"] }

[bodies.ground.points]
A0 = [0, 0]
B0 = ["110mm", 0]

[joints]
A0.pin = ["ground", "crank"]
A.pin = ["crank", "coupler"]
B.pin = ["coupler", "rocker"]
B0.pin = ["ground", "rocker"]
`,
  synthesis: 'machine = "path-four-bar"\n\n[settings]\npoints = "(60mm,0mm) (30mm,18mm) (0mm,0mm) (30mm,-4mm)"\n',
  cyclogram: `name = "machine"
period = "1s"

[tracks.slide]
unit = "mm"

[tracks.slide.motions]
out = { start = "0deg", end = "90deg", from = "0mm", to = "50mm", law = "modified-sine" }
back = { start = "180deg", end = "270deg", from = "50mm", to = "0mm", law = "modified-sine" }
`,
  yarns: '[[yarn]]\nname = "ivory"\nsrgb = "#efe6d2"\n\n[[yarn]]\nname = "dark red"\nsrgb = "#7a1f24"\n',
};
