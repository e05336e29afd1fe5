// Models in the page: started, turned, read and closed, by pointer and by keyboard. Pictures and words are compared with the GLB itself.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { chromium } from "playwright-core";
import { open, reports } from "./browser.mjs";

// Without a graphics card Chromium needs a flag to draw WebGL itself; on a busy machine that takes longer than its watchdog waits.
const launch = () => chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ["--enable-unsafe-swiftshader", "--disable-gpu-watchdog", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])],
});

const hasViewer = readFileSync(path.join(reports.quick, "index.html"), "utf8").includes("viewer-program");
const options = { skip: hasViewer ? false : "meshfolio was built without the viewer" };

// Small: every pixel is drawn by the processor.
const small = { viewport: { width: 800, height: 600 } };

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

// ---- expected values ----------------------------------------------------------------------------------------------------

/// A reader of GLB of its own: positions in the model's units, values, mask, triangles.
function readGlb(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const textLength = view.getUint32(12, true), json = JSON.parse(bytes.subarray(20, 20 + textLength).toString());
    const binary = 28 + textLength, { attributes, indices } = json.meshes[0].primitives[0], [node] = json.nodes;
    const rows = (number, columns) => {
        const accessor = json.accessors[number], { byteOffset, byteStride } = json.bufferViews[accessor.bufferView];
        const [size, get] = { 5121: [1, "getUint8"], 5123: [2, "getUint16"], 5125: [4, "getUint32"], 5126: [4, "getFloat32"] }[accessor.componentType];
        return Array.from({ length: accessor.count }, (_, i) => Array.from({ length: columns }, (_, k) =>
            view[get](binary + byteOffset + i * (byteStride ?? columns * size) + k * size, true)));
    };
    return {
        ...json.meshes[0].extras,
        positions: rows(attributes.POSITION, 3).map((row) => row.map((x, k) => node.translation[k] + node.scale[k] * x)),
        values: "_VALUE" in attributes ? rows(attributes._VALUE, 1).flat() : null,
        defined: "_DEFINED" in attributes ? rows(attributes._DEFINED, 1).flat() : null,
        corners: rows(indices, 1).flat(),
    };
}

const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);

/// Returns the initial place of a vertex, in pixels from the upper left of a cell: seen from the right front and above, 1.04 radii fill half of it.
function seenAt(glb, v, width, height) {
    const a = 35 * Math.PI / 180, e = 22 * Math.PI / 180;
    const right = [Math.cos(a), 0, -Math.sin(a)], up = [-Math.sin(e) * Math.sin(a), Math.cos(e), -Math.sin(e) * Math.cos(a)];
    const from = glb.positions[v].map((x, k) => x - glb.frame.centre[k]), scale = Math.min(width, height) / 2 / 1.04 / glb.frame.radius;
    return [width / 2 + scale * dot(from, right), height / 2 - scale * dot(from, up)];
}

/// The largest step of the value from a vertex to a neighbour.
function steps(glb) {
    const largest = new Array(glb.positions.length).fill(0);
    for (let i = 0; i < glb.corners.length; ++i) {
        const [v, w] = [glb.corners[i], glb.corners[i % 3 === 2 ? i - 2 : i + 1]], step = Math.abs(glb.values[v] - glb.values[w]);
        largest[v] = Math.max(largest[v], step), largest[w] = Math.max(largest[w], step);
    }
    return largest;
}

const linear = (channel) => { const c = channel / 255; return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4; };

/// The colour of a value, linear.
function colorOf({ range: [low, high], colors }, value) {
    const at = Math.min(1, Math.max(0, (value - low) / (high - low))) * (colors.length - 1), i = Math.min(Math.floor(at), colors.length - 2);
    return [1, 3, 5].map((k) => {
        const [a, b] = [colors[i], colors[i + 1]].map((color) => parseInt(color.slice(k, k + 2), 16));
        return linear(a + (at - i) * (b - a));
    });
}

/// Reading pixels back, as a screenshot does, is slow, and a driver in software says so.
const problemsOf = (page) => page.problems.filter((problem) => !problem.includes("GPU stall due to ReadPixels"));

// ---- actions ------------------------------------------------------------------------------------------------------------

