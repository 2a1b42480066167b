/** Warps, wefts and yarns of knots: ribbons as wide as the thread, a pixel at least, that face the camera. */
import * as three from "three";
import { screenColour } from "./light";
import type { Look } from "./look";
import { type Angles, type Frames, type Placed, warpShares, yarnPoints } from "./motion";
import type { Drive, SceneModel } from "./scene";

/** A segment of a thread from `from` to `to`; of a warp, its ends are lifted by shares of their lifts. */
const VERTEX = `
#define NEIGHBOURS 60.0
#include <clipping_planes_pars_vertex>
attribute vec3 from;
attribute vec3 to;
attribute vec2 lifts;
attribute float odd;
uniform float radius;
uniform float pixel;
uniform vec2 shares;
uniform vec2 marked;
uniform float cap;
varying float across;
varying float along;
varying float thick;
varying float mark;
varying float covered;
void main() {
  mark = step(abs(from.x - marked.x), marked.y);
  vec3 lift = vec3(0.0, 0.0, mix(shares.x, shares.y, odd));
  vec3 begin = (modelViewMatrix * vec4(from + lifts.x * lift, 1.0)).xyz;
  vec3 end = (modelViewMatrix * vec4(to + lifts.y * lift, 1.0)).xyz;
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
  if (abs(from.x - marked.x) > NEIGHBOURS * marked.y && marked.y > 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
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
  number: number;
  drive: Drive;
  placed: Placed;
  points: Float32Array;
  geometry: three.BufferGeometry;
  meshes: three.Mesh[];
  material: three.ShaderMaterial;
}

export class Threads {
  readonly group = new three.Group();
  private readonly warps: three.ShaderMaterial;
  private readonly yarns: ShownYarn[] = [];

  constructor(
    private readonly model: SceneModel,
    frames: Frames,
  ) {
    const { warps, yarns } = model.about;
    this.warps = threadMaterial(warps.diameter);
    this.group.add(threadMesh(warpSegments(model), this.warps));
    yarns.forEach((yarn, number) => {
      const placed = frames.byName.get(yarn.frame);
      if (placed === undefined) return;
      const points = new Float32Array(3 * yarn.number);
      const geometry = ribbons({ from: [[], 3], to: [[], 3] }, yarn.number - 1);
      const material = threadMaterial(yarn.diameter);
      if (material.uniforms["cap"]) material.uniforms["cap"].value = 1; // its bends are sharp
      const meshes = Array.from({ length: placed.count }, () => threadMesh(geometry, material));
      this.group.add(...meshes);
      this.yarns.push({ number, drive: yarn.drive, placed, points, geometry, meshes, material });
    });
    this.update({ row: 0, knot: 0 });
  }

  get materials(): three.ShaderMaterial[] {
    return [this.warps, ...this.yarns.map((one) => one.material)];
  }

  update(angles: Angles): void {
    this.warps.uniforms["shares"]?.value.set(...warpShares(this.model, angles.row));
    for (const { number, drive, placed, points, geometry, meshes } of this.yarns) {
      yarnPoints(this.model, number, angles[drive], points);
      spread(points, 3, geometry.getAttribute("from") as three.BufferAttribute);
      spread(points, 3, geometry.getAttribute("to") as three.BufferAttribute, 3);
      meshes.forEach((mesh, copy) => {
        mesh.matrix.fromArray(placed.matrices, 16 * copy);
      });
    }
  }

  /** Marks the warps about which a head ties, and looks through all others; null: none. */
  mark(head: three.Vector3 | null): void {
    const pitch = this.model.about.carpet.columnPitch;
    const { marked, others } = this.warps.uniforms;
    marked?.value.set(head?.x ?? 0, head === null ? -1 : pitch / 2);
    if (others) others.value = head === null ? 1 : OTHERS;
  }

  /** Draws the yarn of the knots in a colour; null: in that of the theme. */
  dye(colour: string | null): void {
    for (const { drive, material } of this.yarns)
      if (drive === "knot" && colour !== null) screenColour(colour, material.uniforms["colour"]?.value);
  }

  /** The room of the knots' yarn in a head, over a knot. */
  knot(): three.Box3 {
    const box = new three.Box3();
    for (const { drive, points } of this.model.about.yarns)
      if (drive === "knot") box.union(new three.Box3().setFromArray([...this.model.floats(points)]));
    return box;
  }

  paint(look: Look): void {
    screenColour(look.warp, this.warps.uniforms["colour"]?.value);
    for (const { drive, material } of this.yarns)
      screenColour(drive === "knot" ? look.pile : look.weft, material.uniforms["colour"]?.value);
  }

  /**
   * Size of a pixel at a distance of 1 [m].
   *
   * fine  warps thinner than a pixel cover a part of it: a processor takes long where many lie behind one another
   */
  setPixel(atOne: number, fine: boolean): void {
    for (const { uniforms } of this.materials) if (uniforms["pixel"]) uniforms["pixel"].value = atOne;
    const looksThrough = this.warps.uniforms["others"]?.value < 1;
    this.warps.transparent = fine || looksThrough;
    this.warps.depthWrite = !looksThrough;
  }
}

function threadMaterial(diameter: number): three.ShaderMaterial {
  return new three.ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: {
      radius: { value: diameter / 2 },
      pixel: { value: 1e-3 },
      shares: { value: new three.Vector2() },
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
 * Ribbons, four corners for each segment: x from edge to edge, y from its beginning to its end.
 *
 * They are no instances: a processor that draws takes as long for each instance as for a picture of its own.
 */
function ribbons(attributes: Record<string, [values: number[], size: number]>, segments: number): three.BufferGeometry {
  const geometry = new three.BufferGeometry();
  const corner = [-1, 0, 0, 1, 0, 0, -1, 1, 0, 1, 1, 0];
  const all = Array.from({ length: segments }, () => corner).flat();
  geometry.setAttribute("position", new three.Float32BufferAttribute(all, 3));
  geometry.setIndex(Array.from({ length: segments }, (_, k) => [0, 1, 2, 2, 1, 3].map((n) => CORNERS * k + n)).flat());
  for (const [name, [values, size]] of Object.entries(attributes)) {
    const attribute = new three.BufferAttribute(new Float32Array(CORNERS * segments * size), size);
    spread(values, size, attribute);
    geometry.setAttribute(name, attribute);
  }
  return geometry;
}

/** Gives the values of each segment to its corners. */
function spread(values: ArrayLike<number>, size: number, into: three.BufferAttribute, begin = 0): void {
  const array = into.array as Float32Array;
  for (let k = 0; k < array.length; k++)
    array[k] = values[begin + size * Math.floor(k / (CORNERS * size)) + (k % size)] ?? 0;
  into.needsUpdate = true;
}

/** Every warp's line as segments, with the lifts of their ends [m] and the parity of the warp. */
export function warpSegments(model: SceneModel): three.BufferGeometry {
  const { warps } = model.about;
  const [x, line] = [model.floats(warps.x), model.floats(warps.line)];
  const [shaft, odd] = [model.integers(warps.shaft), model.integers(warps.odd)];
  const [from, to, lifts, parity] = [[], [], [], []] as [number[], number[], number[], number[]];
  const point = (warp: number, k: number) => [x[warp] ?? 0, line[2 * k + 1] ?? 0, line[2 * k] ?? 0];
  for (let warp = 0; warp < x.length; warp++) {
    const own = shaft[warp] ?? 0;
    const others = warps.lifted.filter((_, number) => number !== own);
    const path = Array.from({ length: line.length / 2 }, (_, k) => k).filter((k) => !others.includes(k));
    const lift = (k: number) => (warps.lifted[own] === k ? (warps.lifts[own] ?? 0) : 0);
    for (const [n, k] of path.slice(0, -1).entries()) {
      const next = path[n + 1] ?? k;
      from.push(...point(warp, k));
      to.push(...point(warp, next));
      lifts.push(lift(k), lift(next));
      parity.push(odd[warp] ?? 0);
    }
  }
  return ribbons({ from: [from, 3], to: [to, 3], lifts: [lifts, 2], odd: [parity, 1] }, parity.length);
}
