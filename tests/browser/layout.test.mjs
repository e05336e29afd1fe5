// The layout from phones to wide screens, on paper and for screen readers: nothing is cut off or out of reach.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { launch, open, reports, volumes } from "./browser.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/// Returns the elements that reach beyond the window, except those that scroll within a box.
const beyond = (page) => page.evaluate(() => {
    const width = document.documentElement.clientWidth;
    return [...document.querySelectorAll("body *")]
        .filter((element) => !element.closest(".scroll > *, .plate > :is(.blocks, .cells) > *, .skip, svg, math, dialog"))
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

    test("lines of text are at most 80 characters long", async () => {
        const lengths = await (await at(1440)).$$eval("section.question > p:not([class])", (paragraphs) => paragraphs
            .map((p) => p.textContent.length / Math.max(1, Math.round(p.getBoundingClientRect().height / parseFloat(getComputedStyle(p).lineHeight))))
            .sort((a, b) => a - b));
        const longest = lengths.at(Math.floor(0.9 * lengths.length));
        assert.ok(longest > 50 && longest <= 80, `${longest} characters a line`);
    });

    for (const volume of volumes) test(`words in plots of ${volume} stay within the picture`, async () => {
        const cut = await (await at(1280, volume)).$$eval("svg.plot", (plots) => plots.flatMap((plot) => [...plot.querySelectorAll("text")].filter((text) => {
            const box = text.getBBox(), frame = plot.viewBox.baseVal;
            return box.x < -2 || box.y < -2 || box.x + box.width > frame.width + 2 || box.y + box.height > frame.height + 2;
        }).map((text) => `${plot.closest("figure").id}: ${text.textContent}`)));
        assert.deepEqual(cut, []);
    });

    for (const volume of volumes) test(`two widths at 1400 pixels in ${volume}: that of the text and the whole one, and notes in the margin`, async () => {
        const page = await at(1400, volume), text = await page.$eval("main > section > p", (p) => p.getBoundingClientRect().width);
        const odd = await page.$$eval("main > section > *", (all, measure) => {
            const { left, right } = document.querySelector("main").getBoundingClientRect();
            return all.filter((element) => element.checkVisibility() && !element.matches(".equation")).map((element) => [element, element.getBoundingClientRect()])
                .filter(([, box]) => !(Math.abs(box.left - left) < 1 && (box.width < measure + 1 || Math.abs(box.right - right) < 1)))   // text, all
                .filter(([, box]) => !(box.left >= left + measure && Math.abs(box.right - right) < 1))                                 // margin
                .map(([element]) => `${element.tagName}.${element.className}#${element.id}`);
        }, text);
        assert.deepEqual(odd, []);
        assert.ok(text > 560 && text < 700, `${text} pixels`);
        const below = await page.$$eval("figure.plot", (plots) => plots.filter((plot) =>
            plot.querySelector("figcaption").getBoundingClientRect().left < plot.querySelector("svg").getBoundingClientRect().right).map(({ id }) => id));
        assert.deepEqual(below, [], "captions of plots stand beside them");
    });

    for (const javaScriptEnabled of [true, false]) test(`on a telephone a figure is a strip to swipe, its legend with it, with${javaScriptEnabled ? "" : "out"} JavaScript`, async () => {
        const page = await open(browser, reports.quick, { viewport: { width: 390, height: 844 }, javaScriptEnabled });
        for (const plate of await page.locator("figure.picture .plate").all()) await plate.scrollIntoViewIfNeeded();
        await page.waitForTimeout(100);
        const figures = await page.$$eval("figure.picture .plate", (plates) => plates.map((plate) => ({
            id: plate.closest("figure").id, height: plate.getBoundingClientRect().height, pictures: plate.querySelectorAll(".block, .panel").length,
            strip: [...plate.querySelectorAll(":scope > :is(.blocks, .cells, .scroll)")].map((strip) => ({ swiped: strip.scrollWidth - strip.clientWidth, name: strip.tabIndex >= 0 && strip.ariaLabel })) })));
        for (const { id, height, pictures, strip: [strip] } of figures) {
            assert.ok(height < 1.4 * 844, `${id} is ${height} pixels high`);
            if (pictures > 4) assert.ok(strip.swiped > 50, `${id} has all ${pictures} below each other`);
            if (javaScriptEnabled && strip.swiped > 1) assert.match(strip.name, /Figure \d/, `${id} can be reached by keyboard`);
        }
        await page.context().close();
    });

    for (const width of [390, 1000]) test(`at ${width} pixels a bar stays and names what is read; it opens to lines of 44 pixels`, async () => {
        const page = await open(browser, reports.quick, { viewport: { width, height: 844 } });
        await page.evaluate(() => document.getElementById("q5").scrollIntoView());
        const bar = page.getByRole("button", { name: "Contents" });
        await page.waitForFunction(() => /^5 /.test(document.querySelector(".unfold .now").textContent));
        const box = await bar.boundingBox();
        assert.ok(box.y >= -1 && box.y < 10 && box.height >= 44, JSON.stringify(box));
        assert.ok(await page.$eval("#q5", (section) => section.getBoundingClientRect().top) >= box.height - 1, "the heading is not behind it");
        await bar.click();
        const links = await page.$$eval(".contents a", (all) => all.filter((a) => a.checkVisibility()).map((a) => a.getBoundingClientRect().toJSON()));
        assert.ok(links[0].top >= box.y + box.height - 1, "below the bar");
        assert.ok(links.length >= 10 && links.every(({ height }) => height >= 44));
        assert.ok(links.every(({ top }, i) => i === 0 || top >= links[i - 1].bottom - 1), "one a line");
        await page.keyboard.press("Escape");
        assert.equal(await bar.getAttribute("aria-expanded"), "false");
        await page.context().close();
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

    test("in the dark pictures have the page's ground, and the words beside them its colour", async () => {
        const page = await open(browser, reports.quick, { viewport: { width: 1280, height: 900 }, colorScheme: "dark" });
        const picture = page.locator("figure.picture:has(svg.legend) .large img").first();
        await picture.scrollIntoViewIfNeeded();
        const [box, png] = [await picture.boundingBox(), (await page.screenshot()).toString("base64")];
        const blank = await page.context().newPage();
        const [corner, middle, beside] = await blank.evaluate(async ([source, { x, y, width, height }]) => {
            const image = Object.assign(new Image(), { src: `data:image/png;base64,${source}` });
            await image.decode();
            const context = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }).getContext("2d");
            context.drawImage(image, 0, 0);
            return [[x + 3, y + 3], [x + width / 2, y + height / 2], [x - 6, y + 3]].map(([u, v]) => [...context.getImageData(u, v, 1, 1).data]);
        }, [png, box]);
        assert.deepEqual(corner, beside);
        assert.ok(Math.max(...corner.slice(0, 3)) < 60, corner);
        assert.ok(Math.max(...middle.slice(0, 3)) > 90, middle);
        const words = await page.$eval("svg.legend text", (text) => getComputedStyle(text).fill);
        assert.ok(words.match(/\d+/g).every((channel) => Number(channel) > 200), words);
        await page.context().close();
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
        .filter((element) => !element.closest("details.views, .model-files, .files, .volumes, .beside, .lab") && !element.checkVisibility()).map((element) => element.textContent.slice(0, 60)));
    assert.deepEqual(folded.slice(0, 5), []);
    assert.equal(await page.locator("ol.attempted").evaluate((list) => getComputedStyle(list).columnCount), "2", "the summary");
    assert.match(await page.locator("header.title").evaluate((header) => getComputedStyle(header, "::after").content), /report\.pdf/);
    assert.deepEqual((await beyond(page)).slice(0, 5), []);
    await page.context().close();
});

describe("axe finds nothing, by WCAG 2.1 A and AA and by its best practices", () => {
    /// Checks contrast, which takes most of the time, for one element of each colour, size and weight on each ground, and for four rows of a
    /// table and four marks of a plot.
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
        test(`in the ${colorScheme} scheme, on a telephone with the contents open`, async () => {
            const page = await open(browser, reports.quick, { colorScheme, viewport: { width: 390, height: 844 } });
            await page.getByRole("button", { name: "Contents" }).click();
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
