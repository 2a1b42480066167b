/** The floor of the picture, and what draws it. */
import * as three from "three";
import { LIT, type Light } from "./light";

/** Width of the floor, and of its squares [m]. */
const WIDE = 6;
const SQUARE = 0.25;

/** Squares on the floor; shadows fall on it, and it ends in the colour of the ground. */
const FLOOR = `
uniform vec3 ground;
uniform vec3 line;
varying vec3 at;
varying vec2 place;
${LIT}
void main() {
  vec2 near = abs(fract(place / ${SQUARE} + 0.5) - 0.5) * ${SQUARE} / max(fwidth(place), 1e-6);
  float grid = 0.16 * (1.0 - min(min(near.x, near.y), 1.0));
  float share = shadowed == 0.0 ? 1.0 : sunShare(at, up);
  vec3 shown = mix(ground * mix(0.8, 1.0, share), line, grid);
  float edge = smoothstep(0.6, 1.0, length(place) / ${WIDE / 2}.0);
  gl_FragColor = vec4(mix(shown, ground, edge), 1.0);
}`;

export function floor(height: number, light: Light): three.Mesh<three.PlaneGeometry, three.ShaderMaterial> {
  const material = new three.ShaderMaterial({
    vertexShader: `
varying vec3 at;
varying vec2 place;
void main() {
  place = position.xy;
  at = (modelViewMatrix * vec4(position, 1.0)).xyz;
  gl_Position = projectionMatrix * vec4(at, 1.0);
}`,
    fragmentShader: FLOOR,
    uniforms: {
      ...light.uniforms,
      ground: { value: new three.Color() },
      line: { value: new three.Color() },
    },
  });
  const mesh = new three.Mesh(new three.PlaneGeometry(WIDE, WIDE), material);
  mesh.rotation.x = -Math.PI / 2;
  mesh.position.y = height - 0.001;
  return mesh;
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
