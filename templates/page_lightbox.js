// Pictures open large: the full-size files beside the page, or the previews inside it where they are not there.

/// The pictures of a figure: the sheet with all of them, then those that are files of their own. {href, name, preview, alt}
function picturesOf(figure) {
    const pictures = [], first = figure.querySelector(".plate img");
    for (const link of figure.querySelectorAll(".files > a.sheet, figure.cover .plate > a, .views a")) {
        const href = link.getAttribute("href");
        const image = [...figure.querySelectorAll(".plate a")].find((a) => a.getAttribute("href") === href)?.querySelector("img");
        const name = link.matches(".views a") ? [link.closest("li")?.querySelector(".panel")?.textContent, link.textContent] : [];
        pictures.push({ href, name: name.filter(Boolean).join(" ").trim(), preview: (image ?? first)?.src, alt: (image ?? first)?.alt });
    }
    return pictures;
}

const figures = [...document.querySelectorAll("figure.cover, figure.picture")].filter((figure) => figure.querySelector(".plate img"));

const dialog = document.createElement("dialog");
dialog.className = "lightbox";
dialog.setAttribute("aria-label", "Figure in full size");
dialog.innerHTML = `<div class="bar"><p class="where" aria-live="polite"></p>
<button type="button" data-step="0,-1" aria-label="Previous view">↑</button><button type="button" data-step="0,1" aria-label="Next view">↓</button>
<button type="button" data-step="-1,0" aria-label="Previous figure">←</button><button type="button" data-step="1,0" aria-label="Next figure">→</button>
<button type="button" data-close="" aria-label="Close">✕</button></div>
<div class="stage"><img alt=""/></div><p class="caption"></p>`;
document.body.append(dialog);

const image = dialog.querySelector("img"), where = dialog.querySelector(".where"), caption = dialog.querySelector(".caption");
let at = 0, view = 0, pictures = [], opener = null;

function show() {
    const figure = figures[at], picture = pictures[view];
    const label = figure.querySelector("figcaption b")?.textContent ?? "";
    const count = pictures.length > 1 ? ` (${view + 1} of ${pictures.length})` : "";
    where.textContent = [label, picture.name].filter(Boolean).join(" ") + count;
    caption.textContent = figure.querySelector("figcaption .text")?.textContent ?? "";
    const fallback = picture.preview ?? pictures[0].preview;
    image.onerror = () => {
        image.onerror = null;
        image.src = fallback;
        where.textContent += " – only the preview: images/ is not beside this page";
    };
    image.alt = picture.alt ?? `${label} ${picture.name}`;
    image.src = picture.href;
    for (const button of dialog.querySelectorAll('[data-step^="0,"]')) button.hidden = pictures.length < 2;
}

function go(figures_on, views_on) {
    if (figures_on) {
        at = (at + figures_on + figures.length) % figures.length;
        pictures = picturesOf(figures[at]);
        view = 0;
    } else {
        view = (view + views_on + pictures.length) % pictures.length;
    }
    show();
}

/// @param from  what was clicked: a link to a picture, or a picture without one, which is seen in the sheet
function open(from) {
    opener = from.closest("a") ?? from.closest("figure").querySelector(".files > a.sheet");
    at = figures.indexOf(from.closest("figure"));
    pictures = picturesOf(figures[at]);
    view = Math.max(0, pictures.findIndex((picture) => picture.href === opener?.getAttribute("href")));
    show();
    dialog.showModal();
}

document.addEventListener("click", (event) => {
    if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
    const from = event.target.closest?.("figure.cover .plate > a, figure.picture .plate a, .plate .panel img, .lead img, .directions img, .files > a.sheet, .views a");
    if (!from || from.closest(".pair") || !figures.includes(from.closest("figure"))) return;
    event.preventDefault();
    open(from);
});
const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
dialog.addEventListener("keydown", (event) => {
    if (!steps[event.key]) return;
    event.preventDefault();
    go(...steps[event.key]);
});
dialog.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button?.dataset.step) go(...button.dataset.step.split(",").map(Number));
    else if (button || event.target === dialog || event.target.matches(".stage")) dialog.close();
});
dialog.addEventListener("close", () => {
    image.removeAttribute("src");
    opener?.focus();
});
