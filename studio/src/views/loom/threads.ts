/** Warps, wefts and yarns of knots: ribbons as wide as the thread, a pixel at least, that face the camera. */
import * as three from "three";
import { screenColour } from "./light";
import type { Look } from "./look";
import { type Angles, type Frames, type Placed, yarnPoints } from "./motion";
import type { SceneModel, SceneYarn } from "./scene";

/** A segment of a thread between two points of its line, beside which the thread is `shift`. */
const VERTEX = `
#define NEIGHBOURS 60.0
#include <clipping_planes_pars_vertex>
attribute float segment;
attribute float shift;
uniform vec3 line[POINTS];
uniform float radius;
uniform float pixel;
uniform vec2 marked;
uniform float cap;
varying float across;
varying float along;
varying float thick;
varying float mark;
varying float covered;
void main() {
  vec3 beside = vec3(shift, 0.0, 0.0);
  mark = step(abs(shift - marked.x), marked.y);
  vec3 begin = (modelViewMatrix * vec4(line[int(segment)] + beside, 1.0)).xyz;
  vec3 end = (modelViewMatrix * vec4(line[int(segment) + 1] + beside, 1.0)).xyz;
  vec4 mvPosition = vec4(mix(begin, end, position.y), 1.0);
  float least = 0.5 * pixel * max(-mvPosition.z, 0.0);
  mvPosition.xyz += normalize(cross(end - begin, mvPosition.xyz)) * max(radius, least) * position.x;
  mvPosition.xyz += normalize(end - begin) * cap * radius * (2.0 * position.y - 1.0);
  across = position.x;
  along = position.y * length(end - begin) / radius;
  thick = clamp(0.25 * (radius / least - 1.0), 0.0, 1.0);
  covered = min(radius / least, 1.0);
  #include <clipping_planes_vertex>
  gl_Position = projectionMatrix * mvPosition;
  if (abs(shift - marked.x) > NEIGHBOURS * marked.y && marked.y > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const FRAGMENT = `
