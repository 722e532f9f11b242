// Light or dark: the reader's choice on the page, else the system's. The style sheet follows the
// `data-theme` attribute by itself; whatever is drawn on a canvas subscribes here to be redrawn.
// Paper is white and narrow: before printing the page turns light and takes the width of a sheet.

export type Theme = "auto" | "light" | "dark";

const system_dark = matchMedia("(prefers-color-scheme: dark)");
const redraws: (() => void)[] = [];
let chosen: Theme = "auto";

function apply(theme: Theme): void {
  document.documentElement.dataset["theme"] = theme;
  for (const redraw of redraws) redraw();
}

export function choose_theme(theme: Theme): void {
  chosen = theme;
  apply(theme);
}

export function is_dark(): boolean {
  const theme = document.documentElement.dataset["theme"];
  return theme === "dark" || (theme !== "light" && system_dark.matches);
}

export function on_theme_change(redraw: () => void): void {
  redraws.push(redraw);
}

export function follow_system_and_printer(): void {
  system_dark.addEventListener("change", () => apply(chosen));
  addEventListener("beforeprint", () => {
    document.documentElement.dataset["printing"] = "";
    apply("light");
  });
  addEventListener("afterprint", () => {
    delete document.documentElement.dataset["printing"];
    apply(chosen);
  });
}
