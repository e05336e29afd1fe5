// The page as it is when it has been opened: complete, in order, and without anything from elsewhere.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { launch, open, reports, volumes } from "./browser.mjs";

let browser, report, appendix, questions;   // questions: "q1", …
before(async () => {
    browser = await launch();
    report = await open(browser, reports.quick, { viewport: { width: 1440, height: 900 } });
    appendix = await open(browser, reports.quick, { viewport: { width: 1440, height: 900 }, volume: "appendix.html" });
    questions = await report.$$eval("ol.attempted > li div > a:first-child", (links) => links.map((link) => link.hash.slice(1)));
});
after(() => browser.close());

test("title, picture, score and the first answers are seen at once", async () => {
    for (const selector of ["h1", ".cover img", ".score", "ol.attempted > li:nth-child(3)"]) {
        const { top, bottom } = await report.$eval(selector, (element) => element.getBoundingClientRect().toJSON());
        assert.ok(top >= 0 && bottom <= 900, `${selector} reaches from ${top} to ${bottom}`);
    }
    assert.deepEqual(questions, questions.map((_, i) => `q${i + 1}`));
    assert.ok(questions.length >= 7, questions);
});

test("each question begins with the answer that the table has", async () => {
    const answers = await report.$$eval("ol.attempted > li", (items) => items.map((item) =>
        [item.querySelector("a").hash, item.querySelector("p").textContent.trim()]));
    for (const [hash, answer] of answers) {
        assert.ok(answer.length > 20, hash);
        assert.equal(await report.$eval(`${hash} > p`, (first) => `${first.className}: ${first.textContent.trim()}`), `answer: ${answer}`);
    }
});

test("the questions are the report, all else is in the appendix, the list of all checks last", async () => {
    const sections = (volume) => volume.$$eval("main section", (all) => all.map((section) => section.id));
    assert.deepEqual(await sections(report), ["questions-attempted", ...questions, "cited-works"]);
    const ids = await sections(appendix), truth = ids.indexOf("truth");
    assert.ok(ids.slice(0, truth).every((id) => /^q\d+-further$/.test(id)), ids);
    assert.equal(ids.at(-1), "all-checks");
    assert.ok(ids.indexOf("where-from") > ids.indexOf("cited-works") && ids.indexOf("cited-works") > truth);
});

test("the contents list what the page has, in its order", async () => {
    for (const volume of [report, appendix]) {
        const listed = await volume.$$eval('.contents > ol > li > a[href^="#"]:not(.try)', (links) => links.map((link) => link.hash.slice(1)));
        assert.deepEqual(listed, await volume.$$eval("main section", (all) => all.map((section) => section.id)));
    }
});

for (const volume of volumes) test(`every link within ${volume} lands where it is seen`, async () => {
    const page = await open(browser, reports.quick, { viewport: { width: 1440, height: 900 }, volume });
    const lost = await page.evaluate(() => {
        const missed = [];
        for (const link of document.querySelectorAll('a[href^="#"]')) {
            const target = document.getElementById(decodeURIComponent(link.getAttribute("href").slice(1)));
            if (!target) missed.push(`${link.textContent} leads nowhere`);
        }
        return missed;
    });
    assert.deepEqual(lost, []);
    const links = ['.contents > ol > li > a[href^="#"]:not(.try)', '.attempted a[href^="#"]:not(.try)'];
    const addressed = await page.$$eval(links.join(), (all) => all.map((link) => [link.closest(".contents") ? ".contents" : ".attempted", link.hash]));
    for (const [list, hash] of addressed) {
        await page.locator(`${list} a[href="${hash}"]`).first().click();
        await page.evaluate(() => new Promise((done) => setTimeout(() => requestAnimationFrame(done))));   // what is folded opens after the click
        const { id, top } = await page.evaluate(() => {
            const target = document.getElementById(location.hash.slice(1));
            return { id: target.id, top: target.getBoundingClientRect().top, open: target.open };
        });
        const end = await page.evaluate(() => scrollY + innerHeight >= document.documentElement.scrollHeight - 1);
        assert.ok(top > -2 && (top < 60 || (end && top < 900)), `${id} is at ${top}`);
    }
    await page.context().close();
});

test("a link into the other volume lands where it is seen", async () => {
    for (const [from, selector] of [[report, 'main a[href^="appendix.html#"]'], [appendix, 'main a[href^="index.html#"]']]) {
        const links = await from.$$eval(selector, (all) => [...new Set(all.map((link) => link.getAttribute("href")))]);
        assert.ok(links.length > 1, `${links.length} links`);
        const other = await from.context().newPage();
        for (const link of links) {
            await other.goto(pathToFileURL(path.join(reports.quick, link.split("#")[0])).href + "#" + link.split("#")[1]);
            const seen = await other.evaluate(() => {
                const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
                return target && target.checkVisibility() && target.getBoundingClientRect().top;
            });
            assert.ok(typeof seen === "number" && seen > -2 && seen < 900, `${link} is at ${seen}`);
        }
        await other.close();
    }
});