// Two figures of meshes with different values. Of the first, the bumpy cube is turned, which bulges in every direction.
const figures = ["q1_h", "q1_tangential"];
const block = (page, n = 0) => page.locator(`#${figures[n]} .models[data-turnable]`);
const canvasOf = (page) => page.locator(".model-stage canvas");
const told = (page) => page.locator(".model-value").textContent();
const modelFile = (page, n = 0) => block(page, n).locator('a[href$=".glb"]').first().getAttribute("href");
const glbOf = async (page, n = 0) => readGlb(readFileSync(path.join(reports.quick, decodeURIComponent(await modelFile(page, n)))));

async function started(page, n = 0) {
    await block(page, n).getByRole("button", { name: "Turn in 3D" }).click();
    await canvasOf(page).waitFor();
    await canvasOf(page).scrollIntoViewIfNeeded();
}

/// The block turned into one with a single model, or with its first model twice.
const keepModels = (page, n, copies) => block(page, n).evaluate((element, count) => {
    const [first, ...others] = element.querySelectorAll('script[type="model/gltf-binary"]');
    for (const other of others) other.remove();
    for (let i = 1; i < count; ++i) first.after(first.cloneNode(true));
}, copies);

async function drag(page, dx, dy) {
    const box = await canvasOf(page).boundingBox();
    await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 4 + dx, box.y + box.height / 2 + dy, { steps: 4 });
    await page.mouse.up();
    await page.mouse.move(0, 0);
    await page.waitForTimeout(100);
}

/// The share of pixels in which two screenshots differ by more than rounding; at the rim it depends on the scrolling whether a part of the
/// frame is in the picture.
async function share(page, a, b) {
    const [one, other] = [await pixelsOf(page, a), await pixelsOf(page, b)], rim = 3;
    let count = 0;
    for (let y = rim; y < one.height - rim; ++y) {
        for (let x = rim; x < one.width - rim; ++x) count += one.at(x, y).some((c, k) => Math.abs(c - other.at(x, y)[k]) > 24);
    }
    return count / (one.width * one.height);
}

/// Pixels of the canvas, or of a screenshot: {width, height, at(x, y)}.
async function pixelsOf(page, screenshot) {
    const png = (screenshot ?? await canvasOf(page).screenshot()).toString("base64");
    const helper = await page.context().newPage();
    const { width, height, text } = await helper.evaluate(async (source) => {
        const image = new Image();
        image.src = `data:image/png;base64,${source}`;
        await image.decode();
        const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
        const context = canvas.getContext("2d");
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, image.width, image.height);
        let text = "";   // a tenth of the time that an array of numbers takes to get here
        for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
        return { width: image.width, height: image.height, text };
    }, png);
    await helper.close();
    const data = Uint8Array.from(text, (c) => c.charCodeAt(0));
    return { width, height, at: (x, y) => [...data.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)] };
}

/// Calls `look(v, x, y)` for a few visible vertices with values, with the pointer at each.
async function atVertices(page, glb, look) {
    const box = await canvasOf(page).boundingBox();
    let met = 0;
    for (let i = 0; i < 60 && met < 12; ++i) {
        const v = (i * 7919) % glb.positions.length;
        if (glb.defined?.[v] === 0) continue;
        const [x, y] = seenAt(glb, v, box.width, box.height).map(Math.round);
        await page.mouse.move(box.x + x, box.y + y);
        await page.waitForTimeout(60);
        if (!(await told(page)).endsWith(` vertex ${v}`)) continue;   // hidden behind the surface, or another is nearer to the pixel
        ++met;
        await look(v, x, y);
    }
    assert.ok(met >= 4, `only ${met} vertices were found where they should be seen`);
}

// ---- tests --------------------------------------------------------------------------------------------------------------

