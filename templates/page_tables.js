// Sorts and filters tables, and marks boxes that scroll sideways.

/// Returns the sort key of a cell: a number, a text, or null for an empty one.
function keyOf(cell) {
    if (cell === undefined) return null;
    if (cell.dataset.value !== undefined) return Number(cell.dataset.value);
    const text = cell.textContent.trim();
    return text === "" || text === "–" ? null : text;
}

/// Compares keys: numbers before texts, empty cells last in both directions.
function compareKeys(a, b, direction) {
    if (a === null || b === null) return (a === null) - (b === null);
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return direction * (typeof a === "number" ? a - b : a.localeCompare(b, "en", { numeric: true }));
}

/// Rows that compare equal keep their order, so that sorting by one column and then by another sorts by both.
function sortRows(table, column, direction) {
    const body = table.tBodies[0];
    const keyed = [...body.rows].map((row) => [keyOf(row.cells[column]), row]);
    keyed.sort(([a], [b]) => compareKeys(a, b, direction));
    body.append(...keyed.map(([, row]) => row));
}

/// A column is sorted upwards, downwards, and then as it came.
function makeSortable(table) {
    const heads = [...table.tHead.rows[0].cells], asItCame = [...table.tBodies[0].rows];
    heads.forEach((head, column) => {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "sort";
        button.append(...[...head.childNodes].filter((node) => !node.classList?.contains("unit")));   // units have a line of their own
        if (button.lastChild?.nodeType === Node.TEXT_NODE) button.lastChild.data = button.lastChild.data.trimEnd();   // the arrow stays with the last word
        head.prepend(button);
        button.addEventListener("click", () => {
            const before = head.getAttribute("aria-sort");
            for (const other of heads) other.removeAttribute("aria-sort");
            if (before === "descending") {
                table.tBodies[0].append(...asItCame);
                return;
            }
            head.setAttribute("aria-sort", before === "ascending" ? "descending" : "ascending");
            sortRows(table, column, before === "ascending" ? -1 : 1);
        });
    });
}

/// A choice of the values of one column, in the order in which they come.
function choiceOf(table, head, column, changed) {
    const label = document.createElement("label"), select = document.createElement("select");
    select.append(new Option("all", ""));
    const values = new Set([...table.tBodies[0].rows].map((row) => row.cells[column].textContent.trim()));
    for (const value of values) select.append(new Option(value === "" ? "–" : value, value));
    select.autocomplete = "off";
    select.addEventListener("change", changed);
    label.append(head.textContent.trim(), select);
    return { label, allows: (row) => select.selectedIndex === 0 || row.cells[column].textContent.trim() === select.value };
}

function makeFilters(table) {
    const heads = [...table.tHead.rows[0].cells], rows = [...table.tBodies[0].rows];
    const told = document.createElement("output");
    const show = () => {
        for (const row of rows) row.hidden = !choices.every((choice) => choice.allows(row));
        told.textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} rows`;
    };
    const choices = heads.flatMap((head, column) => ("filter" in head.dataset ? [choiceOf(table, head, column, show)] : []));
    if (choices.length === 0) return;
    const tools = document.createElement("div");
    tools.className = "table-tools";
    tools.append(...choices.map((choice) => choice.label), told);
    (table.closest(".scroll") ?? table).before(tools);
    show();
}

// The tools of a table are made when it is nearly seen: of all tables at once they would hold the page up.
const nearlySeen = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
    if (!isIntersecting) return;
    nearlySeen.unobserve(target);
    makeFilters(target);
    makeSortable(target);
}), { rootMargin: "100% 0%" });
for (const table of document.querySelectorAll("table[data-sortable]")) nearlySeen.observe(table);

// ---- wide tables -------------------------------------------------------------------------------------------------------

const strips = ".plate > :is(.blocks, .cells)";

/// A strip of pictures that is wider than the window can be reached and moved by keyboard; one that is not is no stop on the way.
function makeReachable(strip, isWider) {
    if (isWider === strip.hasAttribute("tabindex")) return;
    const label = strip.closest("figure").querySelector("figcaption b")?.textContent.replace(/\.$/, "") ?? "this figure";
    for (const [name, value] of [["tabindex", "0"], ["role", "group"], ["aria-label", `Pictures of ${label}`]])
        isWider ? strip.setAttribute(name, value) : strip.removeAttribute(name);
}

/// At which sides there is more to be seen.
function tellOfMore(box) {
    const beyond = box.scrollWidth - box.clientWidth;
    if (box.matches(strips)) makeReachable(box, beyond > 1);
    const sides = [box.scrollLeft > 1 ? "left" : "", box.scrollLeft < beyond - 1 ? "right" : ""].join(" ").trim();
    if ((box.dataset.more ?? "") !== sides) sides ? (box.dataset.more = sides) : delete box.dataset.more;
}

const sizes = new ResizeObserver((entries) => entries.forEach((entry) => tellOfMore(entry.target)));
for (const box of document.querySelectorAll(`.scroll, ${strips}`)) {
    sizes.observe(box);
    box.addEventListener("scroll", () => tellOfMore(box), { passive: true });
}
