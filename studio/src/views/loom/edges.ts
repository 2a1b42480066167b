/** The edges of a part as lines: where two faces meet at an angle. */
import * as three from "three";

/** Faces of a round surface meet at less than this [deg]. */
const SHARP = 28;

const VERTEX = `
#include <clipping_planes_pars_vertex>
attribute mat4 copy;
void main() {
  vec4 mvPosition = modelViewMatrix * copy * vec4(position, 1.0);
  #include <clipping_planes_vertex>
  gl_Position = projectionMatrix * mvPosition;
}`;

const FRAGMENT = `
#include <clipping_planes_pars_fragment>
uniform vec3 colour;
uniform float opacity;
void main() {
  #include <clipping_planes_fragment>
  gl_FragColor = vec4(0.5 * colour, opacity);
}`;

export class Edges {
  readonly lines: three.LineSegments<three.InstancedBufferGeometry, three.ShaderMaterial>;
  private readonly known = new Map<three.BufferGeometry, three.BufferAttribute>();

  /** copies: the matrices of the part's copies, shared with its faces; colour: uniform of its faces. */
  constructor(copies: three.InstancedBufferAttribute, colour: three.IUniform) {
    const geometry = new three.InstancedBufferGeometry();
    geometry.setAttribute("copy", copies);
    const material = new three.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { colour, opacity: { value: 1 } },
      clipping: true,
      transparent: true,
    });
    this.lines = new three.LineSegments(geometry, material);
    this.lines.frustumCulled = false;
    this.lines.visible = false;
  }

  /** Draws the edges of so many copies of faces. */
  show(faces: three.BufferGeometry, copies: number): void {
    const { geometry } = this.lines;
    let position = this.known.get(faces);
    if (position === undefined) {
      position = new three.EdgesGeometry(faces, SHARP).getAttribute("position") as three.BufferAttribute;
      this.known.set(faces, position);
    }
    if (geometry.getAttribute("position") !== position) geometry.setAttribute("position", position);
    geometry.instanceCount = copies;
    this.lines.visible = position.count > 0;
  }

  hide(): void {
    this.lines.visible = false;
  }
}
