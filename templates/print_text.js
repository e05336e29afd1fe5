// Fits blocks to the columns of report.pdf, for print_pages.js: parts formulas that are too long, hyphenates (print_hyphens.js), and finds the
// lines of a paragraph to part it between them.
const mostLoose = 0.16;   // of a line, that justifying spreads over its spaces
const leastPicture = 25 * 96 / 25.4;   // 25 mm
const mostAir = 3 * 96 / 25.4;   // 3 mm
const softHyphen = "\u00ad";

/// Returns the place where a formula can be broken: behind its widest space, at an implication, or at its last relation; 0 if nowhere.
function breakOf(row) {
    const parts = [...row.children], last = (relation) => parts.findLastIndex((part, i) => i > 1 && relation.test(part.textContent));
    const places = [parts.findIndex((part) => part.matches('mspace[width="2em"]')), last(/^[⇒⇔]$/), last(/^[=≈]$/)];
    return places.find((place) => place > 0) ?? 0;
}

/// The row of a formula, or its table.
function rowOf(math) {
    let row = math;
    while (row.children.length === 1 && row.firstElementChild.matches("mrow, mtable")) row = row.firstElementChild;
    return row;
}

function lengthOf(cell) {
    const rects = [...cell.children].map((part) => part.getBoundingClientRect());
    return rects.length > 0 ? rects.at(-1).right - rects[0].left : 0;
}

/// Breaks the lines of a formula that are too long for a column, and sets the formula smaller if that is not enough.
function fitFormula(equation) {
    const formula = equation.querySelector(".formula"), math = formula.querySelector("math"), row = math ? rowOf(math) : undefined;
    if (!row) return;
    const lines = row.localName === "mtable" ? [...row.children] : [row];
    for (const line of lines) {
        const cells = line === row ? [row] : [...line.children], last = cells.at(-1), at = breakOf(last);
        if (at === 0 || cells.reduce((sum, cell) => sum + lengthOf(cell), 0) <= formula.clientWidth) continue;
        const owner = line === row ? math : line, copy = owner.cloneNode(true), below = line === row ? rowOf(copy) : copy.lastElementChild;
        if (line !== row) copy.firstElementChild.replaceChildren();
        owner.after(copy);
        below.replaceChildren(...[...last.children].slice(last.children[at].localName === "mspace" ? at + 1 : at));
        if (last.lastElementChild.localName === "mspace") last.lastElementChild.remove();
    }
    const widest = Math.max(...[...formula.querySelectorAll("math")].map((one) => lengthOf(rowOf(one))));
    if (widest > formula.clientWidth) formula.style.fontSize = `${0.99 * formula.clientWidth / widest}em`;
}

/// Whether a figure, laid out in a column, is too wide for it: its table sticks out, or its pictures are too small.
function isTooWide(figure) {
    const { right } = figure.getBoundingClientRect();
    if (figure.matches(".table")) return figure.querySelector("table").getBoundingClientRect().right > right + 1;
    if (figure.matches(".plot")) return !figure.matches(".slim");
    return [...figure.querySelectorAll("img")].some((picture) => picture.getBoundingClientRect().width < leastPicture);
}

/// Sets the columns of a table further apart, if there is room.
function giveAir(figure) {
    const table = figure.querySelector("table"), gaps = table.rows[0].cells.length - 1;
    const room = figure.clientWidth - table.getBoundingClientRect().width - 1;
    if (gaps > 0 && room > 0) table.style.setProperty("--air", `${Math.min(mostAir, room / gaps)}px`);
}

/// Puts soft hyphens into running text (print_hyphens.js).
function hyphenate(block) {
    const isLeftOut = ({ parentElement }) => parentElement.closest("math, .math, code, a");
    const accept = (text) => isLeftOut(text) ? NodeFilter.FILTER_REJECT : NodeFilter.FILTER_ACCEPT;
    const texts = document.createTreeWalker(block, NodeFilter.SHOW_TEXT, accept);
    while (texts.nextNode()) texts.currentNode.data = texts.currentNode.data.replace(/(?<!\w)[A-Za-z]{6,}(?!\w)/g, hyphenated);
}

