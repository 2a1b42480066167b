/** Light of the picture, computed as simply as can be: a processor may have to draw it. */
import * as three from "three";

/** From the sky, from the weaver's side, and a little from behind; in space. */
export const DIRECTIONS: Record<"up" | "sun" | "back", [number, number, number]> = {
  up: [0, 1, 0],
  sun: [1.2, 2, 2.5],
  back: [-2, 1, -1.5],
};

/**
 * GLSL: the colour that a surface shows at a point `at` of the camera's space; its normal where it is flat; its share of
 * the sun, 0 in the shadow. Colours are those of the screen, so that none is converted for each pixel.
 *
 * gloss  0 for wood and wool, 1 for bare metal: a highlight of the sun and the sky's reflection
 */
export const LIT = `
uniform vec3 up;
uniform vec3 sun;
uniform vec3 back;
uniform mat4 toShadow;
uniform sampler2D shadows;
uniform float shadowed;
vec3 flatNormal(vec3 at) {
  return normalize(cross(dFdx(at), dFdy(at)));
}
float sunShare(vec3 at, vec3 normal) {
  if (shadowed == 0.0) return 1.0;
  vec3 place = (toShadow * vec4(at + normal * shadowed, 1.0)).xyz;
  if (any(greaterThan(abs(place - 0.5), vec3(0.495)))) return 1.0;
  place.z -= 0.0006;
  float share = 0.0;
  for (int x = -1; x <= 1; x++)
    for (int y = -1; y <= 1; y++)
      share += step(place.z, texture2D(shadows, place.xy + vec2(x, y) * 0.0009).r);
  return share / 9.0;
}
vec3 lit(vec3 colour, vec3 normal, vec3 at, float gloss) {
  float share = sunShare(at, normal);
  float light = 0.5 + 0.12 * dot(normal, up) + 0.42 * share * max(dot(normal, sun), 0.0)
    + 0.14 * max(dot(normal, back), 0.0);
  if (gloss == 0.0) return colour * light;
  vec3 seen = normalize(at);
  float shine = pow(max(dot(normal, normalize(sun - seen)), 0.0), 28.0);
  float sky = max(dot(reflect(seen, normal), up), 0.0);
  return colour * (light + 0.12 * gloss * sky) + vec3(0.28 * gloss * share * shine);
}`;

/** What all materials share: the directions of the light in the camera's space, the shadows, the plane of a section. */
export class Light {
  readonly uniforms = {
    up: { value: new three.Vector3() },
    sun: { value: new three.Vector3() },
    back: { value: new three.Vector3() },
    toShadow: { value: new three.Matrix4() },
    shadows: { value: null as three.Texture | null },
    shadowed: { value: 0 },
    world: { value: new three.Matrix4() },
    cut: { value: new three.Vector4() },
    hatch: { value: 0.01 },
  };
  private readonly plane = new three.Plane();

  /** The light as a camera sees it; `section`: the plane that cuts, `pixel`: size of one where the camera looks [m]. */
  update(camera: three.Camera, section: three.Plane, pixel: number): void {
    for (const name of ["up", "sun", "back"] as const)
      this.uniforms[name].value.set(...DIRECTIONS[name]).transformDirection(camera.matrixWorldInverse);
    this.uniforms.world.value.copy(camera.matrixWorld);
    const { normal, constant } = this.plane.copy(section).applyMatrix4(camera.matrixWorldInverse);
    this.uniforms.cut.value.set(normal.x, normal.y, normal.z, constant);
    this.uniforms.hatch.value = 12 * pixel;
  }
}

/** A colour of the screen as a shader takes it. */
export function screenColour(colour: string, into: three.Color): void {
  into.set(colour).convertLinearToSRGB();
}
