// From a telephone to a wide screen, on paper, and for whoever does not see it: nothing is cut off, nothing is out of reach.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { launch, open, reports, volumes } from "./browser.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/// What reaches beyond the window, apart from what scrolls within its box.
const beyond = (page) => page.evaluate(() => {
    const width = document.documentElement.clientWidth;
    return [...document.querySelectorAll("body *")]
        .filter((element) => !element.closest(".scroll > *, .skip, svg, math, dialog"))
        .filter((element) => { const box = element.getBoundingClientRect(); return box.width > 0 && (box.right > width + 1 || box.left < -1); })
        .map((element) => `${element.tagName}.${element.className} ${element.textContent.trim().slice(0, 40)}`);
});

describe("no sideways scrolling and nothing cut off", () => {
    for (const [name, folder] of Object.entries(reports)) for (const volume of volumes) test(`${name}, ${volume}`, async () => {
        const page = await open(browser, folder, { volume, viewport: { width: 360, height: 900 } });
        for (const width of [360, 390, 768, 1280, 1920]) {
            await page.setViewportSize({ width, height: 900 });
            assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
            assert.deepEqual((await beyond(page)).slice(0, 5), [], `${width} pixels`);
            const cut = await page.$$eval("main :is(p, h1, h2, h3, figcaption, .panel-name, .badge)", (elements) => elements
                .filter((element) => getComputedStyle(element).overflow === "hidden" && element.scrollWidth > element.clientWidth + 1)
                .map((element) => element.textContent.slice(0, 60)));
            assert.deepEqual(cut, [], `${width} pixels`);
        }
        await page.context().close();
    });
});

describe("words and figures", () => {
    const pages = {};
    before(async () => { for (const volume of volumes) pages[volume] = await open(browser, reports.quick, { volume }); });
    after(async () => { for (const page of Object.values(pages)) await page.context().close(); });
    const at = async (width, volume = "index.html") => {
        await pages[volume].setViewportSize({ width, height: 900 });
        return pages[volume];
    };

    test("lines of text are about 66 characters long", async () => {
        const lengths = await (await at(1440)).$$eval("section.question > p:not([class])", (paragraphs) => paragraphs
            .map((p) => p.textContent.length / Math.max(1, Math.round(p.getBoundingClientRect().height / parseFloat(getComputedStyle(p).lineHeight))))
            .sort((a, b) => a - b));
        const longest = lengths.at(Math.floor(0.9 * lengths.length));
        assert.ok(longest > 50 && longest < 82, `${longest} characters a line`);
    });

    for (const volume of volumes) test(`words in plots of ${volume} stay within the picture`, async () => {
        const cut = await (await at(1280, volume)).$$eval("svg.plot", (plots) => plots.flatMap((plot) => [...plot.querySelectorAll("text")].filter((text) => {
            const box = text.getBBox(), frame = plot.viewBox.baseVal;
            return box.x < -2 || box.y < -2 || box.x + box.width > frame.width + 2 || box.y + box.height > frame.height + 2;
        }).map((text) => `${plot.closest("figure").id}: ${text.textContent}`)));
        assert.deepEqual(cut, []);
    });

    for (const width of [390, 1400]) {
        test(`every word is text of at least 12 pixels, at ${width} pixels`, async () => {
            const small = await (await at(width)).$$eval("figure.picture", (figures) => figures.flatMap((figure) =>
                [...figure.querySelectorAll("p, figcaption, span, a, summary, svg text")].filter((element) => element.checkVisibility()).map((element) => {
                    const scale = element.ownerSVGElement ? element.getScreenCTM().a : 1;
                    return [scale * parseFloat(getComputedStyle(element).fontSize), `${figure.id}: ${element.textContent.slice(0, 30)}`];
                })).filter(([size]) => size < 12));
            assert.deepEqual(small.slice(0, 5), []);
        });

        test(`the six views of a mesh have one scale, at ${width} pixels`, async () => {
            const uneven = await (await at(width)).$$eval(".directions", (all) => all.filter((directions) => {
                const scales = [...directions.querySelectorAll("img")].filter((image) => image.width > 30).map((image) => image.getBoundingClientRect().width / Number(image.getAttribute("width")));
                return scales.length > 0 && Math.max(...scales) > 1.06 * Math.min(...scales);
            }).map((directions) => directions.closest("figure").id));
            assert.deepEqual(uneven, []);
        });
    }

    test("on a telephone the large picture has the whole width and the views are three in a line", async () => {
        const lead = (await at(390, "appendix.html")).locator(".lead:has(.direction)").first();
        const [width, views] = await lead.evaluate((one) => [one.getBoundingClientRect().width,
            [...one.querySelectorAll(".direction")].map((view) => Math.round(view.getBoundingClientRect().top))]);
        assert.ok((await lead.locator(".large").boundingBox()).width > 0.95 * width);
        assert.equal(views.length, 6);
        assert.equal(new Set(views).size, 2);
    });

    test("pictures stand on white and the words beside them can be read, in the dark", async () => {
        const page = await at(1280);
        await page.emulateMedia({ colorScheme: "dark" });
        const [plate, words] = await page.$eval("figure.picture:has(svg.legend)", (figure) =>
            [getComputedStyle(figure.querySelector(".plate")).backgroundColor, getComputedStyle(figure.querySelector("svg.legend text")).fill]);
        assert.equal(plate, "rgb(255, 255, 255)");
        assert.ok(words.match(/\d+/g).every((channel) => Number(channel) < 60), words);
    });
});

