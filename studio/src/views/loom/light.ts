/** Light of the picture, computed as simply as can be: a processor may have to draw it. */
import * as three from "three";

/** From the sky, from the weaver's side, and a little from behind; in space. */
const DIRECTIONS: Record<"up" | "sun" | "back", [number, number, number]> = {
  up: [0, 1, 0],
  sun: [1.2, 2, 2.5],
  back: [-2, 1, -1.5],
};

/**
 * GLSL: the colour that a surface shows, by its normal; the normal of a flat surface at a point of the camera's space.
 * Colours are those of the screen, so that none is converted for each pixel.
 */
export const LIT = `
uniform vec3 up;
uniform vec3 sun;
uniform vec3 back;
vec3 lit(vec3 colour, vec3 normal) {
  float light = 0.5 + 0.12 * dot(normal, up) + 0.42 * max(dot(normal, sun), 0.0) + 0.14 * max(dot(normal, back), 0.0);
  return colour * light;
}
vec3 flatNormal(vec3 at) {
  return normalize(cross(dFdx(at), dFdy(at)));
}`;

/** The directions of the light in the camera's space, shared by all materials. */
export class Light {
  readonly uniforms = {
    up: { value: new three.Vector3() },
    sun: { value: new three.Vector3() },
    back: { value: new three.Vector3() },
  };

  update(camera: three.Camera): void {
    for (const name of ["up", "sun", "back"] as const)
      this.uniforms[name].value.set(...DIRECTIONS[name]).transformDirection(camera.matrixWorldInverse);
  }
}

/** A colour of the screen as a shader takes it. */
export function screenColour(colour: string, into: three.Color): void {
  into.set(colour).convertLinearToSRGB();
}
