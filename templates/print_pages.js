// Sets report.pdf as a paper is set: pages of two columns, wide figures and tables across the top. Blocks are measured once, at the width
// they will have; the rest is arithmetic. A float stands where its text asks for it if there is room, else in the next column or on the next
// page while the text goes on; paragraphs are parted between lines. Page numbers come out of it, and the title says them, so that whoever
// prints can hold them against the PDF (src/report/pdf/print_pdf.cpp). Engines without scripts (weasyprint) use the columns of print.css.
const { dropOtherHyphens, fitFormula, giveAir, hyphenate, isTooWide, linesOf, loosen, partBefore } = printText;   // print_text.js
const mm = 96 / 25.4;
const floatGap = 4 * mm, leastText = 22 * mm, mostStretch = 0.6 * mm, mostApart = 8 * mm, mostFacts = 60 * mm;
const heights = [256, 254, 252, 250, 248, 246, 244, 242, 240].map((height) => height * mm);   // of a page, at most as in print.css
const firstLines = 2, lastLines = 2;   // of a paragraph, that stay together

const element = (name, parent) => parent.appendChild(Object.assign(document.createElement("div"), { className: name }));
const isRunning = (block) => block.matches("p:not([class]), .running");
const isHeading = (block) => block?.matches("h2, h3, .asked, .answer, #source-code + .facts") ||   // stays with what follows
    block?.matches(".answer + .facts") && block.getBoundingClientRect().height < mostFacts;
const isEnd = (block) => block.matches("#source-code, #cited-works");   // no float passes it

// ---- measuring ------------------------------------------------------------------------------------------------------------------------------

/// The blocks of the document in their order, measured: { block, across, float, height, above, below, lines }.
function measured(main) {
    const wide = element("measure across", main), narrow = element("measure", main), blocks = [];
    for (const part of main.querySelectorAll(":scope > :not(.measure)"))
        blocks.push(...part.matches("section:not(.attempted)") ? part.children : [part]);
    for (const list of blocks.filter((block) => block.matches("ol, ul"))) {   // an item is parted as a paragraph is
        const items = [...list.children].map((item) => {
            const one = list.cloneNode(false);
            one.append(item);
            return one;
        });
        blocks.splice(blocks.indexOf(list), 1, ...items);
        list.remove();
    }
    const across = new Set(blocks.filter((block) => block.matches(".attempted, .title")));
    narrow.append(...blocks.filter((block) => !across.has(block)));
    wide.append(...across);
    main.querySelectorAll(":scope > section:empty").forEach((section) => section.remove());
    narrow.querySelectorAll(".equation").forEach(fitFormula);
    const texts = blocks.filter((block) => !block.matches("figure"));
    texts.forEach((block, i) => {
        if (!isRunning(block)) return;
        block.classList.add("running");
        block.classList.toggle("indented", i > 0 && isRunning(texts[i - 1]));
        hyphenate(block);
    });
    loosen(texts.filter(isRunning));
    const figures = blocks.filter((block) => block.matches("figure") && !across.has(block));
    for (const figure of figures.filter(isTooWide)) {
        across.add(figure);
        wide.append(figure);
    }
    blocks.filter((block) => block.matches("figure.table")).forEach(giveAir);
    const items = blocks.map((block) => ({
        block, across: across.has(block), float: block.matches("figure"), heading: isHeading(block), closing: block.matches(".answer + .facts"),
        end: isEnd(block)
    }));
    for (const item of items) {
        const style = getComputedStyle(item.block);
        item.height = item.block.getBoundingClientRect().height;
        if (!isRunning(item.block) && item.height > heights.at(-1)) {
            item.block.style.zoom = 0.98 * heights.at(-1) / item.height;
            item.height = item.block.getBoundingClientRect().height;
        }
        item.above = parseFloat(style.marginTop);
        item.below = parseFloat(style.marginBottom);
        if (item.block.matches("p, ul, ol")) item.lines = linesOf(item.block);
    }
    return items;
}

const kindOf = ({ block }) => block.matches(".table") ? "table" : "figure";

