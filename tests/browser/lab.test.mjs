// The live laboratory: its mathematics against the program's own commands, then the panel as a reader uses it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { pathToFileURL } from "node:url";
import { inflateSync } from "node:zlib";
import { chromium } from "playwright-core";
import { open, reports } from "./browser.mjs";

const page_text = readFileSync(path.join(reports.quick, "index.html"), "utf8");
const options = { skip: page_text.includes("viewer-program") ? false : "meshfolio was built without the viewer" };

const source = process.env.SOURCE, viewer = (name) => import(pathToFileURL(path.join(source, "templates/viewer", name)).href);
const lab = await viewer("lab_math.js"), { normalNumbers } = await viewer("lab_noise.js"), states = await viewer("lab_state.js");

const folder = mkdtempSync(path.join(os.tmpdir(), "meshfolio-lab-"));
after(() => rmSync(folder, { recursive: true, force: true }));

function run(...words) {
    const { status, stderr } = spawnSync(process.env.MESHFOLIO, words.map(String), { encoding: "utf8", cwd: folder });
    assert.ok(status === 0, `${words.join(" ")}: ${stderr}`);
    return stderr;
}

const positionsOf = (file) => Float64Array.from(readFileSync(path.join(folder, file), "utf8").match(/^v .*$/gm).flatMap((row) => row.split(/\s+/).slice(1, 4).map(Number)));
function dataOf(page, question) {
    const [, text] = page.match(new RegExp(`data-questions="(?:[^"]* )?${question}(?: [^"]*)?">([^<]*)<`));
    const bytes = inflateSync(Buffer.from(text, "base64"));
    return lab.decoded(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}
const pageOf = (file) => readFileSync(path.join(folder, file), "utf8");
const start = (change) => ({ ...states.startOf("lab"), ...change });
const result = (data, state, c = data.coefficients) => lab.sumOfModes(data, lab.filter(data, state), c, new Float64Array(3 * data.vertices));

// ---- the mathematics ----------------------------------------------------------------------------------------------------

describe("sums over modes in 16 bits are what the program computes", options, () => {
    let data, first;
    before(() => {
        run("sample", "cube", "-o", "cube.obj");
        run("lab", "cube.obj", "-o", "cube.html");
        data = dataOf(pageOf("cube.html"), "lab");
        first = positionsOf("cube.obj");
    });

    /// √(mean |x − y|²) in box diagonals; the page's positions are about the box centre.
    function distance(x, y) {
        let sum = 0;
        for (let i = 0; i < x.length; ++i) sum += (x[i] - (y[i] - first[i] + data.positions[i])) ** 2;
        return Math.sqrt(sum / data.vertices) / data.diagonal;
    }
    /// By `meshfolio smooth`, λ in λ_crit.
    function smoothed(scheme, lambda, t) {
        run("smooth", "cube.obj", "-o", "smooth.obj", "--scheme", scheme, "--lambda", lambda, "--unit", "tau", "--iterations", t);
        return positionsOf("smooth.obj");
    }
    const close = (x, y, what) => assert.ok(distance(x, y) <= 1e-4, `${what}: ${distance(x, y)}`);

    test("ten projections", () => {
        const counts = [1, 2, 5, 10, 15, 30, 60, 150, 400, 602];
        run("spectrum", "cube.obj", "-k", 602, "--reconstruct", counts.join(","), "--out", "modes", "--csv", "modes.csv");
        for (const k of counts) {
            run("noise", `modes/cube_k${k}.ply`, "-o", "k.obj", "--sigma", 0);   // as text
            close(result(data, start({ scheme: "projection", k })), positionsOf("k.obj"), `k = ${k}`);
        }
    });

    const settings = {
        explicit: [[0.1, 1], [0.1, 30], [0.25, 5], [0.5, 1], [0.5, 40], [0.9, 10], [0.99, 40], [1.01, 40], [1.05, 30], [2, 3]],
        implicit: [[0.1, 1], [0.5, 10], [1, 1], [1, 40], [3, 5], [5, 10], [20, 3], [100, 1], [100, 5], [1000, 1]],
        taubin: [[0.05, 1], [0.1, 5], [0.2, 20], [0.3, 1], [0.4, 10], [0.5, 20], [0.6, 40], [0.7, 3], [0.8, 5], [0.9, 2]],
    };
    for (const [scheme, pairs] of Object.entries(settings)) {
        test(`ten settings of ${scheme} steps`, () => {
            for (const [lambda, t] of pairs) close(result(data, start({ scheme, lambda, t })), smoothed(scheme, lambda, t), `λ = ${lambda} λ_crit, t = ${t}`);
        });
    }

    // (1 − h)ⁿ and (1 + h)⁻ⁿ lie on both sides of exp(−nh), equally far to first order.
    test("ten heat flows lie between many small explicit and implicit steps", () => {
        for (const [lambda, t] of [[0.1, 1], [0.5, 1], [1, 1], [1, 5], [2, 10], [5, 1], [10, 2], [20, 1], [50, 1], [100, 1]]) {
            const steps = Math.ceil(40 * lambda * t) + 400;
            const [below, above] = ["explicit", "implicit"].map((scheme) => smoothed(scheme, lambda * t / steps, steps));
            close(result(data, start({ scheme: "heat", lambda, t })), below.map((x, i) => (x + above[i]) / 2), `λ = ${lambda} λ_crit, t = ${t}`);
        }
    });

    test("the noise is that of `meshfolio noise`, number by number", () => {
        for (const seed of [0, 1, 7, 4000000000]) {
            run("noise", "cube.obj", "-o", "noisy.obj", "--sigma", 0.01, "--seed", seed);
            const noise = normalNumbers(seed, first.length), noisy = positionsOf("noisy.obj");
            noisy.forEach((x, i) => assert.ok(Math.abs(x - first[i] - 0.01 * noise[i]) < 1e-14, `seed ${seed}, number ${i}`));
        }
    });

    test("what is measured on coefficients is what is measured on positions", () => {
        const shift = normalNumbers(3, 3 * data.vertices).map((z) => 0.01 * z), c = lab.withShift(data, shift), state = start({ scheme: "explicit", lambda: 0.3, t: 4 });
        const f = lab.filter(data, state), x = result(data, state, c);
        let sum = 0;
        for (let i = 0; i < x.length; ++i) sum += data.area[Math.floor(i / 3)] * (x[i] - data.positions[i]) ** 2;
        assert.ok(Math.abs(lab.rms(data, f, c) / Math.sqrt(sum / data.totalArea) - 1) < 1e-4);
        const curve = lab.errorCurve(data, state, c, 10);
        assert.ok(Math.abs(curve[4] / lab.rms(data, f, c) - 1) < 1e-12);
        const best = lab.indexOfLeast(curve);
        assert.ok(best > 0 && best < 10 && curve.every((error) => error >= curve[best]));
    });

    test("beyond 2,000 vertices the page has the lowest modes and says so", () => {
        run("sample", "sphere", "-o", "sphere.obj");
        assert.match(run("lab", "sphere.obj", "-o", "sphere.html"), /lowest 300 modes of 2562, a truncation/);
        assert.equal(dataOf(pageOf("sphere.html"), "lab").modes, 300);
    });
});

test("a link restores the state, whatever it holds", () => {
    for (const [question, state] of ["q4", "q5", "q6", "q7", "lab"].flatMap((q) => states.presetsOf(q).map(([, state]) => [q, state]))) {
        const read = states.readLink(states.linkOf(question, state)), { k, ...rest } = states.held(read.state, 602);
        assert.equal(read.question, question);
        for (const name of state.scheme === "projection" ? ["scheme"] : ["scheme", "lambda", "t", "sigma", "lines"]) assert.equal(rest[name], state[name], name);
        if (state.scheme === "projection") assert.equal(k, state.k);
    }
    assert.deepEqual(states.readLink("#lab=q5,lambda=1.01,t=40").state, { ...states.startOf("q5"), lambda: 1.01, t: 40 });
    assert.equal(states.readLink("#q5"), null);
    const odd = states.held(states.readLink("#lab=q5,scheme=toString,lambda=-1e999,t=NaN,k=1e9,sigma=<b>,seed=").state, 602);
    assert.deepEqual([odd.scheme, odd.lambda, odd.t, odd.k, odd.sigma], ["projection", 0.5, 10, 602, 0]);
    for (const lambda of [0, 0.3, 1, 3, 10, 999]) assert.ok(Math.abs(states.lambdaAt(states.placeOf(lambda)) - lambda) < 1e-9 * (1 + lambda));
});

// ---- the panel ----------------------------------------------------------------------------------------------------------

describe("the panel", options, () => {
    let browser;
    before(async () => {
        browser = await chromium.launch({ executablePath: process.env.CHROMIUM,
            args: ["--enable-unsafe-swiftshader", "--disable-gpu-watchdog", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])] });
    });
    after(() => browser.close());

    const small = { viewport: { width: 900, height: 700 } };
    const block = (page, question) => page.locator(`.lab[data-question="${question}"]`);
    const problemsOf = (page) => page.problems.filter((problem) => !problem.includes("GPU stall due to ReadPixels"));
    /// The page with a laboratory open, at a link if one is given.
    async function opened(question, { link = "", ...more } = {}) {
        const page = await open(browser, reports.quick, { ...small, ...more });
        if (link) await page.evaluate((hash) => { location.hash = hash; }, link);
        else await block(page, question).getByRole("button", { name: "Open the live laboratory" }).click();
        await block(page, question).locator(".lab-numbers td").first().waitFor();
        await settled(page);
        return page;
    }
    const settled = (page) => page.waitForTimeout(700);
    const numberIn = (words) => Number(words.replaceAll("−", "-"));
    /// {words: [here, the program's]}
    const table = (page) => page.$$eval(".lab-numbers tr:has(th[scope=row])", (rows) => Object.fromEntries(rows.map((row) => {
        const [words, here, program] = [...row.children].map((cell) => cell.textContent);
        return [words, [here, program]];
    })));
    const fragment = (page) => page.evaluate(() => location.hash);
    const set = async (page, name, value) => {
        const field = page.locator(`.lab-panel input[name="${name}"]`);
        await field.fill(String(value));
        await field.blur();
        await settled(page);
    };

    test("opens from questions 4 to 7 with their settings, and Escape gives the button back", async () => {
        const page = await open(browser, reports.quick, small);
        for (const [question, scheme] of [["q4", "projection"], ["q5", "explicit"], ["q6", "implicit"], ["q7", "explicit"]]) {
            const start = block(page, question).getByRole("button", { name: "Open the live laboratory" });
            await start.focus();
            await page.keyboard.press("Enter");
            await page.locator(".lab-numbers td").first().waitFor();
            assert.equal(await page.locator(".lab-panel").count(), 1);
            assert.equal(await page.locator('.lab-panel select[name="scheme"]').inputValue(), scheme);
            await page.locator(".lab-panel canvas").focus();
            await page.keyboard.press("Escape");
            assert.equal(await page.locator(".lab-panel").count(), 0);
            assert.ok(await start.evaluate((button) => button === document.activeElement), "focus is back");
        }
        assert.deepEqual(problemsOf(page), []);
        await page.context().close();
    });

    test("at every preset it shows the program's numbers, which agree to 1e-4", async () => {
        let compared = 0;
        for (const question of ["q4", "q5", "q6", "q7"]) {
            const page = await opened(question);
            for (const [words, state] of states.presetsOf(question)) {
                await page.locator(".lab-presets a", { hasText: words }).first().click();
                await settled(page);
                for (const [name, [here, program]] of Object.entries(await table(page))) {
                    if (program === "–") continue;
                    ++compared;
                    assert.ok(Math.abs(numberIn(here) / numberIn(program) - 1) < 1e-4, `${question}, ${words}: ${name} ${here} ${program}`);
                }
                const link = states.readLink(await fragment(page));
                assert.equal(link.question, question);
                assert.equal(link.state.scheme, state.scheme);
            }
            assert.deepEqual(problemsOf(page), []);
            await page.context().close();
        }
        assert.ok(compared >= 25, `${compared} numbers`);
    });

    test("every slider moves what it names, by pointer and by keys", async () => {
        const page = await opened("q7");
        const measured = async () => JSON.stringify(await table(page));
        for (const name of ["lambda", "t", "sigma"]) {
            const slider = page.locator(`.lab-panel input[name="${name}-slider"]`), number = page.locator(`.lab-panel input[name="${name}"]`);
            const [value, before] = [await number.inputValue(), await measured()];
            await slider.focus();
            await page.keyboard.press("ArrowRight");
            await page.keyboard.press("ArrowRight");
            await settled(page);
            assert.ok(Number(await number.inputValue()) > Number(value), name);
            assert.notEqual(await measured(), before, name);
            assert.ok((await fragment(page)).includes(`${name}=${await number.inputValue()}`), await fragment(page));
            assert.match(await slider.getAttribute("aria-valuetext"), new RegExp(await number.inputValue()));
            const box = await slider.boundingBox();
            await page.mouse.click(box.x + 0.8 * box.width, box.y + box.height / 2);
            assert.ok(Number(await number.inputValue()) > Number(value), `${name} by pointer`);
            await set(page, name, value);
        }
        const before = await measured();
        await set(page, "seed", 5);
        assert.notEqual(await measured(), before);
        await page.locator('select[name="scheme"]').selectOption("projection");
        await settled(page);
        const k = page.locator('input[name="k-slider"]');
        assert.ok(await k.isVisible() && !(await page.locator('input[name="t-slider"]').isVisible()));
        const few = await measured();
        await k.focus();
        await page.keyboard.press("End");
        await settled(page);
        assert.notEqual(await measured(), few);
        await page.context().close();
    });

    test("just beyond the limit a mode grows, far beyond vertices leave the view, and it is said", async () => {
        const told = (page) => page.locator(".lab-told").textContent();
        const page = await opened("q5", { link: "#lab=q5,lambda=0.99,t=40" });
        assert.doesNotMatch(await told(page), /Beyond the limit|flown/);
        await page.evaluate(() => { location.hash = "#lab=q5,lambda=1.01,t=40"; });
        await settled(page);
        assert.match(await told(page), /λ = 1\.01 λ_crit, t = 40.*multiplies the finest mode by 1\.02/);
        assert.equal((await table(page))["largest |1 − λμ|"][0], "1.02");
        await page.evaluate(() => { location.hash = "#lab=q5,lambda=2,t=60"; });
        await settled(page);
        assert.match(await told(page), /\d+ of \d+ vertices have flown out of the view/);
        await set(page, "t", 10000);
        assert.deepEqual(problemsOf(page), []);
        await page.evaluate(() => { location.hash = "#lab=q6,scheme=implicit,lambda=100,t=1"; });
        await page.locator('.lab[data-question="q6"] .lab-panel').waitFor();
        await settled(page);
        assert.doesNotMatch(await told(page), /Beyond the limit|flown/);
        assert.equal(await page.locator(".lab-panel").count(), 1);
        await page.context().close();
    });

    test("the best t for the noise is the least of its curve", async () => {
        const page = await opened("q7");
        await page.locator(".lab-presets a", { hasText: "best t" }).click();
        await settled(page);
        const { state } = states.readLink(await fragment(page)), data = dataOf(page_text, "q7");
        const noise = normalNumbers(state.seed, 3 * data.vertices).map((z) => z * state.sigma / 100 * data.diagonal);
        assert.equal(state.t, lab.indexOfLeast(lab.errorCurve(data, state, lab.withShift(data, noise), 200)));
        assert.match(await page.locator(".lab-told").textContent(), new RegExp(`Nearest to the clean mesh at t = ${state.t}\\.`));
        await page.context().close();
    });

    test("plays over t and pauses; where motion is not wanted, a step at a time", async () => {
        const page = await opened("q5", { reducedMotion: "no-preference" }), t = page.locator('.lab-panel input[name="t"]');
        const first = Number(await t.inputValue());
        await page.getByRole("button", { name: "Play over t" }).click();
        await page.waitForTimeout(1200);
        await page.getByRole("button", { name: "Pause" }).click();
        const after = Number(await t.inputValue());
        assert.ok(after > first + 5, `${first} to ${after}`);
        await page.waitForTimeout(300);
        assert.equal(Number(await t.inputValue()), after);
        await page.context().close();
        const still = await opened("q5");
        await still.getByRole("button", { name: "One step" }).click();
        assert.equal(Number(await still.locator('.lab-panel input[name="t"]').inputValue()), first + 1);
        await still.context().close();
    });

    test("twenty frames a second on the largest of its meshes", async () => {
        const page = await opened("q5");
        const perSecond = await page.evaluate(async () => {
            const slider = document.querySelector('.lab-panel input[name="lambda-slider"]'), frames = 40, began = performance.now();
            for (let i = 0; i < frames; ++i) {
                slider.value = String(0.2 * i / frames);
                slider.dispatchEvent(new Event("input"));
                await new Promise(requestAnimationFrame);
            }
            return 1000 * frames / (performance.now() - began);
        });
        assert.ok(perSecond > 20, `${perSecond} frames a second`);
        await page.context().close();
    });

    test("without WebGL it is said, and numbers and curves follow", async () => {
        const page = await open(browser, reports.quick, small);
        await page.evaluate(() => {
            const getContext = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest); };
        });
        await block(page, "q5").getByRole("button").click();
        await page.locator(".lab-no-view", { hasText: "cannot show it in three dimensions" }).waitFor();
        await set(page, "t", 25);
        const state = { ...states.startOf("q5"), t: 25 }, data = dataOf(page_text, "q5");
        const energy = lab.energy(data, lab.filter(data, state), data.coefficients);
        assert.ok(Math.abs(numberIn((await table(page))["energy length²"][0]) / energy - 1) < 1e-5);
        await page.context().close();
    });

    test("without JavaScript nothing is promised", async () => {
        const page = await open(browser, reports.quick, { ...small, javaScriptEnabled: false });
        assert.equal(await page.locator(".lab:visible").evaluateAll((all) => all.filter((one) => one.textContent.trim()).length), 0);
        await page.context().close();
    });

    test("on paper stands what is seen", async () => {
        const page = await opened("q5");
        await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
        await page.emulateMedia({ media: "print" });
        const frame = page.locator(".lab-frame");
        assert.ok(await frame.isVisible());
        assert.match(await frame.getAttribute("src"), /^data:image\/png;base64,.{2000}/);
        assert.equal(await page.locator(".lab-panel canvas:visible").count(), 0);
        await page.context().close();
    });

    const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
    for (const colorScheme of ["light", "dark"]) {
        test(`for whoever cannot see or point, ${colorScheme}, and on a telephone`, async () => {
            const page = await opened("q7", { colorScheme });
            await page.evaluate(axe);
            const { violations } = await page.evaluate(() => axe.run(document.querySelector(".lab-panel")));
            assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`), []);
            await page.setViewportSize({ width: 360, height: 740 });
            assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
            const [view, controls] = [await page.locator(".lab-panel .model-stage").boundingBox(), await page.locator(".lab-controls").boundingBox()];
            assert.ok(controls.y >= view.y + view.height);
            await page.context().close();
        });
    }

    test("`meshfolio lab` makes a page of its own, under the same policy", async () => {
        run("sample", "cube8", "-o", "cube8.obj");
        run("lab", "cube8.obj", "-o", "index.html");
        const page = await open(browser, folder, small);
        await page.getByRole("button", { name: "Open the live laboratory" }).click();
        await page.locator(".lab-numbers td").first().waitFor();
        assert.match(await page.locator(".lab-mesh").textContent(), /cube8; 8 vertices, all 8 modes/);
        assert.match(await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', "content"), /^default-src 'none';/);
        assert.deepEqual(problemsOf(page), []);
        await page.context().close();
    });
});

test("the data stands once, in the report alone, and weighs at most 2.2 MB", options, () => {
    const scripts = page_text.match(/<script type="application\/x-meshfolio-lab"[^>]*>[^<]*/g);
    assert.equal(scripts.map((one) => one.match(/data-questions="([^"]*)"/)[1]).join(" ").split(" ").sort().join(" "), "q4 q5 q6 q7");
    assert.equal(scripts.length, 3);
    assert.ok(scripts.join("").length <= 2.2e6, `${scripts.join("").length} bytes`);
    assert.ok(!readFileSync(path.join(reports.quick, "appendix.html"), "utf8").includes("x-meshfolio-lab"));
});
