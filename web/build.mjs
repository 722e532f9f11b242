// Builds the page into one file, web/dist/report.template.html or the path given. Deterministic:
// the same sources and package-lock.json give the same bytes.

import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const kMarker = '<script type="application/json" id="harpoon-data">null</script>';
const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const occurrences = (text, part) => text.split(part).length - 1;

async function bundle(entry) {
  const result = await build({
    entryPoints: [here(entry)],
    absWorkingDir: here("."),
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: ["chrome123", "firefox120", "safari17.5"],
    charset: "utf8",
    legalComments: "none",
  });
  return result.outputFiles[0].text.trim();
}

async function licence(name) {
  const text = await readFile(here(`node_modules/${name}/LICENSE`), "utf8");
  return `Contains ${name}:\n${text.trim().replaceAll("--", "- -")}`;
}

const target = process.argv[2] ?? here("dist/report.template.html");
const parts = {
  "@STYLE@": await bundle("src/style.css"),
  "@SCRIPT@": await bundle("src/main.ts"),
  "@LICENCES@": [await licence("uplot"), await licence("three")].join("\n\n"),
};
let page = await readFile(here("src/page.html"), "utf8");
for (const [mark, text] of Object.entries(parts)) {
  if (occurrences(page, mark) !== 1) throw new Error(`src/page.html must hold ${mark} once`);
  page = page.replace(mark, () => text);
}
if (occurrences(page, kMarker) !== 1)
  throw new Error("the template must hold the data marker once");
if (occurrences(page, "</script") !== 2) throw new Error("a script would end inside the bundle");
await mkdir(dirname(target), { recursive: true });
await writeFile(target, page);
