// Extras only: without this script nothing is missing from the page.
"use strict";

// The contents list follows the scroll.
const links = new Map([...document.querySelectorAll(".contents a")].map((a) => [a.getAttribute("href").slice(1), a]));
const inView = new Set();
const observer = new IntersectionObserver((entries) => {
    for (const entry of entries) entry.isIntersecting ? inView.add(entry.target) : inView.delete(entry.target);
    const first = [...document.querySelectorAll("main section[id]")].find((section) => inView.has(section));
    for (const [id, link] of links) {
        if (first?.id === id) link.setAttribute("aria-current", "true");
        else link.removeAttribute("aria-current");
    }
}, { rootMargin: "-10% 0px -70% 0px" });
for (const section of document.querySelectorAll("main section[id]")) observer.observe(section);

// Printing shows what is folded away on the screen.
addEventListener("beforeprint", () => {
    for (const details of document.querySelectorAll("details:not(.views)")) details.open = true;
});
