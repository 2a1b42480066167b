/** The carpet as a mesh: its texture moves down as rows are woven, and nothing is drawn beyond the first row. */
import * as three from "three";
import { chartPixels, ribbon } from "./cloth";
import type { SceneModel } from "./scene";

export class Cloth {
  readonly mesh: three.Mesh;
  readonly material: three.MeshLambertMaterial;
  private readonly texture: three.DataTexture;
  private readonly woven = { value: 0 };

  constructor(private readonly model: SceneModel) {
    const { carpet, chart } = model.about;
    const made = ribbon(model, carpet.pile / 2);
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(made.points, 3));
    const uv = made.uv.map((value, k) => (k % 2 === 0 ? value : -value / (carpet.rows * carpet.rowPitch)));
    geometry.setAttribute("uv", new three.BufferAttribute(uv, 2));
    geometry.setIndex(new three.BufferAttribute(made.triangles, 1));
    geometry.computeVertexNormals();
    this.texture = new three.DataTexture(chartPixels(model), chart?.columns ?? 1, chart?.rows ?? 1, three.RGBAFormat);
    this.texture.colorSpace = three.SRGBColorSpace;
    this.texture.generateMipmaps = true;
    this.texture.minFilter = three.LinearMipmapLinearFilter;
    this.texture.magFilter = three.NearestFilter;
    this.texture.needsUpdate = true;
    this.material = new three.MeshLambertMaterial({ map: this.texture, side: three.DoubleSide });
    this.material.onBeforeCompile = (shader) => {
      shader.uniforms["woven"] = this.woven;
      shader.vertexShader = shader.vertexShader.replace(
        "#include <uv_vertex>",
        "#include <uv_vertex>\nvMapUv.y += woven;",
      );
      shader.vertexShader = `uniform float woven;\n${shader.vertexShader}`;
      shader.fragmentShader = shader.fragmentShader.replace(
        "#include <map_fragment>",
        "if (vMapUv.y < 0.0) discard;\n#include <map_fragment>",
      );
    };
    this.mesh = new three.Mesh(geometry, this.material);
    this.mesh.frustumCulled = false;
    this.weave(carpet.rows);
  }

  /** Shows so many rows; the last one lies at the fell. */
  weave(rows: number): void {
    this.woven.value = rows / this.model.about.carpet.rows;
  }

  /** Frees what is not in the scene: geometry and material are. */
  dispose(): void {
    this.texture.dispose();
  }
}
