/** The material of a part: metal, wood or what is bought, flat faces; what a plane cuts is hatched. */
import * as three from "three";
import { LIT, type Light } from "./light";

const VERTEX = `
#include <clipping_planes_pars_vertex>
varying vec3 at;
varying vec3 own;
varying vec3 tint;
void main() {
  #ifdef USE_INSTANCING_COLOR
  tint = instanceColor;
  #else
  tint = vec3(1.0);
  #endif
  vec4 mvPosition = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
  at = mvPosition.xyz;
  own = position;
  #include <clipping_planes_vertex>
  gl_Position = projectionMatrix * mvPosition;
}`;

/**
 * Behind a plane that cuts solids, a back face is what the inside of a solid ends at: seen through the cut, it is the cut
 * itself. It is drawn as the cut: flat, hatched where the ray of the pixel meets the plane.
 */
const FRAGMENT = `
#include <clipping_planes_pars_fragment>
uniform vec3 colour;
uniform float opacity;
uniform float gloss;
uniform float grain;
uniform mat4 world;
uniform vec4 cut;
uniform float hatch;
varying vec3 at;
varying vec3 own;
varying vec3 tint;
${LIT}
vec3 hatched() {
  vec3 met = at * (-cut.w / dot(cut.xyz, at));
  vec3 place = (world * vec4(met, 1.0)).xyz;
  float across = fract((place.x + place.y + place.z) / hatch);
  return mix(colour * tint, vec3(1.0), 0.35) * (across < 0.16 ? 0.45 : 1.0);
}
void main() {
  #include <clipping_planes_fragment>
  if (!gl_FrontFacing) {
    gl_FragColor = vec4(hatched(), opacity);
    return;
  }
  vec3 shown = colour * tint;
  if (grain > 0.0) {
    float ring = length(own.yz * vec2(1.0, 1.7) + vec2(0.11, 0.07)) * 420.0 + 2.0 * sin(own.x * 23.0);
    shown *= 1.0 + grain * sin(ring);
  }
  gl_FragColor = vec4(lit(shown, flatNormal(at), at, gloss), opacity);
}`;

/** How the surface of a material looks: see `LIT` for the gloss; grain: depth of the rings of wood. */
export interface Finish {
  gloss: number;
  grain: number;
}

export function solidMaterial(light: Light, { gloss, grain }: Finish): three.ShaderMaterial {
  return new three.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      ...light.uniforms,
      colour: { value: new three.Color() },
      opacity: { value: 1 },
      gloss: { value: gloss },
      grain: { value: grain },
    },
    clipping: true,
    polygonOffset: true, // edges lie upon faces
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}
