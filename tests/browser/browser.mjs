// Shared by the tests of the page: reports, the browser, and a page that records problems.
import { existsSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const required = (name) => process.env[name] ?? (() => { throw new Error(`${name} is not set; run these tests through ctest`); })();
/// A quick report of the bundled meshes, and one with hostile names of title, author and mesh.
export const reports = { quick: path.resolve(required("REPORTS"), "quick"), hostile: path.resolve(required("REPORTS"), "hostile") };

export const launch = () =>
    chromium.launch({ executablePath: required("CHROMIUM"), args: process.getuid?.() === 0 ? ["--no-sandbox"] : [] });

/// The volumes of a report.
export const volumes = ["index.html", "appendix.html"];

/// The page of a report, or its appendix (`volume`), with `problems`: errors on the console, exceptions, and requests for
/// files other than the page and images/. `first` runs in the page before its own scripts.
export async function open(browser, folder, { volume = "index.html", first = () => {}, ...options } = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, reducedMotion: "reduce", ...options });
    context.setDefaultTimeout(90000);
    await context.addInitScript(first);
    const page = await context.newPage();
    const url = pathToFileURL(path.join(folder, volume)).href, images = pathToFileURL(path.join(folder, "images")).href + "/";
    page.problems = [];
    page.on("console", (message) => { if (["error", "warning"].includes(message.type())) page.problems.push(message.text()); });
    page.on("pageerror", (error) => page.problems.push(String(error)));
    page.on("dialog", (dialog) => { page.problems.push(`a dialog: ${dialog.message()}`); dialog.dismiss(); });
    page.on("request", (request) => {
        const asked = request.url();
        if (asked.split("#")[0] !== url && !asked.startsWith(images) && !asked.startsWith("data:")) page.problems.push(`asks for ${asked}`);
    });
    if (!existsSync(path.join(folder, volume))) throw new Error(`there is no report in ${folder}`);
    await page.goto(url);
    return page;
}
