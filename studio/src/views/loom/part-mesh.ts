/** A part in the picture: its copies as instances, as fine as the picture needs. */
import * as three from "three";
import { dyes } from "./cloth";
import { oddFrom, spacingOf, strideFor, thinned } from "./crowd";
import { Edges } from "./edges";
import { type Light, screenColour } from "./light";
import { colourOf, finishOf, isRoom, type Look } from "./look";
import type { Placed } from "./motion";
import { failures, type SceneModel, type ScenePart } from "./scene";
import { solidMaterial } from "./solid-material";
import { type Tool, toolOf } from "./tools";
import { levelFor } from "./views";

/** Copies of a part from which on only those that are needed are drawn. */
const CROWD = 64;

/** Deviation of a solid from the part that is not seen [px]. */
const COARSE = 1.3;

/** Neighbours of a crowd are nearer to one another than this where their edges would be all that is seen [px]. */
const DENSE = 8;

/** How much is seen of a room that is kept free, and at least of what is marked. */
const ROOM = 0.25;
const MARKED = 0.55;

/** Of a part with the room around it [kg/m3]. */
const BOX_DENSITY = 300;

/** Copies that are looked at for the box of a part. */
const MOST_BOXED = 9;

export class PartMesh {
  readonly mesh: three.InstancedMesh<three.BufferGeometry, three.ShaderMaterial>;
  readonly edges: Edges;
  /** Where the part is moved when the loom is exploded, for the factor 1 [m]. */
  readonly apart = new three.Vector3();
  /** The tool of a head that it is of. */
  readonly tool: Tool | undefined;
  /** Whether it is left out of the picture. */
  hidden = false;
  private readonly levels: three.BufferGeometry[];
  private readonly sphere: three.Sphere;
  /** The matrices of all copies of a crowd; of others those that are drawn. */
  private readonly all: Float32Array;
  private readonly spacing: number;
  private anchor: three.Vector3 | null = null;

  constructor(
    readonly part: ScenePart,
    readonly placed: Placed,
    model: SceneModel,
    light: Light,
  ) {
    this.levels = part.solids.map((solid) => {
      const geometry = new three.BufferGeometry();
      geometry.setAttribute("position", new three.BufferAttribute(model.floats(solid.points), 3));
      geometry.setIndex(new three.BufferAttribute(model.integers(solid.triangles), 1));
      geometry.computeBoundingSphere();
      geometry.computeBoundingBox();
      return geometry;
    });
    this.mesh = new three.InstancedMesh(this.finest, solidMaterial(light, finishOf(part)), placed.count);
    this.mesh.name = part.name;
    this.tool = toolOf(model.about, placed);
    if (model.about.dyed.includes(part.ids[0])) this.dye(dyes(model));
    this.mesh.frustumCulled = false;
    this.edges = new Edges(this.mesh.instanceMatrix, this.mesh.material.uniforms["colour"] as three.IUniform);
    this.sphere = this.finest.boundingSphere ?? new three.Sphere();
    this.spacing = spacingOf(placed.matrices, placed.count);
    this.all = this.isCrowd ? placed.matrices.slice() : (this.mesh.instanceMatrix.array as Float32Array);
  }

  get failed(): boolean {
    return failures(this.part).length > 0;
  }

  /** Frees what is not in the scene: its material is. */
  dispose(): void {
    for (const level of this.levels) level.dispose();
    this.mesh.dispose();
  }

  /** Writes where the copies are; of a crowd those that are drawn are chosen for each picture. */
  arrange(exploded: number): void {
    this.all.set(this.placed.matrices);
    if (exploded > 0)
      for (let k = 0; k < this.placed.count; k++)
        this.apart.toArray().forEach((shift, axis) => {
          this.all[16 * k + 12 + axis] = (this.all[16 * k + 12 + axis] ?? 0) + exploded * shift;
        });
    this.changed();
  }

  /**
   * Takes the coarsest solid that deviates by less than a pixel, and of a crowd the copies in view, the nearest first.
   *
   * pixel  size of one where the camera looks [m]        right  the camera stands on the right
   * most   copies of a crowd that are drawn; of more, some are drawn wider in their stead
   * fine   with edges
   */
  detail(pixel: number, view: three.Frustum, right: boolean, most: number, fine: boolean): void {
    const deviations = this.part.solids.map((solid) => solid.deviation);
    this.mesh.geometry = this.levels[levelFor(deviations, COARSE * pixel)] ?? this.finest;
    this.mesh.visible = !this.hidden;
    if (this.isCrowd) this.choose(pixel, view, right, most);
    if (fine && !this.hidden && !(this.isCrowd && this.spacing < DENSE * pixel))
      this.edges.show(this.mesh.geometry, this.mesh.count);
    else this.edges.hide();
  }