#include <clipping_planes_pars_fragment>
uniform vec3 colour;
uniform float others;
varying float across;
varying float along;
varying float thick;
varying float mark;
varying float covered;
void main() {
  #include <clipping_planes_fragment>
  float lit = mix(0.45, 1.15, sqrt(max(0.0, 1.0 - across * across)));
  lit *= 1.0 + 0.08 * thick * sin(2.1 * along + 2.2 * across); // two plies that are twisted
  vec3 shown = mix(colour, vec3(0.85, 0.2, 0.15), 0.7 * mark);
  gl_FragColor = vec4(shown * mix(1.0, lit, thick), covered * mix(others, 1.0, mark));
}`;

/** How much is seen of the warps beside those of a knot. */
const OTHERS = 0.2;

interface ShownYarn {
  yarn: SceneYarn;
  placed: Placed;
  meshes: three.Mesh[];
  points: Float32Array;
  material: three.ShaderMaterial;
}

export class Threads {
  readonly group = new three.Group();
  private readonly warps: ShownYarn[];
  private readonly yarns: ShownYarn[];

  constructor(
    private readonly model: SceneModel,
    private readonly frames: Frames,
  ) {
    this.warps = model.about.warps.flatMap((yarn) => this.shown(yarn));
    this.yarns = model.about.yarns.flatMap((yarn) => this.shown(yarn));
    for (const { material } of this.yarns) if (material.uniforms["cap"]) material.uniforms["cap"].value = 1; // its bends are sharp
    this.update({});
  }

  private shown(yarn: SceneYarn): ShownYarn[] {
    const placed = this.frames.byName.get(yarn.frame);
    if (placed === undefined) return [];
    const points = new Float32Array(3 * yarn.number);
    const material = threadMaterial(yarn.diameter, points);
    const geometry = ribbons(yarn.across === null ? [0] : this.model.floats(yarn.across), yarn.number - 1);
    const meshes = Array.from({ length: placed.count }, () => threadMesh(geometry, material));
    this.group.add(...meshes);
    return [{ yarn, placed, meshes, points, material }];
  }

  get materials(): three.ShaderMaterial[] {
    return [...this.warps, ...this.yarns].map((one) => one.material);
  }

  update(angles: Angles): void {
    for (const { yarn, placed, meshes, points } of [...this.warps, ...this.yarns]) {
      yarnPoints(this.model, yarn, angles[yarn.drive] ?? 0, points);
      meshes.forEach((mesh, copy) => {
        mesh.matrix.fromArray(placed.matrices, 16 * copy);
      });
    }
  }

  /** Marks the warps about which a head ties, and looks through all others; null: none. */
  mark(head: three.Vector3 | null): void {
    const pitch = this.model.about.carpet.columnPitch;
    for (const { uniforms } of this.warps.map((one) => one.material)) {
      uniforms["marked"]?.value.set(head?.x ?? 0, head === null ? -1 : pitch / 2);
      if (uniforms["others"]) uniforms["others"].value = head === null ? 1 : OTHERS;
    }
  }

  /** Draws the yarn of the knots in a colour; null: in that of the theme. */
  dye(colour: string | null): void {
    for (const { yarn, material } of this.yarns)
      if (yarn.drive === "knot" && colour !== null) screenColour(colour, material.uniforms["colour"]?.value);
  }

  /** The room of the knots' yarn in a head, over a knot. */
  knot(): three.Box3 {
    const box = new three.Box3();
    for (const { drive, points } of this.model.about.yarns)
      if (drive === "knot") box.union(new three.Box3().setFromArray([...this.model.floats(points)]));
    return box;
  }

  paint(look: Look): void {
    for (const { material } of this.warps) screenColour(look.warp, material.uniforms["colour"]?.value);
    for (const { yarn, material } of this.yarns)
      screenColour(yarn.drive === "knot" ? look.pile : look.weft, material.uniforms["colour"]?.value);
  }

  /**
   * Size of a pixel at a distance of 1 [m].
   *
   * fine  warps thinner than a pixel cover a part of it: a processor takes long where many lie behind one another
   */
  setPixel(atOne: number, fine: boolean): void {
    for (const { uniforms } of this.materials) if (uniforms["pixel"]) uniforms["pixel"].value = atOne;
    for (const { material } of this.warps) {
      const looksThrough = material.uniforms["others"]?.value < 1;
      material.transparent = fine || looksThrough;
      material.depthWrite = !looksThrough;
    }
  }
}

/** The material of a thread with a line, (x, y, z) in turn. */
function threadMaterial(diameter: number, line: Float32Array): three.ShaderMaterial {
  return new three.ShaderMaterial({
    defines: { POINTS: line.length / 3 },
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      radius: { value: diameter / 2 },
      pixel: { value: 1e-3 },
      line: { value: line },
      marked: { value: new three.Vector2(0, -1) },
      others: { value: 1 },
      cap: { value: 0 },
      colour: { value: new three.Color() },
    },
    side: three.DoubleSide,
    clipping: true,
  });
}

function threadMesh(geometry: three.BufferGeometry, material: three.Material): three.Mesh {
  const mesh = new three.Mesh(geometry, material);
  mesh.matrixAutoUpdate = false;
  mesh.frustumCulled = false;
  return mesh;
}

const CORNERS = 4;

/**
 * Ribbons of threads beside each other, four corners for each segment: x from edge to edge, y from its beginning to its
 * end.
 *
 * They are no instances: a processor that draws takes as long for each instance as for a picture of its own.
 */
export function ribbons(across: ArrayLike<number>, segments: number): three.BufferGeometry {
  const geometry = new three.BufferGeometry();
  const all = across.length * segments;
  const each = (value: (k: number) => number[]) => Array.from({ length: all }, (_, k) => value(k)).flat();
  const corners = (value: number) => new Array<number>(CORNERS).fill(value);
  const give = (name: string, values: number[], size = 1) =>
    geometry.setAttribute(name, new three.Float32BufferAttribute(values, size));
  geometry.setIndex(each((k) => [0, 1, 2, 2, 1, 3].map((n) => CORNERS * k + n)));
  give(
    "position",
    each(() => [-1, 0, 0, 1, 0, 0, -1, 1, 0, 1, 1, 0]),
    3,
  );
  give(
    "shift",
    each((k) => corners(across[Math.floor(k / segments)] ?? 0)),
  );
  give(
    "segment",
    each((k) => corners(k % segments)),
  );
  return geometry;
}
