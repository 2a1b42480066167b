/** Lights and floor of the picture, and what draws it. */
import * as three from "three";

/** Light from the sky, from the weaver's side, and a little from behind. */
export function lights(): three.Light[] {
  const sun = new three.DirectionalLight(0xffffff, 1.7);
  sun.position.set(1.2, 2, 2.5);
  const back = new three.DirectionalLight(0xffffff, 0.6);
  back.position.set(-2, 1, -1.5);
  return [new three.HemisphereLight(0xffffff, 0x8a8f96, 1.6), sun, back];
}

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
