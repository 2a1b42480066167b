/** Shadows of the sun: how far it sees, drawn from its side when something has moved. */
import * as three from "three";
import { DIRECTIONS, type Light } from "./light";

/** Texels across. */
const SIZE = 2048;

export class Shadow {
  /** Whether something has moved since it was drawn. */
  stale = true;

  private readonly sun = new three.OrthographicCamera();
  private readonly target: three.WebGLRenderTarget;
  private readonly faces = new three.MeshBasicMaterial({ side: three.DoubleSide, colorWrite: false });
  private readonly toTexture = new three.Matrix4().makeScale(0.5, 0.5, 0.5).setPosition(0.5, 0.5, 0.5);
  private texel = 0;

  constructor() {
    this.target = new three.WebGLRenderTarget(SIZE, SIZE, { depthTexture: new three.DepthTexture(SIZE, SIZE) });
  }

  /** Throws the shadows of what stands in a box. */
  fit(box: three.Box3): void {
    const { radius, center } = box.getBoundingSphere(new three.Sphere());
    Object.assign(this.sun, { left: -radius, right: radius, bottom: -radius, top: radius, near: 0, far: 2 * radius });
    this.sun.position
      .set(...DIRECTIONS.sun)
      .setLength(radius)
      .add(center);
    this.sun.lookAt(center);
    this.sun.updateProjectionMatrix();
    this.sun.updateMatrixWorld();
    this.texel = (2 * radius) / SIZE;
    this.stale = true;
  }

  /** Draws what throws shadows, where something has moved. */
  throw(renderer: three.WebGLRenderer, scene: three.Scene, hidden: three.Object3D[], cuts: three.Plane[]): void {
    if (!this.stale) return;
    this.stale = false;
    const seen = hidden.filter((one) => one.visible);
    for (const one of seen) one.visible = false;
    this.faces.clippingPlanes = cuts;
    const background = scene.background;
    scene.background = null;
    scene.overrideMaterial = this.faces;
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(scene, this.sun);
    renderer.setRenderTarget(null);
    scene.overrideMaterial = null;
    scene.background = background;
    for (const one of seen) one.visible = true;
  }

  /** Gives the shadows to the materials, for a camera; not shown: the sun shines everywhere. */
  light({ uniforms }: Light, camera: three.Camera, shown: boolean): void {
    uniforms.shadows.value = this.target.depthTexture;
    uniforms.shadowed.value = shown ? 3 * this.texel : 0;
    uniforms.toShadow.value
      .copy(this.toTexture)
      .multiply(this.sun.projectionMatrix)
      .multiply(this.sun.matrixWorldInverse)
      .multiply(camera.matrixWorld);
  }

  dispose(): void {
    this.target.dispose();
    this.target.depthTexture?.dispose();
    this.faces.dispose();
  }
}
