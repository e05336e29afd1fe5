// Fills the pages of appendix.pdf: where a figure or table would leave the rest of a page empty, the text behind it comes first, as in any
// typeset paper; what stays empty goes to the space between the blocks. Columns of a page's size break as pages do, so the browser's own
// layout tells where pages end. Engines without scripts (weasyprint) keep the document's order, and some of their pages end early. The
// same columns tell the numbers of the pages in the contents; the title says them, so that whoever prints can hold them against the pages
// of the PDF (src/report/pdf/print_pdf.cpp). The program prints "#print", which omits the layout for the screen.
let main;
const tolerated = 0.03, much = 0.15;   // of a page's height, left empty

const isFloat = (block) => block.matches("figure");
const isHeading = (block) => block?.matches("h2, h3, .asked");

/// Returns the empty share of the page before that of a block; 0 if the block follows on the same page. Headings belong to the next block.
function gapBefore(block) {
    while (isHeading(block.previousElementSibling)) block = block.previousElementSibling;
    const previous = block.previousElementSibling ?? block.parentElement.previousElementSibling?.lastElementChild;
    const last = [...previous?.getClientRects() ?? []].at(-1), page = main.getBoundingClientRect();
    if (!last) return 0;
    return block.getClientRects()[0].left === last.left ? 0 : (page.bottom - last.bottom) / page.height;
}

/// Returns the height of a block with the margin below it.
function heightOf(block) {
    return [...block.getClientRects()].reduce((sum, { height }) => sum + height, parseFloat(getComputedStyle(block).marginBottom));
}

/// Moves text from behind a float before it, as much as fills the page; all at once, as each measurement costs a layout.
function fillPageBefore(float) {
    let room = (gapBefore(float) - tolerated) * main.clientHeight, block = float.previousElementSibling;
    if (room <= 0) return;
    for (; isHeading(block); block = block.previousElementSibling) room -= heightOf(block);   // it comes before the text
    const text = [];
    for (block = float.nextElementSibling; block && !(isFloat(block) && isHeading(text.at(-1))); block = block.nextElementSibling) {
        if (isFloat(block)) continue;
        text.push(block);
        room -= heightOf(block);
        if (room <= 0 && !isHeading(block)) break;
    }
    while (isHeading(text.at(-1))) text.pop();   // it stays with what is below it
    float.before(...text);
}

/// Lets the last floats of a section follow the beginning of the next one, if much of a page would be empty before them and the beginning
/// fits there.
function passOn(section, next) {
    const floats = [];
    for (let block = section.lastElementChild; isFloat(block); block = block.previousElementSibling) floats.unshift(block);
    const passed = floats.slice(floats.findIndex((float) => gapBefore(float) > much));
    const last = passed[0]?.previousElementSibling;
    if (!last || isHeading(last) || gapBefore(passed[0]) <= much) return;
    next.style.display = "";
    next.prepend(...passed);
    fillPageBefore(passed[0]);
    if (pagesOf(next.firstElementChild)[0] !== pagesOf(last).at(-1)) section.append(...passed);
}

/// One section after the other, those that follow left out meanwhile: they need no layout yet.
function fillPages() {
    const sections = [...document.querySelectorAll("main > section")];
    for (const section of sections) section.style.display = "none";
    sections.forEach((section, i) => {
        section.style.display = "";
        section.querySelectorAll(":scope > figure").forEach(fillPageBefore);
        if (sections[i + 1]?.matches(".numbered")) passOn(section, sections[i + 1]);
    });
}

/// The page of a place, from 0.
function pageAt(x) {
    const { left } = main.getBoundingClientRect(), { columnWidth, columnGap } = getComputedStyle(main);
    return Math.round((x - left) / (parseFloat(columnWidth) + parseFloat(columnGap)));
}

/// The pages on which parts of a block lie.
const pagesOf = (block) => [...block.getClientRects()].filter(({ height }) => height > 1).map(({ left }) => pageAt(left));

/// Spreads the empty space at the foot of each page but the last over the gaps above its floats and headings.
function spreadBlocks() {
    const most = 24, spare = 8, { bottom } = main.getBoundingClientRect(), pages = [];   // [pixels]
    for (const block of document.querySelectorAll("main > section > *")) {
        const rects = [...block.getClientRects()].filter(({ height }) => height > 1);
        rects.forEach((rect, i) => {
            const page = pages[pageAt(rect.left)] ??= { filled: 0, gaps: [], begun: false };
            const isGap = page.begun && i === 0 && block.matches("figure, h2, h3") && !isHeading(block.previousElementSibling);
            if (isGap) page.gaps.push(block);
            page.begun = true;
            page.filled = Math.max(page.filled, rect.bottom);
        });
    }
    const spaces = pages.slice(0, -1).flatMap(({ filled, gaps }) => {
        const space = Math.min(most, (bottom - filled - spare) / gaps.length);
        return space > 0 ? gaps.map((block) => [block, space + parseFloat(getComputedStyle(block).marginTop)]) : [];
    });
    for (const [block, space] of spaces) block.style.marginTop = `${space}px`;
}

function fillInPageNumbers() {
    const unknown = [...document.querySelectorAll(".page-of")].filter((place) => place.textContent === "00");
    const numbers = unknown.map((place) => 1 + pageAt(document.getElementById(place.dataset.of).getClientRects()[0].left));
    unknown.forEach((place, i) => { place.textContent = numbers[i]; });
    document.title = numbers.join(" ");
}

async function makePages() {
    await Promise.all([...document.fonts].map((font) => font.load()));
    main.classList.add("paged");
    fillPages();
    spreadBlocks();
    fillInPageNumbers();
    main.classList.remove("paged");
}

addEventListener("load", () => {
    main = document.querySelector("main:not(.paper)");
    if (main) globalThis.pagesMade = makePages();
});
