// The diamond of the paper's Figure 4: spheres at the lattice points |i|+|j|+|k| <= hmax.

export type Point = readonly [i: number, j: number, k: number];

function for_each_point(hmax: number, visit: (i: number, j: number, k: number) => void): void {
  for (let i = -hmax; i <= hmax; ++i) {
    const j_max = hmax - Math.abs(i);
    for (let j = -j_max; j <= j_max; ++j) {
      const k_max = j_max - Math.abs(j);
      for (let k = -k_max; k <= k_max; ++k) visit(i, j, k);
    }
  }
}

export function count_points(hmax: number): number {
  let points = 0;
  for_each_point(hmax, () => ++points);
  return points;
}

export function diamond_points(hmax: number): Point[] {
  const points: Point[] = [];
  for_each_point(hmax, (i, j, k) => points.push([i, j, k]));
  return points;
}
