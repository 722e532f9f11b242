// Reads what a canvas shows. Each function runs in the page.

import type { Locator } from "playwright-core";

/** How many pixels of the first canvas in `place` have the colour `rgb(r, g, b)`, within 3. */
export function count_colour(place: Locator, colour: string): Promise<number> {
  return place
    .locator("canvas")
    .first()
    .evaluate((element, wanted) => {
      const canvas = element as HTMLCanvasElement;
      const [r, g, b] = (wanted.match(/\d+/g) ?? []).map(Number) as [number, number, number];
      const context = canvas.getContext("2d");
      const pixels = context?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      let found = 0;
      for (let at = 0; at < pixels.length; at += 4) {
        const off = [r, g, b].map((c, n) => Math.abs(c - (pixels[at + n] ?? 0)));
        if (Math.max(...off) <= 3 && pixels[at + 3] === 255) ++found;
      }
      return found;
    }, colour);
}

/** The height of that colour's line above the plot's floor, at a share of its width: 0 to 1. */
export function line_height(plot: Locator, colour: string, share: number): Promise<number> {
  return plot.evaluate(
    (element, [wanted, at]) => {
      const canvas = element.querySelector("canvas") as HTMLCanvasElement;
      const over = element.querySelector(".u-over") as HTMLElement;
      const [r, g, b] = (String(wanted).match(/\d+/g) ?? []).map(Number) as [
        number,
        number,
        number,
      ];
      const x = Math.round(over.offsetLeft + over.clientWidth * Number(at));
      const column = canvas.getContext("2d")?.getImageData(x, 0, 1, canvas.height).data ?? [];
      const rows: number[] = [];
      for (let y = 0; y < canvas.height; ++y) {
        const off = [r, g, b].map((c, n) => Math.abs(c - (column[4 * y + n] ?? 0)));
        if (Math.max(...off) <= 3) rows.push(y);
      }
      const middle = rows.reduce((sum, y) => sum + y, 0) / rows.length;
      return 1 - (middle - over.offsetTop) / over.clientHeight;
    },
    [colour, share] as const,
  );
}

/** The share of a diamond's canvas that differs from its corner, and a hash of its pixels. */
export function painted(stage: Locator): Promise<{ share: number; hash: number }> {
  return stage.locator("canvas").evaluate((element) => {
    const source = element as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    copy.width = source.width;
    copy.height = source.height;
    const context = copy.getContext("2d") as CanvasRenderingContext2D;
    context.drawImage(source, 0, 0);
    const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
    let differing = 0;
    let hash = 0;
    for (let at = 0; at < pixels.length; at += 4) {
      const off = [0, 1, 2, 3].map((n) => Math.abs((pixels[at + n] ?? 0) - (pixels[n] ?? 0)));
      if (Math.max(...off) > 40) ++differing;
      hash = (Math.imul(hash, 31) + (pixels[at] ?? 0)) | 0;
    }
    return { share: (4 * differing) / pixels.length, hash };
  });
}
