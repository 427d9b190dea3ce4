// Pages in headless Chromium: what HTML alone does not show. scripts/test-pages makes the folder PAGES.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const folder = process.env.PAGES;
const profile = mkdtempSync(join(tmpdir(), "veritrack-pages-"));
let context;

before(async () => {
  context = await chromium.launchPersistentContext(profile, {
    executablePath: "/usr/bin/chromium",
    headless: true,
    offline: true,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync"],
  });
});
after(async () => {
  await context.close();
  rmSync(profile, { recursive: true, force: true });
});

// The page of a file, with all that it says and asks for.
async function open(file, { width = 1000, scheme = "light", media = "screen" } = {}) {
  const page = await context.newPage();
  const said = [];
  const requests = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(error.message));
  page.on("dialog", (dialog) => { said.push(`dialog ${dialog.message()}`); dialog.dismiss(); });
  page.on("request", (request) => { if (!request.url().startsWith("data:")) requests.push(request.url()); });
  await page.setViewportSize({ width, height: 900 });
  await page.emulateMedia({ colorScheme: scheme, media });
  const address = pathToFileURL(join(folder, file)).href;
  await page.goto(address);
  return { page, said, requests, address };
}

const kPages = ["certificate/certificate.html", "far/certificate.html", "single/certificate.html", "kkl/certificate.html",
  "model/certificate.html", "hostile/certificate.html", "map/map.html", "model-map/map.html", "report/report.html"];

for (const file of kPages) {
  test(`${file}: no errors, no requests, formulas rendered, figures visible`, async () => {
    const { page, said, requests, address } = await open(file);
    const unfold = page.locator("details");
    for (const one of await unfold.all()) await one.evaluate((element) => { element.open = true; });
    assert.deepEqual(said, []);
    assert.deepEqual(requests, [address]);
    const math = await page.locator(".math").count();
    assert.equal(await page.locator(".math.rendered .katex-html").count(), math);
    if (/^(certificate|far|single|kkl)\//.test(file)) assert.ok(math > 0);
    // Each font that a formula asks for is the one in the page.
    await page.evaluate(() => document.fonts.ready);
    const fonts = await page.evaluate(() => [...document.fonts].map((font) => font.status));
    assert.ok(!fonts.includes("error"), fonts.join());
    if (math > 0) assert.ok(fonts.includes("loaded"));
    for (const figure of await page.locator("figure svg").all()) {
      const box = await figure.boundingBox();
      assert.ok(box.width > 400 && box.height > 100, JSON.stringify(box));
      assert.ok((await figure.locator("title").first().textContent()).length > 10);
      assert.ok((await figure.locator("path").count()) > 3);
    }
    await page.close();
  });

  test(`${file}: at 400 px it does not scroll sideways, light and dark have contrast`, async () => {
    for (const scheme of ["light", "dark"]) {
      const { page } = await open(file, { width: 400, scheme });
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 400);
      // WCAG: 4.5 for text.
      const poor = await page.evaluate(() => {
        const luminance = (colour) => {
          const parts = colour.match(/[\d.]+/g).slice(0, 3).map((part) => part / 255)
            .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
          return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
        };
        const ground = (element) => {
          for (let one = element; one; one = one.parentElement) {
            const colour = getComputedStyle(one).backgroundColor;
            if (!/, 0\)$/.test(colour)) return colour;
          }
          return "rgb(255, 255, 255)";
        };
        return [...document.querySelectorAll("h1, h2, p, li, td, th, code, a, summary, button, figcaption, .verdict")]
          .filter((element) => !element.closest("svg"))
          .map((element) => {
            const pair = [luminance(getComputedStyle(element).color), luminance(ground(element))].sort((a, b) => b - a);
            return { what: element.tagName + element.className, contrast: (pair[0] + 0.05) / (pair[1] + 0.05) };
          })
          .filter((one) => !(one.contrast >= 4.5));
      });
      assert.deepEqual(poor, []);
      await page.close();
    }
  });
}

test("a design cannot run anything, nor mark its words as a verdict", async () => {
  const { page, said } = await open("hostile/certificate.html");
  assert.equal(await page.evaluate(() => globalThis.hostile), undefined);
  assert.deepEqual(said, []);
  const words = await page.locator("main").innerText();
  assert.match(words, /<script>globalThis\.hostile = 1<\/script>/);
  assert.equal(await page.locator(".verdict", { hasText: "hostile" }).count(), 0);
  await page.close();
});

