// The contents list follows the scroll: the section that is read is marked and shows its parts. In a narrow window it is a bar that names
// the section and unfolds. Folded parts open where a link leads.

const list = document.querySelector(".contents");
const links = new Map([...document.querySelectorAll(".contents a")].map((a) => [a.getAttribute("href").slice(1), a]));
const targets = [...links.keys()].map((id) => document.getElementById(id)).filter(Boolean);
const sections = targets.filter((target) => !target.parentElement.closest("section"));

/// Returns the last of these elements with its top above a third of the window's height.
function lastReached(list) {
    const limit = innerHeight / 3;
    let last = null;
    for (const target of list) {
        if (target.getBoundingClientRect().top > limit) break;
        last = target;
    }
    return last;
}

/// Returns the heading at the reading position. Headings of other sections have no position yet (content-visibility).
function reached() {
    const section = lastReached(sections);
    return section && (lastReached(targets.filter((target) => target !== section && section.contains(target))) ?? section);
}

// In a narrow window the list is folded behind a button with the current heading.
const button = document.createElement("button"), now = document.createElement("span");
button.type = "button";
button.className = "unfold";
button.setAttribute("aria-controls", "contents-list");
now.className = "now";
button.append(Object.assign(document.createElement("b"), { textContent: "Contents" }), " ", now);
const fold = (open) => {
    list.classList.toggle("open", open);
    button.setAttribute("aria-expanded", String(open));
};
button.addEventListener("click", () => fold(!list.classList.contains("open")));
list.addEventListener("click", (event) => { if (event.target.closest("a")) fold(false); });
list.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !list.classList.contains("open")) return;
    fold(false);
    button.focus();
});
document.addEventListener("pointerdown", (event) => { if (!list.contains(event.target)) fold(false); });
fold(false);
list.prepend(button);

let shown = null;
function follow() {
    const target = reached();
    if (target === shown) return;
    shown = target;
    for (const item of document.querySelectorAll(".contents .current")) item.classList.remove("current");
    for (const link of links.values()) link.removeAttribute("aria-current");
    const link = target && links.get(target.id);
    const names = link?.closest(".contents > ol > li").querySelector("a").childNodes ?? [];
    now.textContent = [...names].map((name) => name.textContent).join(" ");
    if (!link) return;
    link.setAttribute("aria-current", "true");
    for (let item = link.closest("li"); item; item = item.parentElement.closest(".contents li")) item.classList.add("current");
    if (list.scrollHeight <= list.clientHeight) return;
    const top = link.offsetTop - list.clientHeight / 2;
    list.scrollTo({ top });
}

let waiting = false;
function later() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; follow(); });
}
addEventListener("scroll", later, { passive: true });
addEventListener("resize", later, { passive: true });
later();   // not at once: where things are is worked out for the first picture anyway

/// A link into something that is folded away opens it.
function unfold() {
    let id = "";
    try { id = decodeURIComponent(location.hash.slice(1)); } catch { return; }   // "%" alone: no id of ours
    const target = document.getElementById(id);
    const details = target?.closest("details");
    if (!details || details.open) return;
    details.open = true;
    target.scrollIntoView();
}
addEventListener("hashchange", unfold);

// The long list of checks is folded, except parts with checks that did not pass.
for (const details of document.querySelectorAll("details.checks")) details.open = details.querySelector(".not-passed, .undecided") !== null;
unfold();

// Printing unfolds all parts.
addEventListener("beforeprint", () => {
    for (const details of document.querySelectorAll("details:not(.views, .model-files)")) details.open = true;
});