/// Brings each float up to the text that first refers to it, or the end of the opening of a section; figures stay in their order, and so do
/// tables.
function floatsAtFirstMention(items) {
    const texts = items.filter(({ float, across }) => !float && !across), after = new Map(texts.map((text) => [text, []])), latest = {};
    let before = -1;   // the text before the float, as in the document
    for (const item of items) {
        if (!item.float) {
            before = Math.max(before, texts.indexOf(item));
            continue;
        }
        const kind = kindOf(item), mention = texts.findIndex(({ block }) => block.querySelector(`a[href="#${item.block.id}"]`));
        latest[kind] = Math.max(latest[kind] ?? 0, mention < 0 ? before : Math.min(mention, before));
        while (texts[latest[kind]].heading && latest[kind] + 1 < texts.length) ++latest[kind];
        after.get(texts[latest[kind]]).push(item);
    }
    return [...items.filter(({ float, across }) => !float && across), ...texts.flatMap((text) => [text, ...after.get(text)])];
}

// ---- arithmetic of a page -------------------------------------------------------------------------------------------------------------------

const heightOf = (items) => items.reduce((sum, { height }) => sum + height + floatGap, 0);

/// Returns the height of lines from..to of an item, or of the whole item.
function heightOfLines({ lines, height }, from, to) {
    if (!lines || lines.length < 2) return height;
    return (to < lines.length ? lines[to].top : lines[0].top + height) - lines[from].top;
}

/// Returns the height of a heading with the headings and first lines that must follow it.
function heightOfChain(items, index) {
    let sum = 0, below = Infinity;   // the first margin is counted already
    for (; index < items.length; ++index) {
        const item = items[index];
        if (item.float || item.across) continue;
        sum += below === Infinity ? 0 : Math.max(below, item.above);
        if (!item.heading) return sum + heightOfLines(item, 0, item.lines?.length > firstLines + 1 ? firstLines : Infinity);
        sum += item.height;
        if (item.closing) return sum;   // a column may end with the facts
        below = item.below;
    }
    return sum;
}

/// Fills two columns of a height with the blocks behind a place { index, line, waiting }, where waiting are the floats of one column that did not
/// fit before. Floats across the page take no room here: they are `met`; those not `taken` by this page hold up later ones of their kind.
function filled(items, place, height, taken, pending) {
    let { index, line } = place, waiting = [...place.waiting];
    const columns = [], met = [];
    const isBefore = isBeforeIn(items);
    const isHeldUp = (float) => [...pending, ...met].some((item) => !taken.includes(item) && isBefore(item, float));
    for (let c = 0; c < 2; ++c) {
        const column = { top: [], foot: [], used: 0 };
        columns.push(column);
        let y = 0, below = 0, foot = 0;   // filled from above, the margin there, taken at the foot
        const add = (item, from = 0, to = Infinity) => {
            y += (column.top.length > 0 ? Math.max(below, from > 0 ? 0 : item.above) : 0) + heightOfLines(item, from, to);
            below = to < item.lines?.length ? 0 : item.below;
            column.top.push({ item, from, to });
        };
        while (waiting.length > 0 && !isHeldUp(waiting[0]) && y + (y > 0 ? floatGap : 0) + waiting[0].height <= height) add(waiting.shift());
        for (; index < items.length; ++index, line = 0) {
            const item = items[index];
            if (item.across) {
                met.push(item);
                continue;
            }
            if (item.end && (waiting.length > 0 || [...pending, ...met].some((float) => !taken.includes(float)))) break;
            const room = height - foot - y - (column.top.length > 0 ? Math.max(below, line > 0 ? 0 : item.above) : 0);
            if (item.float) {
                const fits = waiting.length === 0 && !isHeldUp(item) && item.height + (foot > 0 || y > 0 ? floatGap : 0) <= height - foot - y;
                if (!fits) waiting.push(item);
                else if (y === 0) add(item);
                else column.foot.push({ item, from: 0, to: Infinity }), foot += item.height + floatGap;
                continue;
            }
            if (item.heading) {
                const isFirst = !items[index - 1].heading || items[index - 1].closing;
                if (isFirst && (y > 0 || taken.length > 0) && heightOfChain(items, index) > room) break;
                add(item);
                continue;
            }
            const count = item.lines?.length ?? 1;
            let to = count;
            while (to > line && heightOfLines(item, line, to) > room + 1) --to;
            if (to === count || y + foot === 0 && count < 2) {
                add(item, line);
                continue;
            }
            to = Math.min(to, count - lastLines);
            if (to - line < (line > 0 ? 1 : firstLines)) break;
            add(item, line, to);
            line = to;
            break;
        }
        column.used = y + foot;
    }
    return { columns, met, place: { index, line, waiting } };
}

