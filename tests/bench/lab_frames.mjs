// How many frames a second the live laboratory draws while a slider moves, in headless Chromium without a graphics card.
//   node tests/bench/lab_frames.mjs BUILD/tests/browser REPORT/index.html [CHROMIUM]
// The first folder is that of the browser tests, where playwright is installed.
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [tests, report, executablePath = "/usr/bin/chromium-headless-shell"] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(tests, "package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath,
    args: ["--enable-unsafe-swiftshader", "--disable-gpu-watchdog", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])] });
for (const question of ["q4", "q5", "q6", "q7"]) {
    const page = await browser.newPage({ viewport: { width: 900, height: 700 } });
    await page.goto(`${pathToFileURL(path.resolve(report)).href}#lab=${question},scheme=explicit,lambda=0.1,t=10`);
    await page.locator(".lab-panel:not([aria-busy]) .lab-numbers td").first().waitFor();
    const perSecond = await page.evaluate(async () => {
        const slider = document.querySelector('.lab-panel input[name="lambda-slider"]'), frames = 60, began = performance.now();
        for (let i = 0; i < frames; ++i) {
            slider.value = String(0.2 * i / frames);
            slider.dispatchEvent(new Event("input"));
            await new Promise(requestAnimationFrame);
        }
        return 1000 * frames / (performance.now() - began);
    });
    const mesh = await page.locator(".lab-mesh").textContent();
    console.log(`${question}: ${perSecond.toFixed(0)} frames a second (${mesh.match(/\d+ vertices, /)[0].slice(0, -2)})`);
    await page.close();
}
await browser.close();
