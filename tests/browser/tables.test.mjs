// Tables that are sorted and filtered, driven on the certificates of stability.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, reports } from "./browser.mjs";

let browser, page, certificates;
before(async () => {
    browser = await launch();
    page = await open(browser, reports.quick, { volume: "appendix.html" });
    certificates = page.locator("#stability_certificates");
    await certificates.scrollIntoViewIfNeeded();   // its tools are made when it is nearly seen
});
after(() => browser.close());

/// Returns the cells of the visible rows in a column; numbers as their sort keys.
const values = (name) => certificates.evaluate((figure, wanted) => {
    const table = figure.querySelector("table");
    const column = [...table.tHead.rows[0].cells].findIndex((head) => head.textContent.includes(wanted));
    return [...table.tBodies[0].rows].filter((row) => !row.hidden)
        .map((row) => row.cells[column].dataset.value ?? row.cells[column].textContent.trim());
}, name);
const head = (name) => certificates.locator("thead th", { hasText: name });
const sort = (name) => head(name).getByRole("button").click();
const choose = async (name, pick) => {
    const select = certificates.locator("label", { hasText: name }).locator("select");
    const options = await select.locator("option").allTextContents();
    await select.selectOption({ index: options.findIndex((option) => option.includes(pick)) });
};
const numbers = (list) => list.filter((value) => value !== "–").map(Number);
const ascending = (list) => [...list].sort((a, b) => a - b);

test("numbers are sorted as numbers, the third click restores the order", async () => {
    const start = await values("stable up to");
    for (const state of ["ascending", "descending"]) {
        await sort("stable up to");
        assert.equal(await head("stable up to").getAttribute("aria-sort"), state);
        const sorted = await values("stable up to");
        const expected = ascending(numbers(start));
        assert.deepEqual(numbers(sorted), state === "ascending" ? expected : expected.reverse());
    }
    await sort("stable up to");
    assert.deepEqual(await values("stable up to"), start);
    assert.equal(await head("stable up to").getAttribute("aria-sort"), null);
});

test("sorting by a second column keeps the first within it; by keyboard too", async () => {
    await sort("stable up to");
    await head("operator").getByRole("button").focus();
    await page.keyboard.press("Enter");
    const operators = await values("operator"), measured = await values("stable up to");
    assert.deepEqual(operators, [...operators].sort((a, b) => a.localeCompare(b, "en", { numeric: true })));
    for (const operator of new Set(operators)) {
        const within = numbers(measured.filter((_, i) => operators[i] === operator));
        assert.deepEqual(within, ascending(within), operator);
    }
    assert.equal(await certificates.locator("[aria-sort]").count(), 1);
});

test("filters combine and let go", async () => {
    const all = (await values("mesh")).length;
    await choose("operator", "cotangent");
    const cotangent = await values("operator");
    assert.ok(cotangent.length > 1 && cotangent.length < all && cotangent.every((operator) => operator === "cotangent"));
    await choose("mesh", "cube");
    const both = await values("mesh");
    assert.deepEqual(both, ["cube"]);
    assert.equal(await certificates.locator("output").textContent(), `1 of ${all} rows`);
    await choose("operator", "all");
    await choose("mesh", "all");
    assert.equal((await values("mesh")).length, all);
});

test("every table of three rows or more has its columns sorted by exact values, empty cells last", async () => {
    for (const table of await page.locator("figure.table table[data-sortable]").all()) await table.scrollIntoViewIfNeeded();
    await page.waitForFunction(() => document.querySelectorAll("table[data-sortable]:not(:has(button.sort))").length === 0);
    const wrong = await page.$$eval("figure.table table[data-sortable]", (tables) => tables.flatMap((table) => {
        const column = [...table.tHead.rows[0].cells].findIndex((cell, i) => [...table.tBodies[0].rows].some((row) => row.cells[i]?.dataset.value));
        if (column < 0) return [];
        table.tHead.rows[0].cells[column].querySelector("button").click();
        const cells = [...table.tBodies[0].rows].map((row) => row.cells[column].dataset.value), sorted = cells.filter((value) => value !== undefined).map(Number);
        if (cells.slice(sorted.length).some((value) => value !== undefined)) return [table.closest("figure").id];
        return sorted.every((value, i) => i === 0 || sorted[i - 1] <= value) ? [] : [table.closest("figure").id];
    }));
    assert.deepEqual(wrong, []);
    assert.ok(await page.locator("table[data-sortable]").count() > 20);
});

test("a table wider than its place says so, at the side where there is more", async () => {
    const narrow = await open(browser, reports.quick, { viewport: { width: 360, height: 740 }, volume: "appendix.html" });
    const box = narrow.locator("#stability_certificates .scroll");
    await box.scrollIntoViewIfNeeded();
    await narrow.waitForFunction(() => document.querySelector("#stability_certificates .scroll").dataset.more === "right");
    await box.evaluate((element) => { element.scrollLeft = 1e6; });
    await narrow.waitForFunction(() => document.querySelector("#stability_certificates .scroll").dataset.more === "left");
    assert.deepEqual(narrow.problems, []);
    await narrow.context().close();
});

test("tables far away have no tools yet, so that the page is soon there", async () => {
    const fresh = await open(browser, reports.quick, { volume: "appendix.html" });
    const bare = await fresh.locator("table[data-sortable]:not(:has(button.sort))").count(), all = await fresh.locator("table[data-sortable]").count();
    assert.ok(bare > all / 2, `${bare} of ${all}`);
    await fresh.context().close();
});