/// Whether one float comes before another of its kind.
const isBeforeIn = (items) => (one, other) => kindOf(one) === kindOf(other) && items.indexOf(one) < items.indexOf(other);

/// The floats in the columns of a page.
const floatsOf = ({ columns }) => columns.flatMap(({ top, foot }) => [...top, ...foot]).map(({ item }) => item).filter(({ float }) => float);

/// The pages: [{ across, columns, height }], and how far behind their places floats are, squared.
function paged(items, pageHeight) {
    const pages = [], metOn = new Map(), isBefore = isBeforeIn(items);
    let place = { index: 0, line: 0, waiting: [] }, pending = [], lag = 0;
    while (place.index < items.length || place.waiting.length > 0 || pending.length > 0) {
        const across = [];
        // Floats of a column that come before one across the page are not put off twice.
        const waitsFor = (float) => place.waiting.filter((item) => items.indexOf(item) < items.indexOf(float));
        const roomBefore = (float) => Math.max(0, ...waitsFor(float).map(({ height }) => height));
        const fits = (float) => heightOf([...across, float]) + roomBefore(float) <= pageHeight + floatGap;
        const isEarly = (float, floats) => floats.some((item) => isBefore(item, float));
        while (pending.length > 0 && !isEarly(pending[0], place.waiting) && (across.length === 0 || fits(pending[0]))) {
            across.push(pending.shift());
            lag += (pages.length - 1 - metOn.get(across.at(-1))) ** 2;
        }
        let room = pageHeight - heightOf(across), page = room < leastText ? undefined : filled(items, place, room, across, pending);
        while (page && pending.length === 0) {   // the next float across, as long as its place stays on this page
            const next = page.met.find((item) => !across.includes(item));
            const less = next ? room - next.height - floatGap : 0;
            if (!next || less < Math.max(roomBefore(next), page.place.index < items.length ? leastText : 0)) break;
            const trial = filled(items, place, less, [...across, next], pending);
            if (!trial.met.includes(next) || isEarly(next, floatsOf(trial))) break;
            across.push(next);
            room = less;
            page = trial;
        }
        if (page) {
            const later = page.met.filter((item) => !across.includes(item));
            for (const item of later) metOn.set(item, pages.length);
            pending.push(...later);
            const isLast = page.place.index === items.length && page.place.waiting.length === 0 && pending.length === 0;
            if (isLast) page = balanced((height) => filled(items, place, height, across, pending), page, room, items.length);
            place = page.place;
        }
        pages.push({ across, columns: page?.columns ?? [], height: room });
    }
    return Object.assign(pages, { lag });
}

/// The last page, its columns equally long.
function balanced(fill, page, room, end) {
    let low = 0, high = room;
    for (let step = 0; step < 12; ++step) {
        const middle = (low + high) / 2, trial = fill(middle);
        if (trial.place.index === end && trial.place.waiting.length === 0) [high, page] = [middle, trial];
        else low = middle;
    }
    return page;
}

/// Returns the cost of a layout: pages, empty space at the feet of columns, and lateness of floats.
function badness(pages, pageHeight) {
    const empty = ({ columns, height }, i) => {
        const used = columns.map((column) => column.used);
        const gaps = used.length === 0 ? [height, height] : used.map((one) => Math.max(0, height - one));
        return gaps.reduce((sum, gap) => sum + (gap / pageHeight) ** 2, 0) * (i === pages.length - 1 ? 0.5 : 1);
    };
    return pages.length + 0.1 * pages.lag + 2 * pages.map(empty).reduce((sum, one) => sum + one, 0);
}

/// The pages at the height that fills them best, among those that need the fewest.
function bestPaged(items) {
    const choices = heights.map((height) => [height, paged(items, height)]), score = ([height, pages]) => badness(pages, height);
    return choices.reduce((best, one) => score(one) < score(best) ? one : best);
}

