// The contents list follows the scroll: the section that is read is marked and shows its parts. Folded parts open where a link leads.

const list = document.querySelector(".contents");
const links = new Map([...document.querySelectorAll(".contents a")].map((a) => [a.getAttribute("href").slice(1), a]));
const targets = [...links.keys()].map((id) => document.getElementById(id)).filter(Boolean);

/// The last target whose top has passed the upper third of the window.
function reached() {
    const limit = innerHeight / 3;
    let last = null;
    for (const target of targets) {
        if (target.getBoundingClientRect().top > limit) break;
        last = target;
    }
    return last;
}

let shown = null;
function follow() {
    const target = reached();
    if (target === shown) return;
    shown = target;
    for (const item of document.querySelectorAll(".contents .current")) item.classList.remove("current");
    for (const link of links.values()) link.removeAttribute("aria-current");
    const link = target && links.get(target.id);
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
follow();

/// On a small screen the list would be all there is to be seen: it is folded behind a button.
const button = document.createElement("button");
button.type = "button";
button.className = "unfold";
button.textContent = "Contents";
const fold = (open) => {
    list.classList.toggle("open", open);
    button.setAttribute("aria-expanded", String(open));
};
button.addEventListener("click", () => fold(!list.classList.contains("open")));
list.addEventListener("click", (event) => { if (event.target.closest("a")) fold(false); });
fold(false);
list.prepend(button);

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

// The list of checks is long, and its parts have their scores in their titles. What has not passed stays open.
for (const details of document.querySelectorAll("details.checks")) details.open = details.querySelector(".not-passed, .undecided") !== null;
unfold();

// Printing shows what is folded away on the screen.
addEventListener("beforeprint", () => {
    for (const details of document.querySelectorAll("details:not(.views)")) details.open = true;
});
