// Lays the old picture of a pair over the new one, up to a line that a slider moves.
for (const figure of document.querySelectorAll("figure.slider")) {
    const old = figure.querySelector(".old"), slider = figure.querySelector("input");
    const show = () => { old.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`; };
    slider.addEventListener("input", show);
    show();
}
