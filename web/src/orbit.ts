// Turning a scene by pointer or keys: the state of the eye, and the events that change it. Scenes
// have z up; the eye looks at the origin.

export interface Eye {
  /** Radians around z; 0 looks along -x. */
  yaw: number;
  /** Radians above the xy plane, within a right angle. */
  pitch: number;
  /** 1 shows the whole scene, 2 doubles its size. */
  zoom: number;
}

const kPitchLimit = Math.PI / 2 - 0.01;
const kKeyStep = Math.PI / 36;

/** Changes `eye` on drag, arrow keys, + and -, and the wheel while `element` has the focus. */
export function orbit(element: HTMLElement, eye: Eye, on_change: () => void): void {
  const turn = (yaw: number, pitch: number): void => {
    eye.yaw += yaw;
    eye.pitch = Math.max(-kPitchLimit, Math.min(kPitchLimit, eye.pitch + pitch));
    on_change();
  };
  const zoom = (factor: number): void => {
    eye.zoom = Math.max(0.5, Math.min(6, eye.zoom * factor));
    on_change();
  };
  const keys: Record<string, () => void> = {
    ArrowLeft: () => turn(-kKeyStep, 0),
    ArrowRight: () => turn(kKeyStep, 0),
    ArrowUp: () => turn(0, kKeyStep),
    ArrowDown: () => turn(0, -kKeyStep),
    "+": () => zoom(1.15),
    "-": () => zoom(1 / 1.15),
  };
  element.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  element.addEventListener("pointerdown", (event) => element.setPointerCapture(event.pointerId));
  element.addEventListener("pointermove", (event) => {
    if (!element.hasPointerCapture(event.pointerId)) return;
    const per_pixel = Math.PI / Math.max(1, element.clientWidth);
    turn(-event.movementX * per_pixel, event.movementY * per_pixel);
  });
  element.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== element) return;
      event.preventDefault();
      zoom(Math.exp(-event.deltaY / 500));
    },
    { passive: false },
  );
}