describe("a model in the page", options, () => {
    let page;
    before(async () => { page = await open(browser, reports.quick, small); });
    after(() => page.context().close());

    test("is not there before it is asked for", async () => {
        assert.equal(await page.evaluate(() => typeof globalThis.meshfolioViewer), "undefined");
        assert.equal(await canvasOf(page).count(), 0);
    });

    test("starts by keyboard in place of the picture, and Escape gives it back", async () => {
        const picture = block(page).locator("xpath=preceding-sibling::*[1]"), start = block(page).getByRole("button", { name: "Turn in 3D" });
        await start.focus();
        await page.keyboard.press("Enter");
        await canvasOf(page).waitFor();
        assert.equal(await picture.isVisible(), false);
        assert.ok(await canvasOf(page).evaluate((canvas) => canvas === document.activeElement), "the keys go to the model");
        await page.keyboard.press("Escape");
        assert.equal(await canvasOf(page).count(), 0);
        assert.equal(await picture.isVisible(), true);
        assert.ok(await start.evaluate((button) => button === document.activeElement), "focus is back");
        assert.deepEqual(problemsOf(page), []);
    });

    test("starts by click and is drawn", async () => {
        await started(page);
        const pixels = await pixelsOf(page), ground = pixels.at(1, 1);
        const at = (share) => pixels.at(Math.round(share * pixels.width), Math.round(pixels.height / 2));   // H and K stand side by side
        assert.ok([0.25, 0.5, 0.75].some((share) => `${at(share)}` !== `${ground}`));
        assert.deepEqual(problemsOf(page), []);
    });

    test("turns by dragging, and reset turns it back", async () => {
        const still = await canvasOf(page).screenshot();
        await drag(page, 80, 30);
        assert.ok(await share(page, await canvasOf(page).screenshot(), still) > 0.02);
        await page.getByRole("button", { name: "Reset" }).click();
        await canvasOf(page).focus();
        await page.waitForTimeout(100);
        assert.ok(await share(page, await canvasOf(page).screenshot(), still) < 0.001);
    });

    test("does not move by itself", async () => {
        const still = await canvasOf(page).screenshot();
        await page.waitForTimeout(500);
        assert.deepEqual(await canvasOf(page).screenshot(), still);
    });

    test("turns and zooms by keys, and tells what is in the middle", async () => {
        await canvasOf(page).focus();
        for (const [key, back] of [["ArrowLeft", "ArrowRight"], ["ArrowUp", "ArrowDown"], ["+", "-"]]) {
            const still = await canvasOf(page).screenshot();
            await page.keyboard.press(key);
            const moved = await canvasOf(page).screenshot();
            assert.notDeepEqual(moved, still, key);
            await page.keyboard.press(back);
            assert.notDeepEqual(await canvasOf(page).screenshot(), moved, back);
        }
        await page.keyboard.press("ArrowLeft");
        assert.match(await told(page), /^(in the middle: .+ vertex \d+)?$/);
        await page.keyboard.press("0");
        assert.deepEqual(problemsOf(page), []);
    });

    test("the wheel zooms only while the reader is in the model", async () => {
        const box = await canvasOf(page).boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        const still = await canvasOf(page).screenshot(), scrolled = await page.evaluate(() => scrollY);
        await page.mouse.wheel(0, -200);
        await page.waitForTimeout(150);
        assert.equal(await page.evaluate(() => scrollY), scrolled);
        assert.notDeepEqual(await canvasOf(page).screenshot(), still);
        await page.keyboard.press("0");
        await canvasOf(page).evaluate((canvas) => canvas.blur());
        await page.mouse.wheel(0, 200);
        await page.waitForTimeout(300);
        assert.notEqual(await page.evaluate(() => scrollY), scrolled);
    });

    test("starting another closes the first: one context lives", async () => {
        await started(page, 1);
        assert.equal(await canvasOf(page).count(), 1);
        assert.equal(await block(page, 0).locator("canvas").count(), 0);
        assert.equal(await block(page, 0).getByRole("button", { name: "Turn in 3D" }).isVisible(), true);
        assert.deepEqual(problemsOf(page), []);
    });
});

