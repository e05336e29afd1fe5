// Chooses the colour scheme: that of the reader's system, or of a button. Runs before the page is drawn.
"use strict";
{
    const root = document.documentElement, system = matchMedia("(prefers-color-scheme: dark)");
    root.classList.add("js");

    // A page opened as a file may not be allowed to remember anything.
    const remembered = () => { try { return localStorage.getItem("meshfolio-scheme"); } catch { return null; } };
    const remember = (scheme) => { try { localStorage.setItem("meshfolio-scheme", scheme); } catch { /* then it holds for this page */ } };
    const current = () => root.dataset.scheme ?? (system.matches ? "dark" : "light");

    if (["light", "dark"].includes(remembered())) root.dataset.scheme = remembered();

    addEventListener("DOMContentLoaded", () => {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "scheme";
        const show = () => {
            const other = current() === "dark" ? "light" : "dark";
            button.textContent = other === "dark" ? "Dark" : "Light";
            button.setAttribute("aria-label", `Change to the ${other} scheme`);
        };
        button.addEventListener("click", () => {
            root.dataset.scheme = current() === "dark" ? "light" : "dark";
            remember(root.dataset.scheme);
            show();
        });
        system.addEventListener("change", show);
        show();
        document.querySelector(".contents")?.prepend(button);
    });
}
