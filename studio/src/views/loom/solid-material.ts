/** The material of a part: one colour, flat faces, cut by planes. */
import * as three from "three";
import { LIT, type Light } from "./light";

const VERTEX = `
#include <clipping_planes_pars_vertex>
varying vec3 at;
void main() {
  vec4 mvPosition = modelViewMatrix * instanceMatrix * vec4(position, 1.0);
  at = mvPosition.xyz;
  #include <clipping_planes_vertex>
  gl_Position = projectionMatrix * mvPosition;
}`;

const FRAGMENT = `
#include <clipping_planes_pars_fragment>
uniform vec3 colour;
uniform float opacity;
varying vec3 at;
${LIT}
void main() {
  #include <clipping_planes_fragment>
  gl_FragColor = vec4(lit(colour, flatNormal(at)), opacity);
}`;

export function solidMaterial(light: Light, transparent: boolean): three.ShaderMaterial {
  return new three.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...light.uniforms, colour: { value: new three.Color() }, opacity: { value: 1 } },
    clipping: true,
    transparent,
    depthWrite: !transparent,
  });
}