  private choose(pixel: number, view: three.Frustum, right: boolean, most: number): void {
    const into = this.mesh.instanceMatrix.array as Float32Array;
    const draw = (stride: number) => {
      const reach = this.sphere.radius + this.sphere.center.length() + stride * this.spacing;
      const seen = new three.Sphere(new three.Vector3(), reach);
      return thinned(this.all, this.placed.count, stride, right, into, (x, y, z) => {
        seen.center.set(x, y, z);
        return view.intersectsSphere(seen);
      });
    };
    const stride = strideFor(this.spacing, pixel);
    this.mesh.count = draw(stride);
    if (this.mesh.count > most) this.mesh.count = draw(oddFrom((stride * this.mesh.count) / most));
    this.changed();
  }

  /** Gives the copies colours, one after the other. */
  private dye(colours: readonly string[]): void {
    const own = new three.Color();
    for (let k = 0; k < this.placed.count && colours.length > 0; k++) {
      screenColour(colours[k % colours.length] as string, own);
      this.mesh.setColorAt(k, own);
    }
  }

  /** Colours the part; chosen: it is marked, share: how much is seen of it, 1 where it is not looked through. */
  paint(look: Look, chosen: boolean, share: number): void {
    const { material } = this.mesh;
    const { colour, opacity } = material.uniforms;
    const own = this.mesh.instanceColor === null ? colourOf(this.part, look, this.tool) : "#ffffff";
    screenColour(chosen ? look.chosen : this.failed ? look.failed : own, colour?.value);
    const least = isRoom(this.part) ? Math.min(share, ROOM) : share;
    const clear = least < 1;
    if (opacity) opacity.value = clear && (chosen || this.failed) ? MARKED : least;
    material.transparent = clear;
    material.depthWrite = !clear;
    const line = this.edges.lines.material.uniforms["opacity"];
    if (line) line.value = Math.min(2 * least, 1);
  }

  /** Whether it throws a shadow. */
  get solid(): boolean {
    return !this.mesh.material.transparent;
  }

  /** The box of the copies, into `box`. */
  boxed(box: three.Box3): three.Box3 {
    box.makeEmpty();
    const [matrix, own, last] = [new three.Matrix4(), new three.Box3(), this.placed.count - 1];
    const steps = Math.min(MOST_BOXED - 1, last);
    for (let k = 0; k <= steps; k++) {
      matrix.fromArray(this.all, 16 * (steps === 0 ? 0 : Math.round((k * last) / steps)));
      if (this.finest.boundingBox) box.union(own.copy(this.finest.boundingBox).applyMatrix4(matrix));
    }
    return box;
  }

  /** A point on a copy, by default the middle one, as near as can be to its middle. */
  shownAt(copy = this.placed.count >> 1): three.Vector3 {
    this.anchor ??= innermost(this.finest);
    const matrix = new three.Matrix4().fromArray(this.all, 16 * copy);
    return this.anchor.clone().applyMatrix4(matrix);
  }

  /** Its mass, or about that of its box where it is not weighed [kg]. */
  get weight(): number {
    const size = this.finest.boundingBox?.getSize(new three.Vector3()) ?? new three.Vector3();
    return this.part.mass ?? BOX_DENSITY * size.x * size.y * size.z;
  }

  private get isCrowd(): boolean {
    return this.placed.count > CROWD && Number.isFinite(this.spacing);
  }

  private get finest(): three.BufferGeometry {
    return this.levels[0] as three.BufferGeometry;
  }

  private changed(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}

/** The middle of the triangle that is nearest to the middle of the box. */
function innermost(geometry: three.BufferGeometry): three.Vector3 {
  const [middle, found, corner, at] = [0, 1, 2, 3].map(() => new three.Vector3()) as [
    three.Vector3,
    three.Vector3,
    three.Vector3,
    three.Vector3,
  ];
  geometry.boundingBox?.getCenter(middle);
  const [position, index] = [geometry.getAttribute("position"), geometry.getIndex()];
  let least = Number.POSITIVE_INFINITY;
  for (let k = 0; k + 2 < (index?.count ?? 0); k += 3) {
    at.set(0, 0, 0);
    for (let n = 0; n < 3; n++)
      at.addScaledVector(corner.fromBufferAttribute(position, index?.getX(k + n) ?? 0), 1 / 3);
    const far = at.distanceToSquared(middle);
    if (far >= least) continue;
    least = far;
    found.copy(at);
  }
  return found;
}
