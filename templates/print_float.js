// Fills the pages of report.pdf: where a figure or table would leave the rest of a page empty, the text behind it comes first, as in any
// typeset paper; what stays empty goes to the pictures of that page. Columns of a page's size break as pages do, so the browser's own
// layout tells where pages end. Engines without scripts (weasyprint) keep the document's order, and some of their pages end early. The
// same columns tell the numbers of the pages in the contents; the title says them, so that whoever prints can hold them against the pages
// of the PDF (src/report/pdf/print_pdf.cpp).
const main = document.querySelector("main");
const tolerated = 0.1;   // of a page's height, left empty

const isFloat = (block) => block.matches("figure");
const isHeading = (block) => block?.matches("h2, h3");

/// How much of the page before a block's is empty; 0 where the block follows on the same page. Headings belong to what they stand above.
function gapBefore(block) {
    while (isHeading(block.previousElementSibling)) block = block.previousElementSibling;
    const last = [...block.previousElementSibling?.getClientRects() ?? []].at(-1), page = main.getBoundingClientRect();
    if (!last) return 0;   // the first of its section
    return block.getClientRects()[0].left === last.left ? 0 : (page.bottom - last.bottom) / page.height;
}

/// The next block of text behind a float and those that follow it; a heading comes with the paragraph below it. Empty: there is none.
function textBehind(float) {
    let next = float;
    while (next && isFloat(next)) next = next.nextElementSibling;
    const text = [];
    for (; isHeading(next); next = next.nextElementSibling) text.push(next);
    return next && !isFloat(next) ? [...text, next] : [];
}

/// Brings text before the float, block by block, as long as that leaves less empty.
function fillPageBefore(float) {
    for (let gap = gapBefore(float); gap > tolerated;) {
        const text = textBehind(float), back = text.at(-1)?.nextElementSibling ?? null, parent = float.parentElement;
        float.before(...text);
        const now = gapBefore(float);
        if (text.length === 0 || now >= gap) {
            for (const block of text) parent.insertBefore(block, back);
            return;
        }
        gap = now;
    }
}

/// The page of a place, from 0.
function pageAt(x) {
    const { left } = main.getBoundingClientRect(), { columnWidth, columnGap } = getComputedStyle(main);
    return Math.round((x - left) / (parseFloat(columnWidth) + parseFloat(columnGap)));
}

/// The pages on which parts of a block lie.
const pagesOf = (block) => [...block.getClientRects()].filter(({ height }) => height > 1).map(({ left }) => pageAt(left));

/// Each figure `factor` times as wide as the style sheets say, at most as wide as the page.
function widen(figures, factor) {
    for (const part of figures.flatMap((figure) => [...figure.querySelectorAll("[class*=tenths-], svg:not(.legend)")])) {
        part.style.maxWidth = part.style.width = "";
        const { maxWidth, width } = getComputedStyle(part);
        if (part.matches("svg")) part.style.width = `${factor * parseFloat(width)}px`;
        else part.style.maxWidth = `${Math.min(100, factor * parseFloat(maxWidth))}%`;
    }
}

/// Widens the figures of every page that ends early, as long as no block of the document leaves its page.
function growFigures() {
    const blocks = [...document.querySelectorAll("main > section > *")].filter((block) => pagesOf(block).length > 0);
    const asItIs = () => blocks.map(pagesOf).join();
    const before = asItIs(), figures = Map.groupBy(blocks.filter((block) => block.matches(".picture, .plot")), (figure) => pagesOf(figure)[0]);
    const full = new Set(blocks.map(pagesOf).filter((pages) => pages.length > 1).flatMap((pages) => pages.slice(0, -1)));
    for (const [page, onPage] of figures) {
        if (full.has(page)) continue;
        let least = 1, most = 1.5;
        for (let step = 0; step < 5; ++step) {
            const factor = (least + most) / 2;
            widen(onPage, factor);
            asItIs() === before ? least = factor : most = factor;
        }
        widen(onPage, 1 + 0.9 * (least - 1));   // printed lines may be a little higher
    }
}

function fillInPageNumbers() {
    const unknown = [...document.querySelectorAll(".page-of")].filter((place) => place.textContent === "00");
    const numbers = unknown.map((place) => 1 + pageAt(document.getElementById(place.dataset.of).getClientRects()[0].left));
    unknown.forEach((place, i) => { place.textContent = numbers[i]; });
    document.title = numbers.join(" ");
}

addEventListener("load", () => {
    main.classList.add("paged");
    document.querySelectorAll("main > section > figure").forEach(fillPageBefore);
    if (main.matches(".paper")) growFigures();   // in the long appendix it would take too long
    fillInPageNumbers();
    main.classList.remove("paged");
});
