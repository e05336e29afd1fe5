// A picture opens large: the view that was tapped, cut to its object, with the colours' legend and the caption of its figure. Files in
// images/ are shown where there are some, else the pictures of the page.

const fillOfFiles = 0.92, spare = 0.06;   // of a file's side: its largest object (DrawOptions::fill), and what is left around
const mostBlown = 3;                      // times its own pixels, where the window would hold more

const isView = (image) => image.closest(".direction") !== null;

/// The part of a file that its object takes, {x, y}. The largest extent fills files alike, and pictures of the page are cut to the object.
/// A file has its direction in a corner: either that is cut away or all is shown.
function partOf(image) {
    const alike = isView(image) ? [...image.closest(".directions").querySelectorAll("img")] : [image];
    const side = (name) => Number(image.getAttribute(name));
    const longest = Math.max(...alike.flatMap((one) => [one.getAttribute("width"), one.getAttribute("height")].map(Number)));
    const [x, y] = ["width", "height"].map((name) => Math.min(1, fillOfFiles * side(name) / longest + spare));
    return x < 0.75 || y < 0.8 ? { x, y } : { x: 1, y: 1 };
}

/// The pictures of a figure in their order, then the sheet with all of them. {href, name, image, alt}
function picturesOf(figure) {
    const images = [...figure.querySelectorAll(".plate img")], sheet = figure.querySelector(".files > a.sheet");
    const textOf = (element, selector) => element?.querySelector(selector)?.textContent.trim();
    const pictures = images.map((image) => {
        const names = [textOf(image.closest(".block, .panel"), ".panel-name"), textOf(image.closest(".direction"), ".view-name")];
        return { href: image.closest("a")?.getAttribute("href"), name: names.filter(Boolean).join(", "), image, alt: image.alt };
    });
    return sheet ? [...pictures, { href: sheet.getAttribute("href"), name: "whole figure", isSheet: true, alt: images[0].alt }] : pictures;
}

const figures = [...document.querySelectorAll("figure.cover, figure.picture")].filter((figure) => figure.querySelector(".plate img"));

const dialog = document.createElement("dialog");
dialog.className = "lightbox";
dialog.setAttribute("aria-label", "Figure in full size");
dialog.innerHTML = `<div class="bar"><p class="where" aria-live="polite"></p>
<button type="button" data-zoom="" aria-pressed="false" aria-label="1 : 1, zoom">1 : 1</button>
<button type="button" data-step="0,-1" aria-label="Previous view">←</button><button type="button" data-step="0,1" aria-label="Next view">→</button>
<button type="button" data-step="-1,0" aria-label="Previous figure">↑</button><button type="button" data-step="1,0" aria-label="Next figure">↓</button>
<button type="button" data-close="" aria-label="Close">✕</button></div>
<div class="stage" tabindex="-1"><div class="part"><img alt=""/></div></div><div class="legend-box"></div><p class="caption"></p>`;
document.body.append(dialog);

const [image, where, caption, stage, part, legend, zoomButton] =
    ["img", ".where", ".caption", ".stage", ".part", ".legend-box", "[data-zoom]"].map((selector) => dialog.querySelector(selector));
let at = 0, view = 0, pictures = [], opener = null, isZoomed = false;

/// Sets the size: as large as the window allows, not smaller than on the page; zoomed, pixel by pixel or twice that.
function place(centre = { x: 0.5, y: 0.5 }) {
    const picture = pictures[view], { naturalWidth, naturalHeight } = image;
    if (!dialog.open || !naturalWidth) return;
    const isFile = picture.image && picture.href && image.src === new URL(picture.href, document.baseURI).href;
    const share = isFile && naturalWidth === naturalHeight ? partOf(picture.image) : { x: 1, y: 1 };
    const width = naturalWidth * share.x, height = naturalHeight * share.y;
    const onPage = picture.image ? picture.image.getBoundingClientRect().width / width : 0;
    const fitted = Math.max(Math.min(stage.clientWidth / width, stage.clientHeight / height, mostBlown), onPage);
    const scale = isZoomed ? Math.max(1, 2 * fitted) : fitted;
    Object.assign(part.style, { width: `${scale * width}px`, height: `${scale * height}px` });
    Object.assign(image.style, { width: `${scale * naturalWidth}px`, height: `${scale * naturalHeight}px`,
        left: `${scale * (width - naturalWidth) / 2}px`, top: `${scale * (height - naturalHeight) / 2}px` });
    stage.scrollTo(centre.x * part.offsetWidth - stage.clientWidth / 2, centre.y * part.offsetHeight - stage.clientHeight / 2);
}

