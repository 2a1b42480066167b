/** A picture with smooth edges where no graphics card smooths them: drawn with several samples a pixel, then shown. */
import * as three from "three";

const SAMPLES = 4;

export class Smooth {
  private readonly target = new three.WebGLRenderTarget(1, 1, { samples: SAMPLES });
  private readonly scene = new three.Scene();
  private readonly camera = new three.OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly sheet: three.Mesh<three.PlaneGeometry, three.ShaderMaterial>;

  constructor() {
    const material = new three.ShaderMaterial({
      vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
      fragmentShader:
        "uniform sampler2D picture; varying vec2 at; void main() { gl_FragColor = texture2D(picture, at); }",
      uniforms: { picture: { value: this.target.texture } },
      depthTest: false,
    });
    this.sheet = new three.Mesh(new three.PlaneGeometry(2, 2), material);
    this.sheet.frustumCulled = false;
    this.scene.add(this.sheet);
  }

  render(renderer: three.WebGLRenderer, scene: three.Scene, camera: three.Camera): void {
    const { width, height } = renderer.getDrawingBufferSize(new three.Vector2());
    this.target.setSize(width, height);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.scene, this.camera);
  }

  dispose(): void {
    this.target.dispose();
    this.sheet.geometry.dispose();
    this.sheet.material.dispose();
  }
}
