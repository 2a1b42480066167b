/** Warps as one mesh of lines, which the graphics processor lifts; wefts and the yarns of the knots. */
import * as three from "three";
import type { Look } from "./look";
import { type Angles, type Frames, type Placed, warpShares, yarnPoints } from "./motion";
import type { SceneModel, SceneYarn } from "./scene";

interface ShownYarn {
  yarn: SceneYarn;
  number: number;
  placed: Placed;
  points: Float32Array;
  lines: three.Line[];
}

export class Threads {
  readonly group = new three.Group();
  readonly materials: three.LineBasicMaterial[] = [];
  private readonly lift = { value: new three.Vector2() };
  private readonly warps: three.LineSegments;
  private readonly yarns: ShownYarn[] = [];

  constructor(
    private readonly model: SceneModel,
    frames: Frames,
  ) {
    this.warps = new three.LineSegments(warpGeometry(model), this.warpMaterial());
    this.warps.frustumCulled = false;
    this.group.add(this.warps);
    model.about.yarns.forEach((yarn, number) => {
      const placed = frames.byName.get(yarn.frame);
      if (placed !== undefined) this.addYarn(yarn, number, placed);
    });
    this.update({ row: 0, knot: 0 });
  }

  /** Number of warps that are drawn. */
  get count(): number {
    return this.model.about.warps.x[1];
  }

  update(angles: Angles): void {
    const [even, odd] = warpShares(this.model, angles.row);
    this.lift.value.set(even, odd);
    for (const { yarn, number, placed, points, lines } of this.yarns) {
      yarnPoints(this.model, number, angles[yarn.drive], points);
      lines.forEach((line, copy) => {
        line.matrix.fromArray(placed.matrices, 16 * copy);
      });
      const geometry = lines[0]?.geometry;
      const position = geometry?.getAttribute("position");
      if (position !== undefined) position.needsUpdate = true;
    }
  }

  paint(look: Look): void {
    const [warps, ...others] = this.materials;
    warps?.color.set(look.warp);
    others.forEach((material, k) => {
      material.color.set(this.yarns[k]?.yarn.drive === "knot" ? look.pile : look.weft);
    });
  }

  dispose(): void {
    this.warps.geometry.dispose();
    for (const { lines } of this.yarns) lines[0]?.geometry.dispose();
    for (const material of this.materials) material.dispose();
  }

  private warpMaterial(): three.LineBasicMaterial {
    const material = new three.LineBasicMaterial();
    material.onBeforeCompile = (shader) => {
      shader.uniforms["shares"] = this.lift;
      shader.vertexShader = `attribute float lifted;\nattribute float odd;\nuniform vec2 shares;\n${shader.vertexShader}`;
      shader.vertexShader = shader.vertexShader.replace(
        "#include <begin_vertex>",
        "#include <begin_vertex>\ntransformed.z += lifted * mix(shares.x, shares.y, odd);",
      );
    };
    this.materials.push(material);
    return material;
  }

  private addYarn(yarn: SceneYarn, number: number, placed: Placed): void {
    const points = new Float32Array(3 * yarn.number);
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(points, 3));
    const material = new three.LineBasicMaterial();
    this.materials.push(material);
    const lines = Array.from({ length: placed.count }, () => {
      const line = new three.Line(geometry, material);
      line.matrixAutoUpdate = false;
      line.frustumCulled = false;
      return line;
    });
    this.group.add(...lines);
    this.yarns.push({ yarn, number, placed, points, lines });
  }
}

/** Every warp's line as segments; each point with its lift [m] and the parity of its warp. */
function warpGeometry(model: SceneModel): three.BufferGeometry {
  const { warps } = model.about;
  const [x, line] = [model.floats(warps.x), model.floats(warps.line)];
  const [shaft, odd] = [model.integers(warps.shaft), model.integers(warps.odd)];
  const count = line.length / 2;
  const points: number[] = [];
  const lifted: number[] = [];
  const parity: number[] = [];
  for (let warp = 0; warp < x.length; warp++) {
    const own = shaft[warp] ?? 0;
    const path = Array.from({ length: count }, (_, k) => k).filter((k) => {
      const number = warps.lifted.indexOf(k);
      return number < 0 || number === own;
    });
    for (let k = 0; k + 1 < path.length; k++)
      for (const index of [path[k] ?? 0, path[k + 1] ?? 0]) {
        points.push(x[warp] ?? 0, line[2 * index + 1] ?? 0, line[2 * index] ?? 0);
        lifted.push(warps.lifted[own] === index ? (warps.lifts[own] ?? 0) : 0);
        parity.push(odd[warp] ?? 0);
      }
  }
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", new three.Float32BufferAttribute(points, 3));
  geometry.setAttribute("lifted", new three.Float32BufferAttribute(lifted, 1));
  geometry.setAttribute("odd", new three.Float32BufferAttribute(parity, 1));
  return geometry;
}
