// Opens a report as a reader does, from disk with the network off, and reads the drawn page: the
// one named by HARPOON_REPORT, or the template filled with sample.json. What is expected is worked
// out from the data inside the report, not from the page's own code.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import type { Locator, Page } from "playwright-core";
import { parse_report } from "../src/schema.ts";
import { drawn, launch, open } from "./browser.ts";
import { count_colour, line_height, painted } from "./pixels.ts";
import { data_of, fill, sample } from "./template.ts";

const folder = mkdtempSync(join(tmpdir(), "harpoon-page-"));
function write(name: string, page: string): string {
  writeFileSync(join(folder, name), page);
  return join(folder, name);
}

const file = process.env["HARPOON_REPORT"] || write("sample.html", fill(sample()));
const report = parse_report(JSON.stringify(data_of(readFileSync(file, "utf8"))));
const browser = await launch();
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

const kNs: Record<string, number> = { ns: 1, µs: 1e3, ms: 1e6, s: 1e9 };

/** The nanoseconds in a text such as "1.06 µs". */
function read_ns(text: string | null): number {
  const [number, unit] = (text ?? "").trim().split(" ");
  return Number(number?.replaceAll(",", "")) * (kNs[unit ?? ""] ?? NaN);
}

function assert_near(value: number, expected: number, share: number, what: string): void {
  assert.ok(
    Math.abs(value - expected) <= share * Math.abs(expected),
    `${what}: ${value}, not ${expected}`,
  );
}

const chart = (page: Page, id: string): Locator => page.locator(`#figure-${id}`);
const stroke = (entry: Locator): Promise<string> =>
  entry.locator(".sample").evaluate((svg) => getComputedStyle(svg).stroke);

/** Presses the legend so that only the n-th line of a figure is shown. */
async function isolate(entries: Locator, only: number): Promise<void> {
  await entries.evaluateAll((buttons, wanted) => {
    buttons.forEach((button, n) => {
      const shown = button.getAttribute("aria-pressed") === "true";
      if (shown !== (n === wanted)) (button as HTMLButtonElement).click();
    });
  }, only);
  await drawn(entries.page());
}

async function choose(figure: Locator, legend: string, value: string): Promise<void> {
  await figure.locator("fieldset", { hasText: legend }).locator(`input[value=${value}]`).check();
}

test("a report opens without complaint and asks nobody for anything", async () => {
  const { page, complaints, requests } = await open(browser, file);
  assert.deepEqual(complaints, []);
  assert.deepEqual(
    requests.filter((url) => !/^(data|blob):/.test(url)),
    [`file://${file}`],
  );
  assert.equal(await page.locator("h1").textContent(), report.title);
  assert.equal(await page.locator(".lead").textContent(), report.experiment);
  assert.equal(await page.locator(".error, .problem").count(), 0);
  const text = await page.locator("main").innerText();
  const said = [
    ...Object.values(report.machine).map(String),
    ...report.headlines.flatMap(({ value, label, detail }) => [value, label, detail]),
    report.load_text,
    report.commit,
    report.command,
  ];
  for (const part of said.concat(
    report.claims.flatMap((c) => Object.values(c)),
    report.notes,
  )) {
    const number = /^[\d.]+$/.test(part);
    assert.ok(number || text.includes(part), `the page does not say ${part}`);
  }
  await page.context().close();
});

test("the table shows every result, and names the modelled ones", async () => {
  const { page } = await open(browser, file);
  const rows = await page.locator(".results tbody tr:not(.batch)").allInnerTexts();
  assert.equal(rows.length, report.results.length);
  const cells = rows.map((row) => row.split("\t").map((cell) => cell.trim()));
  for (const result of report.results) {
    const found = cells.some(
      ([device, speedup, ns, , , threads]) =>
        device?.startsWith(`${result.device} ${result.precision}`) &&
        device.endsWith(result.modelled ? "modelled" : "measured") &&
        Number(threads) === result.threads &&
        Math.abs(Number(ns?.replaceAll(",", "")) / result.ns_per_pair - 1) < 0.006 &&
        Math.abs(parseFloat(speedup?.replaceAll(",", "") ?? "") - result.speedup_vs_ode) <=
          0.006 * result.speedup_vs_ode,
    );
    assert.ok(found, `no row for ${JSON.stringify(result)}`);
  }
  await page.context().close();
});

