// The ticks of a logarithmic axis: grid lines at 1 to 9 times each power of ten, of which only some
// carry a number.

/** Every 1 to 9 times a power of ten within [min, max], or only the powers over many decades. */
export function log_ticks(min: number, max: number): number[] {
  const mantissas = max / min > 1e6 ? [1] : [1, 2, 3, 4, 5, 6, 7, 8, 9];
  const ticks: number[] = [];
  for (let power = Math.floor(Math.log10(min)); 10 ** power <= max; ++power) {
    ticks.push(...mantissas.map((mantissa) => Number(`${mantissa}e${power}`)));
  }
  return ticks.filter((tick) => tick >= min && tick <= max);
}

/** Whether a tick carries a number: powers of ten; 2 and 5 times them where a decade has room. */
export function is_labelled(tick: number, decade_pixels: number, label_pixels: number): boolean {
  const mantissa = Number(tick.toExponential().split("e")[0]);
  return (
    mantissa === 1 || ((mantissa === 2 || mantissa === 5) && decade_pixels * 0.3 > label_pixels)
  );
}
