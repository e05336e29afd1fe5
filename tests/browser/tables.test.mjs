// Tables that are sorted and filtered, driven on the ledger of claims.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, reports } from "./browser.mjs";

let browser, page, ledger;
before(async () => {
    browser = await launch();
    page = await open(browser, reports.quick, { volume: "appendix.html" });
    ledger = page.locator("#claims_ledger");
    await ledger.scrollIntoViewIfNeeded();   // its tools are made when it is nearly seen
});
after(() => browser.close());

/// Returns the cells of the visible rows in a column; numbers as their sort keys.
const values = (name) => ledger.evaluate((figure, wanted) => {
    const table = figure.querySelector("table");
    const column = [...table.tHead.rows[0].cells].findIndex((head) => head.textContent.includes(wanted));
    return [...table.tBodies[0].rows].filter((row) => !row.hidden)
        .map((row) => row.cells[column].dataset.value ?? row.cells[column].textContent.trim());
}, name);
const head = (name) => ledger.locator("thead th", { hasText: name });
const sort = (name) => head(name).getByRole("button").click();
const choose = async (name, pick) => {
    const select = ledger.locator("label", { hasText: name }).locator("select");
    const options = await select.locator("option").allTextContents();
    await select.selectOption({ index: options.findIndex((option) => option.includes(pick)) });
};
const numbers = (list) => list.filter((value) => value !== "–").map(Number);
const ascending = (list) => [...list].sort((a, b) => a - b);

test("numbers are sorted as numbers, empty cells come last, the third click restores the order", async () => {
    const start = await values("deciding number");
    for (const state of ["ascending", "descending"]) {
        await sort("deciding number");
        assert.equal(await head("deciding number").getAttribute("aria-sort"), state);
        const sorted = await values("deciding number");
        const expected = ascending(numbers(start));
        assert.deepEqual(numbers(sorted), state === "ascending" ? expected : expected.reverse());
        assert.deepEqual(new Set(sorted.slice(sorted.indexOf("–"))), new Set(["–"]));
    }
    await sort("deciding number");
    assert.deepEqual(await values("deciding number"), start);
    assert.equal(await head("deciding number").getAttribute("aria-sort"), null);
});

test("sorting by a second column keeps the first within it; by keyboard too", async () => {
    await sort("deciding number");
    await head("source").getByRole("button").focus();
    await page.keyboard.press("Enter");
    const sources = await values("source"), measured = await values("deciding number");
    assert.deepEqual(sources, [...sources].sort((a, b) => a.localeCompare(b, "en", { numeric: true })));
    for (const source of new Set(sources)) {
        const within = numbers(measured.filter((_, i) => sources[i] === source));
        assert.deepEqual(within, ascending(within), source);
    }
    assert.equal(await ledger.locator("[aria-sort]").count(), 1);
});

test("claims are counted, not spelt", async () => {
    await sort("no.");
    const counts = (await values("no.")).map((label) => Number(label.split(".").at(-1)));
    assert.deepEqual(counts, ascending(counts));
});

test("filters combine and let go", async () => {
    const all = (await values("no.")).length;
    await choose("verdict", "refuted");
    const refuted = await values("verdict");
    assert.ok(refuted.length > 0 && refuted.every((verdict) => verdict.includes("refuted")));
    await choose("source", "S0");
    const both = await values("source");
    assert.deepEqual(new Set(both), new Set(["S0"]));
    assert.ok(both.length < refuted.length);
    assert.equal(await ledger.locator("output").textContent(), `${both.length} of ${all} rows`);
    await choose("verdict", "all");
    await choose("source", "all");
    assert.equal((await values("no.")).length, all);
});

test("every table of three rows or more has its columns sorted by exact values", async () => {
    for (const table of await page.locator("figure.table table[data-sortable]").all()) await table.scrollIntoViewIfNeeded();
    await page.waitForFunction(() => document.querySelectorAll("table[data-sortable]:not(:has(button.sort))").length === 0);
    const wrong = await page.$$eval("figure.table table[data-sortable]", (tables) => tables.flatMap((table) => {
        const column = [...table.tHead.rows[0].cells].findIndex((cell, i) => [...table.tBodies[0].rows].some((row) => row.cells[i]?.dataset.value));
        if (column < 0) return [];
        table.tHead.rows[0].cells[column].querySelector("button").click();
        const sorted = [...table.tBodies[0].rows].map((row) => row.cells[column].dataset.value).filter((value) => value !== undefined).map(Number);
        return sorted.every((value, i) => i === 0 || sorted[i - 1] <= value) ? [] : [table.closest("figure").id];
    }));
    assert.deepEqual(wrong, []);
    assert.ok(await page.locator("table[data-sortable]").count() > 20);
});

test("a table wider than its place says so, at the side where there is more", async () => {
    const narrow = await open(browser, reports.quick, { viewport: { width: 360, height: 740 }, volume: "appendix.html" });
    const box = narrow.locator("#claims_ledger .scroll");
    await box.scrollIntoViewIfNeeded();
    await narrow.waitForFunction(() => document.querySelector("#claims_ledger .scroll").dataset.more === "right");
    await box.evaluate((element) => { element.scrollLeft = 1e6; });
    await narrow.waitForFunction(() => document.querySelector("#claims_ledger .scroll").dataset.more === "left");
    assert.deepEqual(narrow.problems, []);
    await narrow.context().close();
});

test("tables far away have no tools yet, so that the page is soon there", async () => {
    const fresh = await open(browser, reports.quick, { volume: "appendix.html" });
    const bare = await fresh.locator("table[data-sortable]:not(:has(button.sort))").count(), all = await fresh.locator("table[data-sortable]").count();
    assert.ok(bare > all / 2, `${bare} of ${all}`);
    await fresh.context().close();
});