for (const scheme of ["light", "dark"] as const) {
  test(`every series is drawn in the colour of its legend entry (${scheme})`, async () => {
    const { page, complaints } = await open(browser, file, 1280, scheme);
    const measured = new Set<string>();
    const modelled = new Set<string>();
    for (const { id, series, references } of report.figures) {
      const entries = chart(page, id).locator(".legend-entry");
      assert.equal(await entries.count(), series.length + references.length);
      for (const [n, line] of [...series, ...references].entries()) {
        const entry = entries.nth(n);
        assert.ok((await entry.innerText()).includes(line.label));
        const colour = await stroke(entry);
        if ("modelled" in line) {
          (line.modelled ? modelled : measured).add(colour);
          assert.equal(/modelled/i.test(await entry.innerText()), line.modelled, line.label);
        }
        await isolate(entries, n);
        const pixels = await count_colour(chart(page, id), colour);
        assert.ok(pixels > 40, `${line.label} in figure ${id}: ${pixels} pixels of ${colour}`);
        await isolate(entries, -1);
        assert.equal(await count_colour(chart(page, id), colour), 0, `${line.label} did not go`);
      }
    }
    assert.ok([...modelled].every((colour) => !measured.has(colour)));
    assert.deepEqual(complaints, []);
    await page.context().close();
  });
}

test("pointer and keys read out values with units and spread", async () => {
  const { page } = await open(browser, file);
  for (const { id, series } of report.figures) {
    const figure = chart(page, id);
    const said = figure.locator(".legend .batch");
    const counts = [...new Set(series.flatMap((s) => s.points.map((p) => p.count)))];
    const check = async (per_collision: boolean): Promise<number> => {
      const count = Number((await said.innerText()).replace(/[^\d]/g, ""));
      assert.ok(counts.includes(count), `no batch of ${count}`);
      for (const [n, { label, points }] of series.entries()) {
        const point = points.find((p) => p.count === count);
        if (!point) continue;
        const entry = figure.locator(".legend-entry").nth(n);
        const ns = (point.total_us * 1000) / (per_collision ? count : 1);
        assert_near(
          read_ns(await entry.locator(".value").innerText()),
          ns,
          0.006,
          `${label} at ${count}`,
        );
        const spread = (await entry.locator(".spread").textContent()) ?? "";
        assert.equal(spread !== "", point.total_us_low < point.total_us_high, `spread of ${label}`);
        if (spread) {
          const high = (point.total_us_high * 1000) / (per_collision ? count : 1);
          assert_near(read_ns(spread.split("–")[1] ?? ""), high, 0.006, `${label}, upper end`);
        }
      }
      return count;
    };
    assert.equal(await check(false), Math.max(...counts));
    await figure.locator(".u-over").hover({ position: { x: 200, y: 90 } });
    await drawn(page);
    assert.ok((await check(false)) < Math.max(...counts), "the pointer moved nothing");
    await figure.locator(".plot").focus();
    await page.keyboard.press("Home");
    await drawn(page);
    assert.equal(await check(false), Math.min(...counts));
    await choose(figure, "y shows", "each");
    await check(true);
  }
  await page.context().close();
});

/** How far the drawn line has come at the second point, on the way from the first to the third. */
async function way(plot: Locator, colour: string, shares: readonly number[]): Promise<number> {
  const heights: number[] = [];
  for (const share of shares) heights.push(await line_height(plot, colour, share));
  const [first = NaN, second = NaN, third = NaN] = heights;
  return (second - first) / (third - first);
}

test("the switch between linear and log changes the drawn axes", async () => {
  const { page } = await open(browser, file);
  for (const { id, series } of report.figures) {
    const figure = chart(page, id);
    const entries = figure.locator(".legend-entry");
    const points = [...(series[0]?.points ?? [])].sort((a, b) => a.count - b.count);
    const last = points[points.length - 1];
    const from = points.find((p) => p.count >= 3 * (points[0]?.count ?? 0));
    const middle = points.find(
      (p) => p.count >= Math.sqrt((from?.count ?? 0) * (last?.count ?? 0)),
    );
    assert.ok(from && middle && last, "too few points to judge an axis by");
    const three = [from, middle, last];
    await isolate(entries, 0);
    const colour = await stroke(entries.first());
    for (const scale of ["log", "linear"] as const) {
      for (const axis of ["x axis", "y axis"]) await choose(figure, axis, scale);
      await page.mouse.move(0, 0);
      await drawn(page);
      const seen = scale === "log" ? Math.log : (value: number): number => value;
      const left = scale === "log" ? Math.log(points[0]?.count ?? 1) : 0;
      const shares = three.map((p) => (seen(p.count) - left) / (seen(last.count) - left));
      const [a = 0, b = 0, c = 0] = three.map((p) => seen(p.total_us));
      const share = await way(
        figure.locator(".plot"),
        colour,
        shares.map((s) => Math.min(s, 0.998)),
      );
      assert.ok(Math.abs(share - (b - a) / (c - a)) < 0.06, `figure ${id}, ${scale}: ${share}`);
      assert.ok(scale === "log" ? share > 0.3 : share < 0.3, `figure ${id}, ${scale}: ${share}`);
    }
  }
  await page.context().close();
});

