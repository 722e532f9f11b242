// One diamond of Figure 4: counted, drawn, and turned by the reader.

import { h, on_resize } from "./dom.ts";
import { whole } from "./format.ts";
import { count_points, diamond_points } from "./lattice.ts";
import { type Eye, orbit } from "./orbit.ts";
import { canvas_painter } from "./paint_canvas.ts";
import { webgl_painter } from "./paint_webgl.ts";
import type { Painter, Scene } from "./scene.ts";
import type { Diamond } from "./schema.ts";
import { on_theme_change } from "./theme.ts";

function scene_of(diamond: Diamond): Scene {
  const { hmax, dsph, radius } = diamond;
  const spacing = 2 * radius + dsph;
  const scale = 1 / (hmax * spacing + radius);
  const at = (index: number): number => index * spacing * scale;
  const balls = diamond_points(hmax).map(([i, j, k]) => ({
    x: at(i),
    y: at(j),
    z: at(k),
    layer: hmax - Math.abs(i) - Math.abs(j) - Math.abs(k),
  }));
  return { balls, radius: radius * scale };
}

/** Puts a painter's canvas into `stage`, and a new one if WebGL goes away. */
function stage_scene(stage: HTMLElement, scene: Scene): void {
  const eye: Eye = { yaw: 0.5, pitch: 0.35, zoom: 1 };
  let painter: Painter;
  const paint = (): void => {
    const { clientWidth: width, clientHeight: height } = stage;
    if (width > 0 && height > 0) painter.paint(eye, width, height);
  };
  const use = (next: Painter, kind: string): void => {
    painter = next;
    stage.dataset["painter"] = kind;
    stage.replaceChildren(next.canvas);
  };
  const without_webgl = (): void => use(canvas_painter(scene), "canvas");
  const webgl = webgl_painter(scene, () => {
    without_webgl();
    paint();
  });
  if (webgl) use(webgl, "webgl");
  else without_webgl();
  let asked = false;
  orbit(stage, eye, () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      paint();
    });
  });
  on_resize(stage, paint);
  on_theme_change(paint);
}

/** The figure of one diamond, and the call that draws it once it is in the document. */
export function make_diamond(diamond: Diamond): { figure: HTMLElement; draw: () => void } {
  const { hmax, dsph, radius, spheres } = diamond;
  const counted = count_points(hmax);
  const name = `hMax = ${hmax}, dSph = ${dsph}`;
  const stage = h("div", {
    class: "stage",
    tabindex: "0",
    role: "img",
    "aria-label": `Diamond of ${whole(counted)} spheres, ${name}. Arrow keys turn it, + and - zoom`,
  });
  const wrong =
    counted === spheres
      ? undefined
      : h(
          "p",
          { class: "error", role: "alert" },
          `The data says ${whole(spheres)} spheres; the lattice has ${whole(counted)}.`,
        );
  const caption = h(
    "figcaption",
    {},
    h("strong", {}, name),
    h("span", { class: "count" }, `${whole(counted)} spheres`),
    h("span", { class: "soft" }, `radius ${radius} m`),
    wrong,
  );
  const figure = h("figure", { class: "diamond", "data-hmax": String(hmax) }, stage, caption);
  return { figure, draw: () => stage_scene(stage, scene_of(diamond)) };
}
