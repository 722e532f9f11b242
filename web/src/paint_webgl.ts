// Paints a diamond with three.js: one instanced sphere, light from beside the eye.

import {
  AmbientLight,
  Color,
  DirectionalLight,
  InstancedMesh,
  Matrix4,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene as World,
  SphereGeometry,
  WebGLRenderer,
} from "three";
import {
  direction,
  kBallColour,
  kDistance,
  kFieldOfView,
  layer_light,
  type Painter,
  type Scene,
} from "./scene.ts";

/** Finer spheres for fewer of them: 37,881 are three million triangles. */
function sphere(balls: number, radius: number): SphereGeometry {
  const segments = balls > 4000 ? 8 : balls > 400 ? 18 : 48;
  return new SphereGeometry(radius, segments, Math.round(segments * 0.7));
}

function instances(scene: Scene): InstancedMesh {
  const { balls, radius } = scene;
  const mesh = new InstancedMesh(
    sphere(balls.length, radius),
    new MeshLambertMaterial(),
    balls.length,
  );
  const place = new Matrix4();
  balls.forEach((ball, n) => {
    mesh.setMatrixAt(n, place.makeTranslation(ball.x, ball.y, ball.z));
    mesh.setColorAt(n, new Color(kBallColour).multiplyScalar(layer_light(ball.layer)));
  });
  return mesh;
}

function make_renderer(): WebGLRenderer | undefined {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", {
    antialias: true,
    alpha: true,
    preserveDrawingBuffer: true,
  });
  if (!context) return undefined;
  return new WebGLRenderer({ canvas, context, alpha: true });
}

/** A painter, or nothing where the browser has no WebGL. Calls `on_lost` if it loses it later. */
export function webgl_painter(scene: Scene, on_lost: () => void): Painter | undefined {
  const renderer = make_renderer();
  if (!renderer) return undefined;
  const canvas = renderer.domElement;
  canvas.addEventListener("webglcontextlost", on_lost);
  const world = new World();
  const camera = new PerspectiveCamera((kFieldOfView * 180) / Math.PI, 1, 1, 2 * kDistance);
  camera.up.set(0, 0, 1);
  const sun = new DirectionalLight("white", 2.4);
  sun.position.set(-0.6, 1, 0.8);
  camera.add(sun);
  world.add(instances(scene), new AmbientLight("white", 1.1), camera);
  return {
    canvas,
    paint(eye, width, height) {
      renderer.setPixelRatio(Math.min(2, devicePixelRatio));
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.zoom = eye.zoom;
      camera.position.set(...direction(eye)).multiplyScalar(kDistance);
      camera.lookAt(0, 0, 0);
      camera.updateProjectionMatrix();
      renderer.render(world, camera);
    },
  };
}