test("a script that was put into a page does not run", async () => {
  const { page } = await open("certificate/certificate.html");
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "globalThis.injected = 1";
    document.body.append(script);
    const image = document.createElement("img");
    image.setAttribute("onerror", "globalThis.injected = 2");
    image.src = "https://example.org/x.png";
    document.body.append(image);
  });
  await page.waitForTimeout(200);
  assert.equal(await page.evaluate(() => globalThis.injected), undefined);
  await page.close();
});

test("the link to the published theorems unfolds them", async () => {
  const { page } = await open("certificate/certificate.html");
  const folded = page.locator("#published-theorems");
  assert.equal(await folded.evaluate((element) => element.open), false);
  await page.locator("main > p a[href='#published-theorems']").first().click();
  await page.waitForFunction(() => document.getElementById("published-theorems").open);
  await page.close();
});

for (const [file, cellWords] of [["map/map.html", /^Starts with a frequency error from (\S+) to (\S+) rad\/sample, a phase error from (\S+) to (\S+) rad /],
  ["model-map/map.html", /^Starts that deviate by (\S+) to (\S+) .*? and by (\S+) to (\S+) /]]) {
  test(`${file} answers pointer and keys, and zooms`, async () => {
    const { page, said } = await open(file);
    const svg = page.locator("figure.map svg");
    const values = page.locator("figure.map .values");
    await svg.scrollIntoViewIfNeeded();
    const map = JSON.parse(await page.locator("#values-0").textContent());
    // The cell that is told is the one under the pointer.
    const tell = async (shareX, shareY) => {
      const at = await page.evaluate(([x, y]) => {
        const picture = document.querySelector("figure.map svg");
        const { left, right, top, bottom } = JSON.parse(document.getElementById("values-0").textContent).plot;
        const point = new DOMPoint(left + x * (right - left), bottom - y * (bottom - top)).matrixTransform(picture.getScreenCTM());
        return [point.x, point.y];
      }, [shareX, shareY]);
      await page.mouse.move(...at);
      const found = cellWords.exec(await values.textContent());
      assert.ok(found, await values.textContent());
      const [x0, x1, y0, y1] = found.slice(1, 5).map(Number);
      const x = map.x.range[0] + shareX * (map.x.range[1] - map.x.range[0]);
      const y = map.y.range[0] + shareY * (map.y.range[1] - map.y.range[0]);
      assert.ok(x0 <= x && x <= x1 && y0 <= y && y <= y1, `${[x, y]} in ${[x0, x1, y0, y1]}`);
      return values.textContent();
    };
    const told = await tell(0.503, 0.507);
    assert.match(told, /proved/);
    assert.notEqual(await tell(0.153, 0.807), told);
    await page.mouse.move(1, 1);

    // By keys: each arrow to a neighbour, on both axes.
    const frame = page.locator("figure.map .frame");
    await frame.focus();
    await page.keyboard.press("Escape");
    assert.equal(await values.textContent(), map.invitation);
    const seen = new Set();
    for (const key of ["ArrowRight", "ArrowRight", "ArrowUp", "ArrowLeft", "ArrowDown", "ArrowDown"]) {
      await page.keyboard.press(key);
      seen.add(await values.textContent());
    }
    assert.ok(seen.size >= 4, [...seen].join("\n"));

    // Zoom by key and button; the pointer then finds the same cells in the larger picture.
    const width = () => svg.evaluate((element) => element.viewBox.baseVal.width);
    const whole = await width();
    await page.keyboard.press("+");
    assert.ok((await width()) < whole);
    await page.keyboard.press("0");
    assert.equal(await width(), whole);
    await page.getByRole("button", { name: "Zoom in" }).click();
    await page.getByRole("button", { name: "Zoom in" }).click();
    assert.ok((await width()) < 0.5 * whole);
    await page.getByRole("button", { name: "Show the whole map" }).click();
    assert.equal(await width(), whole);
    assert.equal(await tell(0.503, 0.507), told);
    assert.deepEqual(said, []);
    await page.close();
  });
}

test("on paper: black on white, the map without its buttons", async () => {
  const { page } = await open("map/map.html", { scheme: "dark", media: "print" });
  assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
  assert.equal(await page.locator("figure.map .bar").isVisible(), false);
  const pdf = await page.pdf({ preferCSSPageSize: true });
  assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
  await page.close();
});
