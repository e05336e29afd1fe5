// The live laboratory as a reader uses it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { chromium } from "playwright-core";
import { open, reports } from "./browser.mjs";
import { dataOf, Experiment, folder, lab, options, reportPage, run, states } from "./lab_tools.mjs";

describe("the panel", options, () => {
    let browser;
    before(async () => {
        browser = await chromium.launch({ executablePath: process.env.CHROMIUM,
            args: ["--enable-unsafe-swiftshader", "--disable-gpu-watchdog", ...(process.getuid?.() === 0 ? ["--no-sandbox"] : [])] });
    });
    after(() => browser.close());

    /// Skips the 0.4 s that the page waits before it announces a setting.
    const tellSoon = () => {
        const wait = globalThis.setTimeout;
        globalThis.setTimeout = (what, milliseconds, ...more) => wait(what, milliseconds === 400 ? 40 : milliseconds, ...more);
    };
    const small = { viewport: { width: 900, height: 700 }, first: tellSoon };
    const block = (page, question) => page.locator(`.lab[data-question="${question}"]`);
    const problemsOf = (page) => page.problems.filter((problem) => !problem.includes("GPU stall due to ReadPixels"));
    const pages = new Map();
    /// The page with a laboratory open, at a link if one is given. Tests that ask for the same options follow one another on one page.
    async function opened(question, { link = "", ...more } = {}) {
        const key = JSON.stringify(more), page = pages.get(key) ?? await open(browser, reports.quick, { ...small, ...more });
        pages.set(key, page);
        page.problems.length = 0;
        if (await page.locator(".lab-panel").count() > 0) {
            await page.locator('.lab-panel select[name="scheme"]').focus();
            await page.keyboard.press("Escape");
        }
        await page.evaluate(() => history.replaceState(null, "", location.pathname));
        if (link) await page.evaluate((hash) => { location.hash = hash; }, link);
        else await block(page, question).getByRole("button", { name: "Open the live laboratory" }).click();
        await block(page, question).locator(".lab-tiles dd").first().waitFor();
        await settled(page);
        return page;
    }
    /// Discards a page that the next test must not reuse.
    const closed = async (page) => {
        for (const [key, kept] of pages) if (kept === page) pages.delete(key);
        await page.context().close();
    };
    /// Waits until the panel has announced the last change.
    const settled = async (page) => {
        await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 50))));
        await page.locator(".lab-panel:not([aria-busy])").waitFor();
    };
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
        for (const [question, scheme] of [["q4", "projection"], ["q5", "explicit"], ["q6", "implicit"], ["q7", "denoising"]]) {
            const start = block(page, question).getByRole("button", { name: "Open the live laboratory" });
            await start.focus();
            await page.keyboard.press("Enter");
            await page.locator(".lab-tiles dd").first().waitFor();
            assert.equal(await page.locator(".lab-panel").count(), 1);
            assert.equal(await page.locator('.lab-panel select[name="scheme"]').inputValue(), scheme);
            const slider = page.locator(`.lab-panel input[name="${states.amountsOf(scheme)[0]}-slider"]`);
            assert.ok(await slider.evaluate((input) => input === document.activeElement), "the first slider has the keys");
            const { y, height } = await slider.boundingBox();
            assert.ok(y > 0 && y + height < small.viewport.height, `and is seen: ${y}`);
            await page.locator(scheme === "explicit" ? ".lab-panel canvas" : '.lab-panel select[name="scheme"]').focus();
            await page.keyboard.press("Escape");
            assert.equal(await page.locator(".lab-panel").count(), 0);
            assert.ok(await start.evaluate((button) => button === document.activeElement), "focus is back");
        }
        assert.deepEqual(problemsOf(page), []);
        await page.context().close();
    });

    test("at every preset and as it opens it shows the program's numbers, which agree to 1e-4", async () => {
        for (const question of ["q4", "q5", "q6", "q7"]) {
            const page = await opened(question), compare = async (words) => {
                for (const [name, [here, program]] of Object.entries(await table(page))) {
                    if (name.startsWith("rms² along") || here === program) continue;   // the program does not measure it, or both have rounding
                    assert.ok(Math.abs(numberIn(here) / numberIn(program) - 1) < 1e-4, `${question}, ${words}: ${name} ${here} ${program}`);
                }
            };
            await compare("as it opens");
            for (const { words, state } of states.presetsOf(dataOf(reportPage, question), question)) {
                const link = page.locator(".lab-presets a", { hasText: words.replace("_", "") }).first();
                await link.click();
                await settled(page);
                await compare(words);
                assert.equal(await link.getAttribute("aria-current"), "true");
                const { question: of, change } = states.readLink(await fragment(page));
                assert.deepEqual([of, change.scheme], [question, state.scheme]);
            }
            assert.deepEqual(problemsOf(page), []);
        }
    });

    test("every slider moves what it names, by pointer and by keys", async () => {
        const page = await opened("q7");
        const measured = async () => JSON.stringify(await table(page));
        const moves = async (name) => {
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
        };
        for (const name of ["edges", "t", "sigma"]) await moves(name);
        const before = await measured();
        await set(page, "seed", 5);
        assert.notEqual(await measured(), before);
        await page.locator('select[name="scheme"]').selectOption("explicit");
        await settled(page);
        await moves("lambda");
        await page.locator('select[name="scheme"]').selectOption("projection");
        await settled(page);
        assert.ok(!(await page.locator('input[name="t-slider"]').isVisible()));
        await moves("k");
        await page.locator('input[name="k-slider"]').press("End");
        await settled(page);
        assert.equal(Number(await page.locator('input[name="k"]').inputValue()), dataOf(reportPage, "q7").modes);
    });

    test("just beyond the limit a mode grows, far beyond vertices leave the view, and it is said", async () => {
        const told = (page) => page.locator(".lab-told").textContent();
        const page = await opened("q5", { link: "#lab%3Dq5%2Clambda%3D0.99%2Ct%3D40" });   // as mail writes it
        assert.doesNotMatch(await told(page), /Beyond the limit|Flown/);
        await page.evaluate(() => { location.hash = "#lab=q5,lambda=1.01,t=40"; });
        await settled(page);
        assert.match(await told(page), /^Past λcrit: the shortest waves now grow at every step\. .*λ = 1\.01 λcrit, t = 40.*multiplies the shortest wave by 1\.02/);
        assert.equal((await table(page))["shortest wave, each step ×"][0], "−1.02");
        await page.evaluate(() => { location.hash = "#lab=q5,lambda=2,t=60"; });
        await settled(page);
        assert.match(await told(page), /Flown out of the view, and drawn at its rim: \d+ of \d+ vertices/);
        await set(page, "t", 10000);
        assert.match(await told(page), /beyond all measure/);
        assert.equal((await table(page))["Dirichlet energy length²"][0], "–");
        assert.deepEqual(problemsOf(page), []);
        await page.evaluate(() => { location.hash = "#lab=q6,scheme=implicit,lambda=100,t=1"; });
        await page.locator('.lab[data-question="q6"] .lab-panel').waitFor();
        await settled(page);
        assert.doesNotMatch(await told(page), /Beyond the limit|Flown/);
        assert.equal(await page.locator(".lab-panel").count(), 1);
    });

    test("it says which limit a slider has passed, once, and back again", async () => {
        const event = async (page) => (await page.locator(".lab-told strong").allTextContents()).join();
        const page = await opened("q5", { link: "#lab=q5,scheme=explicit,lambda=0.4,t=3" });
        assert.equal(await event(page), "");
        for (const [lambda, words] of [[0.6, /flip/], [0.7, /^$/], [1.2, /Past λcrit: the shortest waves now grow/], [1.3, /^$/], [0.9, /Below λcrit again/], [0.3, /no wave flips/]]) {
            await set(page, "lambda", lambda);
            assert.match(await event(page), words, `λ = ${lambda} λ_crit`);
        }
        assert.equal(await page.locator(".lab-told").getAttribute("aria-live"), "polite");
        assert.deepEqual(await page.$$eval(".lab-panel", ([panel]) => panel.textContent.match(/[λμ]_\w+/g)), null, "indices are set low");
        const denoising = await opened("q7"), t = denoising.locator('.lab-panel input[name="t"]');
        const best = Number((await denoising.locator(".lab-told").textContent()).match(/Nearest to the clean surface at t = (\d+)/)[1]);
        await set(denoising, "t", best);
        await set(denoising, "t", best + 1);
        assert.match(await event(denoising), /^Past the least error/);
        await set(denoising, "t", best - 1);
        assert.match(await event(denoising), /^Before the least error/);
        assert.equal(await t.inputValue(), String(best - 1));
    });

    test("at most four large numbers of three digits, in words, and the folded table tells how far the program agrees", async () => {
        for (const question of ["q4", "q5", "q6", "q7"]) {
            const page = await opened(question), tiles = await page.locator(".lab-tiles dd").allTextContents(), rows = Object.values(await table(page));
            assert.ok(tiles.length >= 3 && tiles.length <= 4, `${question}: ${tiles}`);
            for (const words of tiles) assert.ok(words.replace(/^[−0.× ]*|\D/g, "").length <= 3, `${question}: ${words}`);
            assert.ok(!(await page.locator(".lab-numbers").isVisible()));
            const apart = rows.filter(([, program]) => program !== "–" && !program.startsWith("<")).map(([here, program]) => Math.abs(numberIn(here) - numberIn(program)) / Math.abs(numberIn(program)) || 0);
            const [, shared] = (await page.locator(".lab-check summary").textContent()).match(/^✓ agrees with the program to (\d) digits$/);
            assert.ok(shared >= 4 && Math.max(...apart) <= 1.1 * 10 ** -shared, `${question}: ${shared} digits, ${apart}`);
        }
        const page = await opened("q5");
        await set(page, "lambda", 0.123);
        assert.match(await page.locator(".lab-check summary").textContent(), /^All numbers/, "where the program has computed nothing, nothing is claimed");
    });

    test("the surface has the colours of the question's figures, and a bar says what they mean", async () => {
        const bar = (page) => page.locator(".lab-panel .lab-bar").textContent(), { colors } = dataOf(reportPage, "q7");
        assert.deepEqual([colors.pale[0], colors.pale.at(-1), colors.diverging.length % 2], ["#f1eee4", "#253261", 1]);
        assert.match(await bar(await opened("q4")), /^distance to the original \[% of box diagonal\]0\.1110100$/);
        for (const question of ["q5", "q6"]) assert.match(await bar(await opened(question)), /^mean curvature × mean edge−[\d.]+0[\d.]+$/);
        const page = await opened("q7"), noisy = await bar(page);
        assert.match(noisy, /^distance to the clean surface \[σ\]0[\d.]+$/);
        await set(page, "t", 1);
        assert.equal(await bar(page), noisy, "colours of one noise can be compared");
        await set(page, "sigma", 0);
        assert.match(await bar(page), /distance to the original/);
        await page.locator('select[name="colours"]').selectOption("none");
        await settled(page);
        assert.equal(await page.locator(".lab-bar").count(), 0);
        assert.match(await fragment(page), /colours=none/);
    });

    /// Returns for each pane the share of width and height that the mesh covers, and whether it touches the rim.
    const coverage = async (page) => {
        await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
        return page.evaluate(async () => {
            const frame = document.querySelector(".lab-frame"), canvas = document.createElement("canvas"), inRows = document.querySelectorAll(".model-label")[1].offsetTop > 100;
            await frame.decode();
            const across = inRows ? 1 : 2, width = Math.floor(frame.naturalWidth / across), height = Math.floor(frame.naturalHeight / (3 - across));
            Object.assign(canvas, { width: frame.naturalWidth, height: frame.naturalHeight });
            const context = canvas.getContext("2d", { willReadFrequently: true });
            context.drawImage(frame, 0, 0);
            return [[0, 0], inRows ? [0, height] : [width, 0]].map(([x0, y0]) => {
                const { data } = context.getImageData(x0, y0, width, height), box = [width, height, 0, 0];
                for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) if (data[4 * (y * width + x) + 3] > 0) box[0] = Math.min(box[0], x), box[1] = Math.min(box[1], y), box[2] = Math.max(box[2], x + 1), box[3] = Math.max(box[3], y + 1);
                return { share: Math.max((box[2] - box[0]) / width, (box[3] - box[1]) / height), isCut: box[0] === 0 || box[1] === 0 || box[2] === width || box[3] === height };
            });
        });
    };

    test("a mesh fills 85 % of its pane, and is not cut when it is turned or blows up", async () => {
        const page = await opened("q6");
        const [first] = await coverage(page);
        assert.ok(first.share > 0.8 && first.share < 0.87, `${first.share}`);
        await page.locator(".lab-panel canvas").focus();
        for (let turn = 0; turn < 8; ++turn) {
            await page.keyboard.press(turn % 2 ? "ArrowRight" : "ArrowUp");
            for (const { share, isCut } of await coverage(page)) assert.ok(!isCut && share < 0.9, `turn ${turn}: ${share}`);
        }
        await page.evaluate(() => { location.hash = "#lab=q6,scheme=explicit,lambda=2,t=12"; });
        await settled(page);
        for (const { isCut } of await coverage(page)) assert.ok(!isCut);
        assert.deepEqual(problemsOf(page), []);
    });

    test("every slider plays, one at a time", async () => {
        const page = await opened("q5", { reducedMotion: "no-preference" }), value = async (name) => Number(await page.locator(`.lab-panel input[name="${name}"]`).inputValue());
        for (const [name, words] of [["sigma", "σ"], ["lambda", "λ"]]) {
            const first = await value(name);
            await page.getByRole("button", { name: `Play ${words}` }).click();
            await page.waitForTimeout(500);
            assert.ok(await value(name) > first, name);
        }
        assert.equal(await page.getByRole("button", { name: /^Pause/ }).count(), 1);
        await page.locator('select[name="scheme"]').selectOption("projection");
        await settled(page);
        assert.equal(await page.getByRole("button", { name: /^Pause/ }).count(), 0);
        const first = await value("k");
        await page.getByRole("button", { name: "Play k" }).click();
        await page.waitForTimeout(500);
        await page.getByRole("button", { name: "Pause k" }).click();
        assert.ok(await value("k") > first);
        assert.match(await page.locator(".lab-watch").textContent(), /Drag k: fewer waves/);
        await closed(page);
    });

    test("its gains are those of the report's table", async () => {
        const [head, ...rows] = readFileSync(path.join(reports.quick, "tables/q7_measures.csv"), "utf8").trim().split("\n");
        const page = await opened("q7"), { name } = dataOf(reportPage, "q7");
        const told = rows.map((row) => row.split(",")).filter(([mesh]) => mesh === name);
        assert.ok(told.length >= 2);
        // The columns are mesh, σ, and for each measure gain, λ and t.
        for (const [, sigma, ...found] of told) {
            for (const [place, measure] of ["surface", "places", "normals"].entries()) {
                const [gain, edges, t] = found.slice(3 * place);
                assert.match(head, new RegExp(`${measure}: gain`));
                if (!t || Number(t) === 0) continue;
                await page.evaluate((hash) => { location.hash = hash; }, `#lab=q7,scheme=denoising,edges=${edges},t=${t},sigma=${sigma},seed=1`);
                await settled(page);
                for (const shown of (await table(page))[`gain: ${measure} ×`])
                    assert.ok(Math.abs(numberIn(shown) / Number(gain) - 1) < 1e-3, `${measure} at ${sigma}: ${shown}`);
            }
        }
    });

    test("the preset nearest to the surface is the least of its curve, as far as the quick report went", async () => {
        const page = await opened("q7"), iterations = 16;
        await page.locator(".lab-presets a", { hasText: "nearest to the surface" }).click();
        await settled(page);
        const { change: state } = states.readLink(await fragment(page)), experiment = new Experiment(dataOf(reportPage, "q7"));
        experiment.set({ ...states.startOf(experiment.data, "q7"), ...state });
        const best = experiment.extendCurve(Infinity);
        assert.equal(state.t, Math.min(best, iterations));
        assert.match(await page.locator(".lab-told").textContent(), new RegExp(`Nearest to the clean surface at t = ${best}\\.`));
    });

    test("Taubin without a second step shows no result", async () => {
        const page = await opened("q5", { link: "#lab=q5,scheme=explicit,lambda=2,t=5" });
        await page.evaluate(() => { location.hash = "#lab=q5,scheme=taubin,lambda=10,t=3"; });
        await settled(page);
        assert.match(await page.locator(".lab-told").textContent(), /does not exist for so large a λ: nothing is filtered\.$/);
        for (const name of ["after", "filter"]) assert.equal(await page.locator(`path.lab-${name}`).first().getAttribute("d"), "", name);
        await set(page, "lambda", 0.5);
        assert.match(await page.locator("path.lab-after").getAttribute("d"), /^M/);
        assert.deepEqual(problemsOf(page), []);
    });

    test("what blows up while it plays stops, and is read out once", async () => {
        const page = await opened("q5", { reducedMotion: "no-preference", link: "#lab=q5,scheme=explicit,lambda=2,t=0" });
        await page.evaluate(() => {
            const told = document.querySelector(".lab-told");
            globalThis.readOut = [];
            globalThis.shown = [];
            new MutationObserver(() => (told.getAttribute("aria-live") === "polite" ? globalThis.readOut : globalThis.shown).push(told.textContent)).observe(told, { childList: true });
        });
        await page.getByRole("button", { name: "Play t" }).click();
        await page.getByRole("button", { name: "Play t" }).waitFor();
        await settled(page);
        const t = await page.locator('.lab-panel input[name="t"]').inputValue();
        assert.ok(Number(t) < states.shownSteps);
        const [readOut, shown] = await page.evaluate(() => [globalThis.readOut, globalThis.shown]);
        assert.equal(readOut.length, 1, readOut.join("\n"));
        assert.match(readOut[0], new RegExp(`no vertex is left in the view, and the play has stopped at t = ${t}\\.$`));
        assert.ok(shown.length > 1 && shown.every((words) => !words.includes("Blown up")), "the text follows meanwhile");
    });

    test("a preset ends the play, a second panel closes the first, and a link without noise has none", async () => {
        const page = await opened("q7", { reducedMotion: "no-preference" });
        await page.getByRole("button", { name: "Play t" }).click();
        await page.locator(".lab-presets a", { hasText: "four times as long" }).click();
        await settled(page);
        await page.waitForTimeout(300);
        const { t } = states.presetsOf(dataOf(reportPage, "q7"), "q7").find(({ words }) => words === "four times as long").state;
        assert.equal(await page.locator('.lab-panel input[name="t"]').inputValue(), String(t));
        await page.evaluate(() => { location.hash = "#lab=q7,sigma=0,t=3"; });
        await settled(page);
        assert.equal(await page.locator('.lab-panel input[name="sigma"]').inputValue(), "0");
        assert.match(await fragment(page), /sigma=0/);
        await block(page, "q4").getByRole("button", { name: "Open the live laboratory" }).click();
        await block(page, "q4").locator(".lab-panel").waitFor();
        await page.locator(".lab-panel").nth(1).waitFor({ state: "detached" });
    });

    test("plays over t and pauses; where motion is not wanted, a step at a time", async () => {
        const page = await opened("q5", { reducedMotion: "no-preference" }), t = page.locator('.lab-panel input[name="t"]');
        const first = Number(await t.inputValue());
        await page.getByRole("button", { name: "Play t" }).click();
        await page.waitForTimeout(1200);
        await page.getByRole("button", { name: "Pause t" }).click();
        const after = Number(await t.inputValue());
        assert.ok(after > first + 5, `${first} to ${after}`);
        await page.waitForTimeout(300);
        assert.equal(Number(await t.inputValue()), after);
        const still = await opened("q5");
        await still.getByRole("button", { name: "One step of t" }).click();
        assert.equal(Number(await still.locator('.lab-panel input[name="t"]').inputValue()), first + 1);
    });

    test("however fast a slider is moved, the last place counts", async () => {
        const page = await opened("q5"), data = dataOf(reportPage, "q5");
        await page.evaluate(() => {
            const slider = document.querySelector('.lab-panel input[name="lambda-slider"]');
            for (let i = 0; i <= 60; ++i) {
                slider.value = String(0.2 * i / 60);
                slider.dispatchEvent(new Event("input"));
            }
        });
        await settled(page);
        const state = { ...states.startOf(data, "q5"), lambda: 1 }, energy = lab.energy(data, lab.filtered(lab.filter(data, state), data.coefficients));
        assert.ok(Math.abs(numberIn((await table(page))["Dirichlet energy length²"][0]) / energy - 1) < 1e-5);
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
        assert.equal(await page.getByRole("button", { name: "Reset view" }).count(), 0);
        const figure = page.locator(await page.locator(".lab-no-view a").getAttribute("href"));
        assert.ok((await figure.locator("img").evaluateAll((pictures) => pictures.map(({ alt }) => alt).join())).includes("cube"));
        assert.ok(await page.locator('.lab-panel select[name="scheme"]').isVisible());
        await set(page, "t", "");
        assert.equal(await page.locator('.lab-panel input[name="t"]').inputValue(), "25", "an empty field changes nothing");
        const data = dataOf(reportPage, "q5"), state = { ...states.startOf(data, "q5"), t: 25 };
        const energy = lab.energy(data, lab.filtered(lab.filter(data, state), data.coefficients));
        assert.ok(Math.abs(numberIn((await table(page))["Dirichlet energy length²"][0]) / energy - 1) < 1e-5);
        await block(page, "q4").getByRole("button", { name: "Open the live laboratory" }).click();
        assert.match(await block(page, "q4").locator(".lab-no-view a").getAttribute("href"), /_reconstructions$/);
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
        assert.equal(await page.locator(".lab-panel :is(canvas, button):visible").count(), 0);
        assert.ok(await page.locator(".lab-told").isVisible());
        await closed(page);
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
            const unclear = await page.$$eval(".lab-plot", (plots) => plots.flatMap((plot) => {
                const words = [...plot.querySelectorAll("text")].filter((one) => one.textContent), boxes = words.map((one) => one.getBBox());
                const meet = (a, b) => a !== b && a.x < b.x + b.width && b.x < a.x + a.width && a.y + 6 < b.y + b.height && b.y + 6 < a.y + a.height;
                return words.filter((_, i) => boxes[i].x < 0 || boxes[i].x + boxes[i].width > plot.viewBox.baseVal.width || boxes.some((other) => meet(boxes[i], other))).map((one) => one.textContent);
            }));
            assert.deepEqual(unclear, [], "the plots' words are whole and apart");
            await closed(page);
        });
    }

    test("`meshfolio lab` makes a page of its own, under the same policy", async () => {
        run("sample", "cube", "-o", "cube.obj");
        run("lab", "cube.obj", "-o", "index.html");
        const page = await open(browser, folder, small), k = page.locator('.lab-panel input[name="k"]');
        await page.locator(".lab-tiles dd").first().waitFor();
        assert.equal(await k.inputValue(), "15");
        await page.keyboard.press("Escape");
        assert.equal(await page.getByRole("button", { name: "Close" }).count(), 0);
        assert.match(await page.locator(".lab-mesh").textContent(), /cube: 602 vertices, all 602 modes/);
        assert.match(await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', "content"), /^default-src 'none';/);
        assert.deepEqual(problemsOf(page), []);
        await page.context().close();
        const moving = await open(browser, folder, { ...small, reducedMotion: "no-preference", first: () => { globalThis.counts = []; setInterval(() => globalThis.counts.push(Number(document.querySelector('input[name="k"]')?.value)), 20); } });
        await moving.locator('.lab-play.playing').waitFor();
        await moving.locator('.lab-play.playing').waitFor({ state: "detached" });
        const counts = (await moving.evaluate(() => globalThis.counts)).filter(Number.isFinite), first = counts.findIndex((count) => count === 602);
        assert.ok(first >= 0 && counts.at(-1) === 15, "it opens with k running down from all modes");
        assert.ok(counts.slice(first).every((count, i, all) => i === 0 || count <= all[i - 1]));
        await moving.context().close();
    });
});

test("the data stands once, in the report alone, and weighs at most 2.2 MB", options, () => {
    const scripts = reportPage.match(/<script type="application\/x-meshfolio-lab"[^>]*>[^<]*/g);
    assert.equal(scripts.map((one) => one.match(/data-questions="([^"]*)"/)[1]).join(" ").split(" ").sort().join(" "), "q4 q5 q6 q7");
    assert.equal(scripts.length, 3);
    assert.ok(scripts.join("").length <= 2.2e6, `${scripts.join("").length} bytes`);
    assert.ok(!readFileSync(path.join(reports.quick, "appendix.html"), "utf8").includes("x-meshfolio-lab"));
});
