/** The carpet as a mesh: its texture moves down as rows are woven, and nothing is drawn beyond the first row. */
import * as three from "three";
import { chartPixels, ribbon, yarnColour } from "./cloth";
import { LIT, type Light } from "./light";
import type { SceneModel } from "./scene";

const VERTEX = `
#include <clipping_planes_pars_vertex>
uniform float woven;
varying vec2 knot;
varying vec3 at;
void main() {
  vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
  knot = uv + vec2(0.0, woven);
  at = mvPosition.xyz;
  #include <clipping_planes_vertex>
  gl_Position = projectionMatrix * mvPosition;
}`;

const FRAGMENT = `
#include <clipping_planes_pars_fragment>
uniform sampler2D chart;
uniform vec2 knots;
varying vec2 knot;
varying vec3 at;
${LIT}
void main() {
  #include <clipping_planes_fragment>
  if (knot.y < 0.0) discard;
  vec2 inKnot = fract(knot * knots) - 0.5;
  float seen = clamp(0.45 - max(fwidth(knot.x * knots.x), fwidth(knot.y * knots.y)), 0.0, 0.45) / 0.45;
  float tuft = 1.0 - seen * 0.9 * dot(inKnot, inKnot);
  gl_FragColor = vec4(lit(tuft * texture2D(chart, knot).rgb, flatNormal(at), at, 0.0), 1.0);
}`;

export class Cloth {
  readonly mesh: three.Mesh;
  readonly material: three.ShaderMaterial;
  private readonly texture: three.DataTexture;
  private readonly woven = { value: 0 };
  private rows = 0;

  constructor(
    private readonly model: SceneModel,
    light: Light,
  ) {
    const { carpet, chart } = model.about;
    const made = ribbon(model, carpet.pile / 2);
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(made.points, 3));
    const uv = made.uv.map((value, k) => (k % 2 === 0 ? value : -value / (carpet.rows * carpet.rowPitch)));
    geometry.setAttribute("uv", new three.BufferAttribute(uv, 2));
    geometry.setIndex(new three.BufferAttribute(made.triangles, 1));
    this.texture = new three.DataTexture(chartPixels(model), chart?.columns ?? 1, chart?.rows ?? 1, three.RGBAFormat);
    this.texture.generateMipmaps = true;
    this.texture.minFilter = three.LinearMipmapLinearFilter;
    this.texture.magFilter = three.NearestFilter;
    this.texture.needsUpdate = true;
    this.material = new three.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        ...light.uniforms,
        woven: this.woven,
        chart: { value: this.texture },
        knots: { value: new three.Vector2(carpet.columns, carpet.rows) },
      },
      side: three.DoubleSide,
      clipping: true,
    });
    this.mesh = new three.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.weave(carpet.rows);
  }

  /** Shows so many rows; the last one lies at the fell. */
  weave(rows: number): void {
    this.rows = rows;
    this.woven.value = rows / this.model.about.carpet.rows;
  }

  /** The colour of the yarn that is tied next at a distance from the middle [m]; null: it is not known. */
  colourAt(x: number): string | null {
    return yarnColour(this.model, this.rows, x);
  }

  /** Frees what is not in the scene: geometry and material are. */
  dispose(): void {
    this.texture.dispose();
  }
}
