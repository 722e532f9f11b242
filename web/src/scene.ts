// What the two painters of a diamond share: the scene they are given and the camera they use, so
// that a reader without WebGL sees the same picture.

import type { Eye } from "./orbit.ts";

export interface Ball {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** 0 in the outermost layer of the diamond, growing inwards: inner balls are drawn darker. */
  readonly layer: number;
}

/** Balls of one radius, scaled so that the whole scene fits the unit sphere. */
export interface Scene {
  readonly balls: readonly Ball[];
  readonly radius: number;
}

export interface Painter {
  readonly canvas: HTMLCanvasElement;
  /** Draws the scene for a place of `width` by `height` CSS pixels, which the canvas fills. */
  paint(eye: Eye, width: number, height: number): void;
}

/** The vertical angle of view, radians, and the distance at which the unit sphere just fits it. */
export const kFieldOfView = Math.PI / 7;
export const kDistance = 1 / Math.sin(kFieldOfView / 2);

export const kBallColour = "#5b9bd5";

/** The share of the ball colour's brightness a layer is drawn with. */
export function layer_light(layer: number): number {
  return Math.max(0.45, 1 - 0.25 * layer);
}

/** The unit vector from the origin to the eye. */
export function direction(eye: Eye): [x: number, y: number, z: number] {
  const flat = Math.cos(eye.pitch);
  return [flat * Math.cos(eye.yaw), flat * Math.sin(eye.yaw), Math.sin(eye.pitch)];
}
