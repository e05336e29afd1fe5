// Before and after: side by side as on paper, one sliding over the other, or the difference alone.

function element(name, properties, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
}

/// The two pictures over each other; a range input, which the keyboard knows, says how much of the first is seen.
function sliderOf(panels) {
    const names = panels.map((panel) => panel.querySelector(".panel-name").textContent);
    const [before, after] = panels.slice(0, 2).map((panel) => panel.querySelector("img").cloneNode());
    after.className = "after";
    const tags = [element("span", { className: "tag left" }, names[0]), element("span", { className: "tag right" }, names[1])];
    const pair = element("div", { className: "pair" }, before, after, ...tags, element("span", { className: "edge" }));
    const input = element("input", { type: "range", min: 0, max: 100, step: 1, value: 50, autocomplete: "off" });
    input.setAttribute("aria-label", `How much of “${names[0]}” is seen over “${names[1]}”`);
    const show = () => {
        pair.style.setProperty("--seen", `${input.value}%`);
        input.setAttribute("aria-valuetext", `${input.value} % ${names[0]}`);
    };
    input.addEventListener("input", show);
    const follow = (event) => {
        const box = pair.getBoundingClientRect();
        input.value = Math.round(100 * (event.clientX - box.left) / box.width);
        show();
    };
    pair.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) return;
        event.preventDefault();
        pair.setPointerCapture(event.pointerId);
        follow(event);
        input.focus({ preventScroll: true });
    });
    pair.addEventListener("pointermove", (event) => { if (pair.hasPointerCapture(event.pointerId)) follow(event); });
    show();
    return element("div", { className: "slider" }, pair, input);
}

function makeComparison(comparison) {
    const panels = [...comparison.querySelectorAll(".panel")];
    let slider = null;
    const ways = [["sides", "Side by side"], ["slide", "Slider"]];
    if (panels.length > 2) ways.push(["difference", "Difference"]);
    const choose = (way) => {
        if (way === "slide" && !slider) comparison.append(slider = sliderOf(panels));
        comparison.dataset.way = way;
        for (const button of buttons) button.setAttribute("aria-pressed", String(button.value === way));
    };
    const buttons = ways.map(([value, name]) => element("button", { type: "button", value, onclick: () => choose(value) }, name));
    comparison.prepend(element("div", { className: "ways" }, ...buttons));
    choose("sides");
}

for (const comparison of document.querySelectorAll(".comparison")) makeComparison(comparison);