describe("what a model tells", options, () => {
    let page, glb;
    before(async () => {
        page = await open(browser, reports.quick, small);
        await keepModels(page, 0, 1);
        glb = await glbOf(page);
        await started(page);
    });
    after(() => page.context().close());

    test("the value under the pointer is the file's, with its unit", async () => {
        const step = steps(glb);
        await atVertices(page, glb, async (v) => {
            const words = await told(page), number = Number(words.match(/= (−?[\d.]+(?:e[+−]?\d+)?)/)[1].replaceAll("−", "-"));
            assert.ok(words.startsWith(glb.value.quantity) && words.includes(glb.value.unit), words);
            assert.ok(Math.abs(number - glb.values[v]) <= 0.5 * step[v] + 1e-3 * Math.abs(glb.values[v]), `${words}, not ${glb.values[v]}`);
        });
    });

    // color · light + sheen: neutral light may darken it, and nothing else.
    test("colours are those of the map, whatever the light", async () => {
        await page.mouse.move(0, 0);   // nothing lies over the model
        await page.waitForTimeout(100);
        const pixels = await pixelsOf(page), step = steps(glb), width = glb.value.range[1] - glb.value.range[0];
        await atVertices(page, glb, async (v, x, y) => {
            if (step[v] > 0.1 * width) return;   // the pixel may lie beside the vertex
            const seen = pixels.at(x, y).map(linear), color = colorOf(glb.value, glb.values[v]);
            const light = dot(seen, color) / dot(color, color);
            assert.ok(light > 0.14 && light < 1.1, `light ${light}`);
            seen.forEach((c, k) => assert.ok(Math.abs(c - light * color[k]) < 0.06, `${pixels.at(x, y)} at vertex ${v} is not ${color} times ${light}`));
        });
    });

    test("beside the model nothing is told", async () => {
        const box = await canvasOf(page).boundingBox();
        await page.mouse.move(box.x + 2, box.y + 2);
        await page.waitForTimeout(100);
        assert.equal(await told(page), "");
    });
});

describe("two models", options, () => {
    // The same model twice: both follow every action.
    for (const [name, width] of [["side by side", 800], ["above each other where it is narrow", 390]]) {
        test(`${name}, have one camera`, async () => {
            const page = await open(browser, reports.quick, { viewport: { width, height: 600 } });
            await keepModels(page, 0, 2);
            await started(page);
            const mismatch = (pixels, dx, dy) => {
                let count = 0, shown = 0;
                for (let y = 30; y < pixels.height - dy - 2; y += 3) {
                    for (let x = 130; x < pixels.width - dx - 2; x += 3) {
                        const [a, b] = [pixels.at(x, y), pixels.at(x + dx, y + dy)];
                        count += Math.max(...a.map((c, k) => Math.abs(c - b[k]))) > 40;
                        shown += Math.max(...a) - Math.min(...a) > 20;
                    }
                }
                assert.ok(shown > 50, "the model is seen");
                return count / shown;
            };
            /// The canvas may begin between two pixels: the second model is half of it further on, or a pixel more or less.
            const differing = async () => {
                const pixels = await pixelsOf(page), half = Math.round((width > 520 ? pixels.width : pixels.height) / 2);
                return Math.min(...[half - 1, half, half + 1].map((step) => width > 520 ? mismatch(pixels, step, 0) : mismatch(pixels, 0, step)));
            };
            assert.ok(await differing() < 0.05);
            const still = await canvasOf(page).screenshot();
            await drag(page, 60, 20);
            assert.notDeepEqual(await canvasOf(page).screenshot(), still);
            assert.ok(await differing() < 0.05);
            assert.deepEqual(problemsOf(page), []);
            await page.context().close();
        });
    }
});