test("the contents list follows the scroll and shows the parts of what is read", async () => {
    for (const [page, id] of [[report, "q1"], [report, "q5"], [appendix, "truth"], [appendix, "methods"], [appendix, "all-checks"]]) {
        await page.evaluate((name) => document.getElementById(name).scrollIntoView(), id);
        await page.waitForFunction((name) => document.querySelector(".contents .current > a")?.hash === `#${name}`, id);
        const seen = await page.$$eval(".contents a", (links) => ({
            current: links.filter((link) => link.ariaCurrent === "true").map((link) => link.hash),
            parts: links.filter((link) => link.closest(".parts") && link.checkVisibility()).map((link) => link.hash),
        }));
        assert.equal(seen.current.length, 1);
        const number = await page.$eval(`.contents a[href="#${id}"]`, (link) => link.querySelector(".number")?.textContent);
        for (const part of seen.parts) assert.ok(part.startsWith(`#section-${number}.`), `${part} is shown in ${id}`);
        assert.equal(seen.parts.length > 0, number !== undefined, `parts of ${id}`);
    }
    await report.evaluate(() => document.querySelector("#q5 h3:nth-of-type(2)").scrollIntoView());
    await report.waitForFunction(() => document.querySelector('.contents a[aria-current]')?.hash === "#section-5.2");
});

test("whatever is scrolled past: no error and no request beyond the page and its pictures", async () => {
    for (const [folder, volume] of [reports.quick, reports.hostile].flatMap((folder) => volumes.map((volume) => [folder, volume]))) {
        const other = await open(browser, folder, { volume });
        const height = await other.evaluate(() => document.documentElement.scrollHeight);
        for (let y = 0; y < height; y += 5000) await other.evaluate((top) => scrollTo(0, top), y);
        const blank = await other.$$eval("main img", (images) => images.filter((image) => image.complete && !image.naturalWidth).length);
        assert.equal(blank, 0, "pictures without content");
        assert.deepEqual(other.problems, []);
        await other.context().close();
    }
});

for (const volume of volumes) test(`hostile names stay text in ${volume}`, async () => {
    const other = await open(browser, reports.hostile, { volume });
    assert.match(await other.locator("h1").textContent(), /^(Appendix to “)?<script>alert\(1\)<\/script>"'<\/style>\{\{title\}\} \]\]> <img/);
    assert.equal(await other.locator("main :is(script:not(.models > script), style, iframe, img:not(.plate img))").count(), 0);
    for (const { type, text } of await other.$$eval("main .models > script", (all) => all.map((one) => ({ type: one.type, text: one.textContent })))) {
        assert.equal(type, "model/gltf-binary", "data, which no browser runs");
        assert.match(text, /^[A-Za-z0-9+/]+=*$/);
    }
    assert.deepEqual(other.problems, []);
    await other.context().close();
});

for (const volume of volumes) test(`without JavaScript nothing is missing in ${volume} and nothing is there that does nothing`, async () => {
    const page = volume === volumes[0] ? report : appendix;
    const plain = await open(browser, reports.quick, { javaScriptEnabled: false, volume });
    const unseen = await plain.evaluate(() => {
        const cutAway = [...document.querySelectorAll("main, main *")].filter((element) => {   // and with it whatever is in it
            const { clipPath, overflowX, overflowY } = getComputedStyle(element);
            if (element.ownerSVGElement) return false;
            return clipPath !== "none" || (`${overflowX}${overflowY}` !== "visiblevisible" && (element.clientWidth < 2 || element.clientHeight < 2));
        });
        const range = document.createRange();
        const seen = (element) => {
            if (!element.checkVisibility({ visibilityProperty: true, opacityProperty: true })) return false;
            if (cutAway.some((box) => box.contains(element))) return false;
            const picture = element.matches("img, svg"), { color, fontSize } = getComputedStyle(element);
            if (!picture && element.textContent.trim() === "") return true;
            if (!picture) range.selectNodeContents(element);
            const { width, height, right, bottom } = (picture ? element : range).getBoundingClientRect();
            return width > 2 && height > 2 && right + scrollX > 0 && bottom + scrollY > 0
                && (picture || (parseFloat(fontSize) >= 8 && !/^rgba\(.*, 0\)$/.test(color)));
        };
        return [...document.querySelectorAll("main :is(p, li, td, th, dt, dd, summary, img, svg, math, h1, h2, h3, figcaption)")]
            .filter((element) => !element.closest("details:not([open]) > :not(summary)") && !seen(element)).map((element) => element.outerHTML.slice(0, 80));
    });
    assert.deepEqual(unseen.slice(0, 5), []);
    assert.equal(await plain.locator("button, dialog, input, select").count(), 0);
    const words = (where) => where.evaluate(() => {
        const copy = document.querySelector("main").cloneNode(true);
        for (const tool of copy.querySelectorAll(".table-tools, .model-button, .model-note, script")) tool.remove();
        return copy.textContent.replace(/\s+/g, "");
    });
    const [without, complete] = [await words(plain), await words(page)];
    const at = [...complete].findIndex((letter, i) => letter !== without[i]);
    assert.ok(without === complete, `from here on it differs: ${complete.slice(at, at + 80)}, without JavaScript: ${without.slice(at, at + 80)}`);
    assert.ok(complete.length > 25000, "and it is the whole volume");
    assert.deepEqual(plain.problems, []);
    await plain.context().close();
});

test("on a telephone the contents unfold by their button, and a link folds them again", async () => {
    const narrow = await open(browser, reports.hostile, { viewport: { width: 360, height: 740 } });
    const link = narrow.locator('.contents a[href="#q5"]'), button = narrow.getByRole("button", { name: "Contents" });
    assert.equal(await link.isVisible(), false);
    await button.focus();
    await narrow.keyboard.press("Enter");
    assert.equal(await button.getAttribute("aria-expanded"), "true");
    await link.click();
    assert.equal(await link.isVisible(), false);
    assert.equal(await narrow.evaluate(() => location.hash), "#q5");
    await narrow.context().close();
    const plain = await open(browser, reports.hostile, { viewport: { width: 360, height: 740 }, javaScriptEnabled: false });
    assert.ok(await plain.locator('.contents a[href="#q5"]').isVisible(), "without a script it is not folded");
    await plain.context().close();
});
