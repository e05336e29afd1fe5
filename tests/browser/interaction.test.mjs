// The functions of the scripts: pictures in full size, colour scheme, by keyboard and by pointer.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, describe, test } from "node:test";
import { launch, open, reports } from "./browser.mjs";

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

const shown = (page) => page.$eval(".lightbox .stage img", (image) => image.getAttribute("src"));
const captionOf = async (page, n) => (await page.locator("#q1 figure.picture figcaption b").nth(n).textContent()).replace(/\.$/, "");
const loaded = (page) => page.waitForFunction(() => {
    const image = document.querySelector(".lightbox .stage img");
    return image.complete && image.naturalWidth > 0;
});

describe("pictures in full size", () => {
    let page;
    before(async () => { page = await open(browser, reports.quick); });
    after(() => page.context().close());

    const place = () => page.locator(".lightbox .where").textContent();
    const closed = async () => {
        await page.keyboard.press("Escape");
        assert.equal(await page.locator(".lightbox").evaluate((dialog) => dialog.open), false);
    };

    test("by keyboard: the sheet, its views, the next figure, close, and back where one was", async () => {
        const link = page.locator("#q1 figure.picture .files a.sheet").first();
        await link.focus();
        await page.keyboard.press("Enter");
        await loaded(page);
        const first = await shown(page);
        assert.equal(first, await link.getAttribute("href"));
        assert.ok(first.startsWith("images/") && first.endsWith("_sheet.png"), "the file, not the preview");
        for (const pattern of [/^data:image/, /_%2Bx\.png$/]) {
            await page.keyboard.press("ArrowRight");
            await loaded(page);
            assert.match(await shown(page), pattern);
        }
        for (const back of [1, 2]) await page.keyboard.press("ArrowLeft");
        assert.equal(await shown(page), first);
        await page.keyboard.press("ArrowDown");
        await loaded(page);
        assert.ok((await place()).startsWith(await captionOf(page, 1)));
        await page.keyboard.press("ArrowUp");
        assert.ok((await place()).startsWith(await captionOf(page, 0)));
        await closed();
        assert.ok(await link.evaluate((element) => element === document.activeElement), "focus is back");
        assert.deepEqual(page.problems, []);
    });

    test("by pointer: a single view, the next figure, the cross", async () => {
        const figure = page.locator("#q1 figure.picture").first();
        await figure.locator("details.views summary").click();
        await figure.locator(".views a").nth(2).click();
        await loaded(page);
        assert.equal(await shown(page), await figure.locator(".views a").nth(2).getAttribute("href"));
        await page.getByRole("button", { name: "Next figure" }).click();
        assert.ok((await place()).startsWith(await captionOf(page, 1)));
        await page.getByRole("button", { name: "Close" }).click();
        assert.equal(await page.locator(".lightbox").evaluate((dialog) => dialog.open), false);
    });

    for (const width of [390, 1400]) test(`what is tapped opens itself, with the figure's legend and caption, and not smaller, at ${width} pixels`, async () => {
        await page.setViewportSize({ width, height: 844 });
        const figure = page.locator("#q1 figure.picture:has(svg.legend):has(.direction)").first();
        for (const picture of [figure.locator(".large img").first(), figure.locator(".direction img").nth(1)]) {
            await picture.scrollIntoViewIfNeeded();
            const [onPage, source] = [await picture.boundingBox(), await picture.evaluate((image) => image.closest("a")?.getAttribute("href") ?? image.getAttribute("src"))];
            await picture.click();
            await loaded(page);
            await page.waitForFunction(() => document.querySelector(".lightbox .part").offsetWidth > 0);
            assert.equal(await shown(page), source);
            const large = await page.locator(".lightbox .part").boundingBox();
            assert.ok(large.width >= onPage.width - 1 && large.height >= 0.95 * onPage.height, `${large.width}, ${onPage.width} on the page`);
            assert.equal(await page.locator(".lightbox .legend-box svg").count(), 1);
            assert.equal(await page.locator(".lightbox .caption").textContent(), await figure.locator("figcaption .text").textContent());
            await page.getByRole("button", { name: "Zoom" }).click();
            const { width: zoomed, natural } = await page.$eval(".lightbox img", (image) => ({ width: image.offsetWidth, natural: image.naturalWidth }));
            assert.ok(zoomed >= natural && zoomed > 1.5 * large.width, "a pixel for a pixel, or twice as large");
            await closed();
            assert.equal(await page.evaluate(() => document.activeElement.closest("figure")?.id), await figure.getAttribute("id"), "where one can go on");
        }
        await page.setViewportSize({ width: 1280, height: 900 });
    });

    test("a finger that moves sideways turns to the next view", async () => {
        const before = await page.locator("#q1 figure.picture .large img").first();
        await before.click();
        const swipe = (from, to) => page.$eval(".lightbox .stage", (stage, [x0, x1]) => {
            for (const [type, clientX] of [["pointerdown", x0], ["pointerup", x1]])
                stage.dispatchEvent(new PointerEvent(type, { pointerType: "touch", isPrimary: true, clientX, clientY: 300, bubbles: true }));
        }, [from, to]);
        assert.match(await place(), /\(1 of/);
        await swipe(300, 100);
        assert.match(await place(), /\(2 of/);
        await swipe(100, 300);
        assert.match(await place(), /\(1 of/);
        await swipe(300, 290);
        assert.match(await place(), /\(1 of/, "a tap is none");
        await closed();
    });

    test("a link is still a link for whoever wants another window", async () => {
        const [other] = await Promise.all([
            page.context().waitForEvent("page"),
            page.locator("#q1 figure.picture .files a.sheet").first().click({ modifiers: ["Control"] })]);
        await other.waitForURL(/_sheet\.png$/, { waitUntil: "commit" });   // it opens empty
        await other.close();
    });

    test("where images/ is not beside the page the preview is shown, and that is said", async () => {
        const folder = mkdtempSync(path.join(tmpdir(), "meshfolio-page-"));
        cpSync(path.join(reports.quick, "index.html"), path.join(folder, "index.html"));
        const alone = await open(browser, folder);
        await alone.locator("#q1 figure.picture .plate a img").first().click();
        await alone.waitForFunction(() => document.querySelector(".lightbox .stage img").src.startsWith("data:image/jpeg"));
        await loaded(alone);
        assert.match(await alone.locator(".lightbox .where").textContent(), /only the preview/);
        await alone.context().close();
        rmSync(folder, { recursive: true });
    });
});

describe("the scheme", () => {
    const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = "rgb(255, 255, 255)";

    test("is the system's until the button says otherwise, and is remembered", async () => {
        for (const scheme of ["light", "dark"]) {
            const page = await open(browser, reports.hostile, { colorScheme: scheme });
            assert.equal(await ground(page) === light, scheme === "light");
            const button = page.locator("button.scheme");
            await button.focus();
            await page.keyboard.press("Enter");
            assert.equal(await ground(page) === light, scheme === "dark");
            assert.match(await button.getAttribute("aria-label"), new RegExp(`to the ${scheme} scheme`));
            await page.reload();
            assert.equal(await ground(page) === light, scheme === "dark", "after a reload");
            await button.click();
            assert.equal(await ground(page) === light, scheme === "light");
            assert.deepEqual(page.problems, []);
            await page.context().close();
        }
    });

    test("plots follow it", async () => {
        const page = await open(browser, reports.quick, { colorScheme: "dark" });
        const stroke = () => page.locator("svg.plot path[stroke^='var(--plot-1']").first().evaluate((path) => getComputedStyle(path).stroke);
        const dark = await stroke();
        await page.locator("button.scheme").click();
        assert.notEqual(await stroke(), dark);
        await page.context().close();
    });
});