/// The first letter of a text, from `low` on, that stands below `top`.
function firstBelow(text, low, top) {
    const range = document.createRange();
    let high = text.length - 1;
    while (low < high) {
        const middle = (low + high) >> 1;
        range.setStart(text, middle);
        range.setEnd(text, middle + 1);
        [...range.getClientRects()].at(-1)?.top > top ? high = middle : low = middle + 1;
    }
    return low;
}

/// The boxes of a paragraph, in order: [{ node, box }]. A formula has one.
function boxesOf(block) {
    const accept = (node) => node.parentElement.closest("math") ? NodeFilter.FILTER_REJECT
        : node.nodeType === Node.TEXT_NODE || node.localName === "math" ? NodeFilter.FILTER_ACCEPT : NodeFilter.FILTER_SKIP;
    const walker = document.createTreeWalker(block, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT, accept);
    const boxes = [], range = document.createRange();
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        range.selectNode(node);
        const ofNode = node.localName === "math" ? [node.getBoundingClientRect()] : [...range.getClientRects()];
        boxes.push(...ofNode.filter(({ width }) => width > 0).map((box) => ({ node, box })));
    }
    return boxes;
}

/// Returns the beginnings of the lines of a paragraph: [{ node, offset, top }]. A formula is never broken.
function linesOf(block) {
    const lines = [];
    let end = Infinity, last, offset = 0;
    for (const { node, box } of boxesOf(block)) {
        if (node !== last) offset = 0;
        if (box.left < end - 1) {
            if (node.nodeType === Node.TEXT_NODE && end !== Infinity) offset = firstBelow(node, offset, box.top - 3);
            lines.push({ node, offset, top: box.top });
        }
        [end, last] = [box.right, node];
    }
    return lines;
}

/// Returns the right ends of the lines of a paragraph.
function endsOf(block) {
    const ends = [];
    let end = Infinity;
    for (const { box } of boxesOf(block)) {
        box.left < end - 1 ? ends.push(box.right) : ends.splice(-1, 1, box.right);
        end = box.right;
    }
    return ends;
}

/// Moves the part of a block before a line into a block of its own, and returns it.
function partBefore(block, { node, offset }) {
    const range = document.createRange(), first = block.cloneNode(false);
    range.setStart(block, 0);
    node.nodeType === Node.TEXT_NODE ? range.setEnd(node, offset) : range.setEndBefore(node);
    first.append(range.extractContents());
    const text = document.createTreeWalker(first, NodeFilter.SHOW_TEXT);
    const last = text.lastChild() ?? text.currentNode;
    if (last.data?.endsWith(softHyphen)) last.data = `${last.data.slice(0, -1)}-`;   // at the end of a paragraph it is not shown
    block.removeAttribute("id");
    block.classList.add("continued");
    first.classList.add("parted");
    return first;
}

/// Returns the paragraphs with a line that would be too loose if justified.
function tooLoose(blocks) {
    for (const block of blocks) block.classList.add("ragged");
    const loose = blocks.filter((block) => {
        const { right, width } = block.getBoundingClientRect();
        return endsOf(block).slice(0, -1).some((end) => right - end > mostLoose * width);
    });
    for (const block of blocks) block.classList.remove("ragged");
    return loose;
}

/// Allows line breaks in formulas of paragraphs with loose lines, and sets those that are still loose ragged.
function loosen(blocks) {
    const loose = tooLoose(blocks);
    for (const block of loose) block.classList.add("loose");
    for (const block of tooLoose(loose)) block.classList.add("ragged");
}

/// Removes soft hyphens except at line ends, so that words copied from the paper are whole.
function dropOtherHyphens(blocks) {
    const used = new Map(), texts = [];
    for (const block of blocks) {
        for (const { node, offset } of linesOf(block)) used.set(node, [...used.get(node) ?? [], offset - 1]);
        const walker = document.createTreeWalker(block, NodeFilter.SHOW_TEXT);
        while (walker.nextNode()) if (walker.currentNode.data.includes(softHyphen)) texts.push(walker.currentNode);
    }
    for (const text of texts) {
        const isShown = (letter, i) => letter !== softHyphen || used.get(text)?.includes(i);
        text.data = text.data.split("").filter(isShown).join("");
    }
}

globalThis.printText = { dropOtherHyphens, fitFormula, giveAir, hyphenate, isTooWide, linesOf, loosen, partBefore };
