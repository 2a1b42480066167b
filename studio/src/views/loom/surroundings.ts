/** The floor of the picture, and what draws it. */
import * as three from "three";

/** Squares of a quarter of a metre on the floor at a height [m]. */
export function floorGrid(height: number): three.Object3D {
  const grid = new three.GridHelper(6, 24, 0x8a95a0, 0xb7bec6);
  grid.position.y = height - 0.001;
  const material = grid.material as three.Material;
  material.transparent = true;
  material.opacity = 0.35;
  return grid;
}

export type Graphics = "none" | "processor" | "card";

let known: Graphics | null = null;

/** What draws: nothing, the processor itself, or a graphics card. */
export function graphics(): Graphics {
  if (known !== null) return known;
  const context = document.createElement("canvas").getContext("webgl2");
  const about = context?.getExtension("WEBGL_debug_renderer_info");
  const name = about ? String(context?.getParameter(about.UNMASKED_RENDERER_WEBGL)) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  known = context === null ? "none" : /swiftshader|llvmpipe|software|basic render/i.test(name) ? "processor" : "card";
  return known;
}
