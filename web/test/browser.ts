// Starts the headless Chromium that the page tests drive, cut off from the network.

import { existsSync } from "node:fs";
import { type Browser, chromium, type Page } from "playwright-core";

const kPlaces = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

export function launch(...more: string[]): Promise<Browser> {
  const executablePath =
    process.env["HARPOON_CHROMIUM"] ?? kPlaces.find((path) => existsSync(path));
  if (!executablePath) throw new Error(`no Chromium: tried ${kPlaces.join(", ")}`);
  const gl = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return chromium.launch({ executablePath, args: ["--no-sandbox", ...gl, ...more] });
}

/**
 * Waits until the page has drawn what was asked of it so far, however slow the machine is: the page
 * draws in animation frames, and the second one from here begins after all that the first drew.
 */
export async function drawn(page: Page): Promise<void> {
  await page.evaluate(
    () =>
      new Promise((resolve) => {
        requestAnimationFrame(() => requestAnimationFrame(resolve));
      }),
  );
}

/** What a page did besides drawing: its complaints, and every address it asked for. */
export interface Watched {
  readonly page: Page;
  readonly complaints: string[];
  readonly requests: string[];
}

export async function open(
  browser: Browser,
  file: string,
  width = 1280,
  colorScheme: "light" | "dark" = "light",
): Promise<Watched> {
  const context = await browser.newContext({
    viewport: { width, height: 900 },
    colorScheme,
    offline: true,
    permissions: ["clipboard-read", "clipboard-write"],
  });
  const page = await context.newPage();
  const complaints: string[] = [];
  const requests: string[] = [];
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("console", (message) => {
    // Reading pixels back, as these tests do, makes the browser remark that it is slow.
    const remark = /GL Driver Message|willReadFrequently/.test(message.text());
    if (["error", "warning"].includes(message.type()) && !remark) complaints.push(message.text());
  });
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(`file://${file}`);
  await drawn(page);
  return { page, complaints, requests };
}