function zoom(on, centre) {
    isZoomed = on;
    zoomButton.setAttribute("aria-pressed", String(on));
    stage.classList.toggle("zoomed", on);
    place(centre);
}

/// Returns the contents of an element with its formulas, without ids, which are unique in the page, and links, which would lead behind the dialog.
function wordsOf(element) {
    if (!element) return [];
    const copy = element.cloneNode(true);
    for (const marked of copy.querySelectorAll("[id], a")) marked.removeAttribute("id"), marked.removeAttribute("href");
    return [...copy.childNodes];
}

function show() {
    const figure = figures[at], picture = pictures[view], preview = picture.image ?? figure.querySelector(".plate img");
    const label = figure.querySelector("figcaption b")?.textContent.replace(/\.$/, "");
    where.textContent = [label, picture.name].filter(Boolean).join(": ") + (pictures.length > 1 ? ` (${view + 1} of ${pictures.length})` : "");
    caption.replaceChildren(...wordsOf(figure.querySelector("figcaption .text") ?? figure.querySelector("figcaption")));
    const own = picture.image?.closest(".block, .panel")?.querySelector("svg.legend"), bar = own ?? figure.querySelector(".legend-box svg");
    legend.replaceChildren(...[bar?.cloneNode(true)].filter((svg) => svg && !picture.isSheet));
    image.onload = () => place();
    image.onerror = () => {
        image.onerror = null;
        image.src = preview.src;
        where.textContent += " – only the preview: images/ is not beside this page";
    };
    image.alt = picture.alt;
    image.src = picture.href ?? preview.src;
    for (const button of dialog.querySelectorAll('[data-step^="0,"]')) button.hidden = pictures.length < 2;
    zoom(false);
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

/// @param from  the clicked element: a picture, or a link to one or to the sheet
function open(from) {
    const figure = from.closest("figure"), clicked = from.matches("img") ? from : from.querySelector("img");
    opener = from.closest("a") ?? figure.querySelector(".files > a.sheet");
    at = figures.indexOf(figure);
    pictures = picturesOf(figure);
    view = Math.max(0, pictures.findIndex((picture) => clicked ? picture.image === clicked : picture.href === opener.getAttribute("href")));
    dialog.showModal();
    show();
}

document.addEventListener("click", (event) => {
    if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
    const from = event.target.closest?.(".plate img, .plate a, .files > a.sheet, .views a");
    if (!from || !figures.includes(from.closest("figure"))) return;
    event.preventDefault();
    open(from);
});
const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
dialog.addEventListener("keydown", (event) => {
    if (!steps[event.key] || (isZoomed && event.target === stage)) return;
    event.preventDefault();
    go(...steps[event.key]);
});
dialog.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button?.dataset.step) go(...button.dataset.step.split(",").map(Number));
    else if (button === zoomButton || event.target === image) {
        const box = part.getBoundingClientRect();
        zoom(!isZoomed, button ? undefined : { x: (event.clientX - box.x) / box.width, y: (event.clientY - box.y) / box.height });
    } else if (button || event.target === dialog || event.target.matches(".stage")) dialog.close();
});

// A finger that moves sideways turns to the next view, unless it moves the zoomed picture.
let touched = null;
stage.addEventListener("pointerdown", (event) => { touched = event.pointerType === "touch" && event.isPrimary && !isZoomed ? event : null; });
stage.addEventListener("pointercancel", () => { touched = null; });
stage.addEventListener("pointerup", (event) => {
    const dx = event.clientX - touched?.clientX, dy = event.clientY - touched?.clientY;
    touched = null;
    if (Math.abs(dx) < 40 || Math.abs(dx) < 2 * Math.abs(dy)) return;
    go(0, dx < 0 ? 1 : -1);
});
new ResizeObserver(() => place()).observe(stage);
dialog.addEventListener("close", () => {
    image.removeAttribute("src");
    opener?.focus({ preventScroll: true });
});
