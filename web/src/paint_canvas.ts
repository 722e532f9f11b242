// Paints a diamond without WebGL: every ball is a shaded disc, the farthest first.

import {
  direction,
  kBallColour,
  kDistance,
  kFieldOfView,
  layer_light,
  type Painter,
  type Scene,
} from "./scene.ts";

const kDiscPixels = 96;

/** A lit ball of the given brightness, drawn once and copied for each. */
function disc(light: number): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = kDiscPixels;
  const context = canvas.getContext("2d");
  if (!context) throw new Error("this browser draws neither WebGL nor 2D canvases");
  const half = kDiscPixels / 2;
  const gradient = context.createRadialGradient(
    half * 0.75,
    half * 0.6,
    half * 0.1,
    half,
    half,
    half,
  );
  const channels = [1, 3, 5].map((at) => parseInt(kBallColour.slice(at, at + 2), 16) * light);
  const shade = (factor: number): string =>
    `rgb(${channels.map((c) => Math.min(255, c * factor)).join(" ")})`;
  gradient.addColorStop(0, shade(1.3));
  gradient.addColorStop(0.6, shade(0.95));
  gradient.addColorStop(1, shade(0.5));
  context.fillStyle = gradient;
  context.arc(half, half, half - 0.5, 0, 2 * Math.PI);
  context.fill();
  return canvas;
}

export function canvas_painter(scene: Scene): Painter {
  const canvas = document.createElement("canvas");
  const layers = 1 + scene.balls.reduce((most, ball) => Math.max(most, ball.layer), 0);
  const discs = Array.from({ length: layers }, (_, layer) => disc(layer_light(layer)));
  return {
    canvas,
    paint(eye, width, height) {
      const ratio = Math.min(2, devicePixelRatio);
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      const context = canvas.getContext("2d");
      const focal = ((canvas.height / 2) * eye.zoom) / Math.tan(kFieldOfView / 2);
      const [fx, fy, fz] = direction(eye);
      const right_x = -Math.sin(eye.yaw);
      const right_y = Math.cos(eye.yaw);
      const placed = scene.balls.map(({ x, y, z, layer }) => {
        const depth = kDistance - (x * fx + y * fy + z * fz);
        const across = x * right_x + y * right_y;
        const up = z * Math.cos(eye.pitch) - (x * Math.cos(eye.yaw) + y * Math.sin(eye.yaw)) * fz;
        return { depth, across, up, layer };
      });
      placed.sort((a, b) => b.depth - a.depth);
      for (const { depth, across, up, layer } of placed) {
        const scale = focal / depth;
        const size = 2 * scene.radius * scale;
        const left = canvas.width / 2 + across * scale - size / 2;
        const top = canvas.height / 2 - up * scale - size / 2;
        context?.drawImage(discs[layer] as HTMLCanvasElement, left, top, size, size);
      }
    },
  };
}