test("on paper: light, complete, without what is only for the screen", async () => {
    const page = await open(browser, reports.quick, { viewport: { width: 680, height: 1000 }, colorScheme: "dark" });
    await page.locator("button.scheme").click();
    await page.locator("button.scheme").click();   // dark by choice, not only by the system
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).color), "rgb(28, 29, 33)");
    for (const gone of [".contents", "button:not(.sort)", "select"]) assert.equal(await page.locator(`${gone}:visible`).count(), 0, gone);
    const folded = await page.$$eval("main :is(p, td, th, img, svg, figcaption)", (elements) => elements
        .filter((element) => !element.closest("details.views, .files") && !element.checkVisibility()).map((element) => element.textContent.slice(0, 60)));
    assert.deepEqual(folded.slice(0, 5), []);
    assert.deepEqual((await beyond(page)).slice(0, 5), []);
    await page.context().close();
});

describe("axe finds nothing, by WCAG 2.1 A and AA and by its best practices", () => {
    /// Of contrast, which takes most of the time, one element with words of each kind: letters of a colour, size and weight on a ground. Rows
    /// of a table and marks of a plot are alike: four of each. The schemes differ in colours alone.
    const check = async (page, colorScheme) => {
        await page.evaluate(axe);   // from outside: the page's own policy would not let it in
        const violations = await page.evaluate(async (scheme) => {
            for (const alike of document.querySelectorAll("tbody tr:nth-child(n + 5), svg.plot g > :nth-child(n + 5)")) alike.remove();
            const kinds = new Map(), plain = "rgba(0, 0, 0, 0)";
            for (const element of document.querySelectorAll("body :not(svg, svg *, script, style)")) {
                if (!element.checkVisibility() || ![...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.data.trim())) continue;
                const { color, fontSize, fontWeight, opacity } = getComputedStyle(element), grounds = [];
                for (let at = element; at; at = at.parentElement) grounds.push(getComputedStyle(at).backgroundColor);
                const kind = [color, fontSize, fontWeight, opacity, element.disabled, ...grounds.filter((ground) => ground !== plain)].join();
                if (!kinds.has(kind)) kinds.set(kind, element);
            }
            const contrast = { type: "rule", values: ["color-contrast"] }, resultTypes = ["violations"];
            const all = [await axe.run({ include: [...kinds.values()] }, { runOnly: contrast, resultTypes })];
            const runOnly = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"], rules = { "color-contrast": { enabled: false } };
            if (scheme === "light") all.push(await axe.run(document, { runOnly, rules, resultTypes }));
            return all.flatMap((result) => result.violations.map(({ id, help, nodes }) => ({ id, help, nodes: nodes.map(({ html }) => ({ html })) })));
        }, colorScheme);
        return violations.map(({ id, help, nodes }) => `${id}: ${help}: ${nodes.slice(0, 3).map((node) => node.html.slice(0, 120)).join(" … ")}`);
    };
    for (const colorScheme of ["light", "dark"]) {
        for (const volume of volumes) test(`${volume} in the ${colorScheme} scheme`, async () => {
            const page = await open(browser, reports.quick, { colorScheme, volume });
            await page.$$eval("details", (all) => { for (const one of all) one.open = true; });
            assert.deepEqual(await check(page, colorScheme), []);
            await page.context().close();
        });
        test(`in the ${colorScheme} scheme, a picture open in full size`, async () => {
            const page = await open(browser, reports.hostile, { colorScheme });
            await page.locator("figure.picture .plate img").first().click();
            assert.deepEqual(await check(page, colorScheme), []);
            await page.context().close();
        });
    }
});