// ---- the pages as elements ------------------------------------------------------------------------------------------------------------------

/// The blocks of the pieces of an item, in order.
function parted({ block, lines }, pieces) {
    const blocks = [];
    let cut = {};   // the last one: its text now begins there
    for (const { from } of pieces.slice(1)) {
        const { node, offset } = lines[from];
        blocks.push(partBefore(block, { node, offset: node === cut.node ? offset - cut.offset : offset }));
        cut = lines[from];
    }
    return [...blocks, block];
}

function setColumn(pieces, column) {
    let before;
    for (const { item, from, block } of pieces) {
        const own = from > 0 ? 0 : item.float ? floatGap : item.above;
        Object.assign(block.style, { marginTop: `${before ? Math.max(before.float ? floatGap : before.below, own) : 0}px`, marginBottom: 0 });
        column.append(block);
        before = item;
    }
}

/// Spreads the empty space at the foot of a column over the gaps between its blocks.
function spread(column, bottom) {
    const stretch = (block) => block.matches("figure, h2") ? 6 : block.matches("h3") ? 4
        : block.matches(".equation, figure + *, .equation + *") ? 3 : block.matches(".continued") ? 0 : 1;
    const blocks = [...column.children].slice(1), shares = blocks.map(stretch), all = shares.reduce((sum, share) => sum + share, 0);
    if (all === 0) return;
    const unit = Math.min((bottom - column.lastElementChild.getBoundingClientRect().bottom) / all, mostStretch);
    blocks.forEach((block, i) => { block.style.marginTop = `${parseFloat(block.style.marginTop) + Math.max(0, unit) * shares[i]}px`; });
}

function build(main, [pageHeight, pages]) {
    const piecesOf = ({ columns }) => columns.flatMap(({ top, foot }) => [...top, ...foot]), all = new Map();
    for (const piece of pages.flatMap(piecesOf)) all.set(piece.item, [...all.get(piece.item) ?? [], piece]);
    for (const [item, pieces] of all) parted(item, pieces).forEach((block, i) => { pieces[i].block = block; });
    for (const { across, columns } of pages) {
        const page = element("leaf", main), body = element("body", page);
        body.before(...across.map(({ block }) => block));
        for (const { top, foot } of columns) setColumn([...top, ...foot], element("column", body));
    }
    main.querySelectorAll(".measure").forEach((measure) => measure.remove());
    for (const page of main.querySelectorAll(".leaf:not(:last-child)")) {   // of floats alone
        if (page.querySelector(".column > *")) continue;
        const floats = [...page.querySelectorAll(":scope > figure")];
        const empty = page.getBoundingClientRect().top + pageHeight - floats.at(-1).getBoundingClientRect().bottom;
        floats.forEach((float) => { float.style.marginBottom = `${floatGap + Math.min(mostApart, empty / floats.length)}px`; });
    }
    const columns = [...main.querySelectorAll(".leaf:not(:last-child) .column")];
    columns.forEach((column) => spread(column, column.closest(".leaf").getBoundingClientRect().top + pageHeight));
}

function fillInPageNumbers(main) {
    const pages = [...main.querySelectorAll(":scope > .leaf")];
    const unknown = [...main.querySelectorAll(".page-of")].filter((place) => place.textContent === "00");
    const numbers = unknown.map((place) => 1 + pages.indexOf(document.getElementById(place.dataset.of).closest(".leaf")));
    unknown.forEach((place, i) => { place.textContent = numbers[i]; });
    document.title = numbers.join(" ");
}

if (location.hash === "#print") document.documentElement.classList.add("printing");

async function makePages() {
    const main = document.querySelector("main.paper");
    if (!main) return;
    await Promise.all([...document.fonts].map((font) => font.load()));
    main.classList.add("paged");
    build(main, bestPaged(floatsAtFirstMention(measured(main))));
    dropOtherHyphens(main.querySelectorAll(".running"));
    fillInPageNumbers(main);
    const running = `@page { @top-left { content: ${JSON.stringify(main.querySelector("h1").textContent)}; } }`;
    document.styleSheets[0].insertRule(running, document.styleSheets[0].cssRules.length);
}

addEventListener("load", () => { globalThis.pagesMade = makePages(); });
