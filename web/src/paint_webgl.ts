// Paints a diamond with three.js. Every ball is one instance of a square that faces the eye, on
// which the shader draws a lit sphere: round at any size, and 37,881 of them turn smoothly even
// where a processor plays the graphics card.

import {
  Color,
  InstancedMesh,
  Matrix4,
  PerspectiveCamera,
  PlaneGeometry,
  Scene as World,
  ShaderMaterial,
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

const kVertexShader = `
  uniform float radius;
  varying vec2 at;
  varying vec3 tint;
  void main() {
    at = position.xy;
    tint = instanceColor;
    vec4 centre = modelViewMatrix * instanceMatrix * vec4(0.0, 0.0, 0.0, 1.0);
    gl_Position = projectionMatrix * (centre + vec4(position.xy * radius, 0.0, 0.0));
  }`;

const kFragmentShader = `
  varying vec2 at;
  varying vec3 tint;
  const vec3 sun = vec3(-0.42, 0.70, 0.58);
  void main() {
    float reach = length(at);
    float cover = clamp((1.0 - reach) / fwidth(reach) + 0.5, 0.0, 1.0);
    if (cover == 0.0) discard;
    vec3 normal = vec3(at, sqrt(max(0.0, 1.0 - reach * reach)));
    gl_FragColor = vec4(tint * (0.34 + 0.76 * max(0.0, dot(normal, sun))), cover);
    #include <colorspace_fragment>
  }`;

function instances(scene: Scene): InstancedMesh {
  const material = new ShaderMaterial({
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    uniforms: { radius: { value: scene.radius } },
    alphaToCoverage: true,
  });
  const mesh = new InstancedMesh(new PlaneGeometry(2, 2), material, scene.balls.length);
  const place = new Matrix4();
  scene.balls.forEach((ball, n) => {
    mesh.setMatrixAt(n, place.makeTranslation(ball.x, ball.y, ball.z));
    mesh.setColorAt(n, new Color(kBallColour).multiplyScalar(layer_light(ball.layer)));
  });
  mesh.frustumCulled = false;
  return mesh;
}

function make_renderer(): WebGLRenderer | undefined {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", {
    antialias: true,
    alpha: false,
    preserveDrawingBuffer: true,
  });
  return context ? new WebGLRenderer({ canvas, context }) : undefined;
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
  world.add(instances(scene), camera);
  return {
    canvas,
    paint(eye, width, height) {
      const ratio = Math.min(2, devicePixelRatio);
      if (
        canvas.width !== Math.floor(width * ratio) ||
        canvas.height !== Math.floor(height * ratio)
      ) {
        renderer.setDrawingBufferSize(width, height, ratio);
      }
      const place = canvas.parentElement ?? document.body;
      renderer.setClearColor(new Color(getComputedStyle(place).backgroundColor));
      camera.aspect = width / height;
      camera.zoom = eye.zoom;
      camera.position.set(...direction(eye)).multiplyScalar(kDistance);
      camera.lookAt(0, 0, 0);
      camera.updateProjectionMatrix();
      renderer.render(world, camera);
    },
  };
}