describe("every mesh of a figure", options, () => {
    /// Returns the page with its first model three times, under these names.
    async function named(labels) {
        const page = await open(browser, reports.quick, small);
        await keepModels(page, 0, labels.length);
        await block(page, 0).locator('script[type="model/gltf-binary"]').evaluateAll((scripts, names) => scripts.forEach((one, i) => { one.dataset.label = names[i]; }), labels);
        await started(page);
        return page;
    }
    const cellLabels = (page) => page.locator(".model-label").allTextContents();

    test("can be chosen by its name, alone or with the first beside it", async () => {
        const page = await named(["bunny", "cow", "lion"]);
        assert.deepEqual(await cellLabels(page), ["bunny", "cow"]);
        for (const name of ["lion", "cow"]) {
            await page.getByRole("button", { name, exact: true }).click();
            await page.getByRole("button", { name, exact: true, pressed: true }).waitFor();
            await page.waitForFunction((wanted) => [...document.querySelectorAll(".model-label")].map((label) => label.textContent).join() === wanted, `bunny,${name}`);
        }
        await page.getByRole("button", { name: "Two at once" }).click();
        await page.waitForFunction(() => document.querySelectorAll(".model-label").length === 0);
        await canvasOf(page).focus();
        await page.keyboard.press("Escape");
        assert.equal(await canvasOf(page).count(), 0);
        assert.deepEqual(problemsOf(page), []);
        await page.context().close();
    });

    test("is on a slider where they are a series, and it says which is shown", async () => {
        const page = await named(["original", "k = 5, rms 9 %", "k = 15, rms 3 %", "k = 300, rms 0.3 %"]), slider = page.getByRole("slider", { name: "Mesh of the series" });
        await slider.fill("3");
        await page.waitForFunction(() => document.querySelector(".model-chooser output").textContent === "k = 300, rms 0.3 %");
        assert.equal(await slider.getAttribute("aria-valuetext"), "k = 300, rms 0.3 %");
        assert.deepEqual(await cellLabels(page), ["original", "k = 300, rms 0.3 %"]);
        await page.context().close();
    });

    test("opens where it is seen, with the figure's own legend, and tells its value at the pointer", async () => {
        const page = await open(browser, reports.quick, small);
        await keepModels(page, 0, 1);
        await block(page).getByRole("button", { name: "Turn in 3D" }).click();
        await canvasOf(page).waitFor();
        await page.waitForFunction(() => { const { top, bottom } = document.querySelector(".model-stage").getBoundingClientRect(); return top > -40 && bottom < innerHeight + 40; });
        const shared = page.locator(`#${figures[0]} .plate .legend-box svg.legend`), panel = page.locator(".model-panel");
        if (await shared.count()) assert.equal(await panel.locator("svg.legend").innerHTML(), await shared.innerHTML());
        else assert.match(await panel.locator(".model-legend").textContent(), /\[.+\]/, "with its unit");
        const box = await canvasOf(page).boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        await page.waitForFunction(() => document.querySelector(".model-tip:not([hidden])")?.textContent.includes("= "));
        assert.equal(await page.locator(".model-tip").textContent(), await told(page));
        await page.context().close();
    });
});

describe("where it cannot be", options, () => {
    async function refused(prepare) {
        const page = await open(browser, reports.quick, small);
        await prepare(page);
        await block(page).getByRole("button", { name: "Turn in 3D" }).click();
        const note = block(page).getByRole("status");
        await note.filter({ hasText: "picture" }).waitFor();
        assert.equal(await canvasOf(page).count(), 0);
        assert.equal(await block(page).locator("xpath=preceding-sibling::*[1]").isVisible(), true);
        return page;
    }

    test("without WebGL it is said and the picture stays", async () => {
        const page = await refused((page) => page.evaluate(() => {
            const getContext = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest); };
        }));
        await page.context().close();
    });

    test("a script that the policy does not list is not run", async () => {
        const page = await refused((page) => page.evaluate(async () => {
            const stream = new Blob(["globalThis.meshfolioViewer = { start() { globalThis.wasRun = true; } };"]).stream();
            const bytes = new Uint8Array(await new Response(stream.pipeThrough(new CompressionStream("deflate"))).arrayBuffer());
            document.getElementById("viewer-program").textContent = btoa(String.fromCharCode(...bytes));
        }));
        assert.equal(await page.evaluate(() => globalThis.wasRun), undefined);
        await page.context().close();
    });
});

describe("looks", options, () => {
    test("at 360 pixels it fits, in the dark its ground is dark", async () => {
        const page = await open(browser, reports.quick, { viewport: { width: 360, height: 800 } });
        await started(page);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
        const brightness = async () => { const pixels = await pixelsOf(page); return Math.max(...pixels.at(2, 60)); };
        assert.ok(await brightness() > 200);
        await page.emulateMedia({ colorScheme: "dark" });
        await page.waitForTimeout(100);
        assert.ok(await brightness() < 80);
        await page.context().close();
    });
});

describe("the files", options, () => {
    test("satisfy the official validator of glTF", async (context) => {
        const validator = await import("gltf-validator").catch(() => null);
        if (!validator) return context.skip("gltf-validator is not installed");
        const page = await open(browser, reports.quick);
        const links = await page.$$eval('.models a[href$=".glb"]', (all) => all.map((link) => link.getAttribute("href")));
        assert.ok(links.length > 0);
        for (const link of links) {
            const file = path.join(reports.quick, decodeURIComponent(link));
            assert.ok(existsSync(file), file);
            const { issues } = await validator.default.validateBytes(new Uint8Array(readFileSync(file)));
            assert.equal(issues.numErrors + issues.numWarnings, 0, JSON.stringify(issues.messages));
        }
        await page.context().close();
    });
});