for (const painter of ["webgl", "canvas"]) {
  test(`the diamonds are counted, drawn and turned (${painter})`, async () => {
    const own = await launch(...(painter === "canvas" ? ["--disable-3d-apis"] : []));
    try {
      const { page } = await open(own, file);
      assert.equal(await page.locator(".diamond").count(), report.diamonds.length);
      for (const [n, { hmax }] of report.diamonds.entries()) {
        const diamond = page.locator(".diamond").nth(n);
        const stage = diamond.locator(".stage");
        assert.equal(await stage.getAttribute("data-painter"), painter);
        const spheres = ((2 * hmax + 1) * (2 * hmax * hmax + 2 * hmax + 3)) / 3;
        const caption = await diamond.locator(".count").innerText();
        assert.equal(caption, `${spheres.toLocaleString("en-US")} spheres`);
        const before = await painted(stage);
        assert.ok(
          before.share > 0.2 && before.share < 0.7,
          `${before.share} of hMax ${hmax} is painted`,
        );
        await stage.focus();
        await page.keyboard.press("ArrowLeft");
        await drawn(page);
        const turned = await painted(stage);
        assert.notEqual(turned.hash, before.hash, "keys turn it");
        const box = await stage.boundingBox();
        assert.ok(box);
        await page.mouse.move(box.x + 60, box.y + 60);
        await page.mouse.down();
        await page.mouse.move(box.x + 120, box.y + 90);
        await page.mouse.up();
        await drawn(page);
        assert.notEqual((await painted(stage)).hash, turned.hash, "the pointer turns it");
      }
    } finally {
      await own.close();
    }
  });
}

test("dark and light follow the system until the reader chooses", async () => {
  const { page } = await open(browser, file, 1280, "dark");
  const brightness = (): Promise<number> =>
    page.evaluate(() => {
      const colour = getComputedStyle(document.documentElement).backgroundColor;
      return Math.max(...(colour.match(/\d+/g) ?? []).map(Number));
    });
  assert.ok((await brightness()) < 60);
  await page.locator("header input[value=light]").check();
  assert.ok((await brightness()) > 240);
  await page.locator("header input[value=auto]").check();
  await page.emulateMedia({ colorScheme: "light" });
  assert.ok((await brightness()) > 240);
  await page.context().close();
});

test("CSV files hold the data, and the command is copied", async () => {
  const { page } = await open(browser, file);
  const saved = async (button: Locator): Promise<string[]> => {
    const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
    return readFileSync(await download.path(), "utf8")
      .trimEnd()
      .split("\r\n");
  };
  const results = await saved(page.getByRole("button", { name: "Results as CSV" }));
  assert.equal(results.length, report.results.length + 1);
  assert.ok(results[1]?.includes(String(report.results[0]?.ns_per_pair)));
  for (const { id, series } of report.figures) {
    const rows = await saved(chart(page, id).getByRole("button", { name: "CSV" }));
    assert.equal(rows.length, 1 + series.reduce((sum, { points }) => sum + points.length, 0));
  }
  await page.getByRole("button", { name: "Copy" }).click();
  await page.getByText("copied").waitFor();
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), report.command);
  await page.context().close();
});

test("no width makes the page scroll sideways", async () => {
  for (const width of [360, 390, 700, 1024, 1600]) {
    const { page } = await open(browser, file, width);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    await page.context().close();
  }
});

test("on a telephone every speed-up is on the screen", async () => {
  const width = 390;
  const { page } = await open(browser, file, width);
  const inside = async (cell: Locator): Promise<boolean> => {
    const box = await cell.boundingBox();
    return box !== null && box.width > 0 && box.x >= 0 && box.x + box.width <= width;
  };
  const cells = await page.locator(".results td.speedup, .results th:nth-child(2)").all();
  assert.equal(cells.length, report.results.length + 1);
  for (const cell of cells) assert.ok(await inside(cell), await cell.innerText());
  const first = page.locator(".tile strong").first();
  const box = await first.boundingBox();
  assert.ok(box && (await inside(first)) && box.y + box.height <= 844, "the first headline");
  await page.context().close();
});

test("bad data is named on the page, which is never blank", async () => {
  const broken = sample() as {
    results: Record<string, unknown>[];
    diamonds: Record<string, unknown>[];
  };
  delete broken.results[0]?.["ns_per_pair"];
  const miscounted = sample() as typeof broken;
  (miscounted.diamonds[0] as Record<string, unknown>)["spheres"] = 26;
  const hostile = {
    ...(sample() as object),
    title: "</script><script>document.title = 'x'</script>",
  };
  const cases: [string, unknown, string, string][] = [
    [
      "broken",
      broken,
      ".problem",
      "results[0].ns_per_pair: expected a number above 0, it is missing",
    ],
    ["empty", null, ".problem", "This is the empty template: no data was written into it."],
    ["miscounted", miscounted, ".error", "The data says 26 spheres; the lattice has 25."],
    ["hostile", hostile, "h1", hostile.title],
  ];
  for (const [name, data, place, message] of cases) {
    const { page } = await open(browser, write(`${name}.html`, fill(data)));
    assert.ok((await page.locator(place).first().innerText()).includes(message), name);
    await page.context().close();
  }
});
