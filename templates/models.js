// Starts models and laboratories of a page. The viewer is data in the page, like the models, until the first of them is started: then it
// becomes a script, whose hash the policy of the page lists.
{
    let viewer = null, loading = null;

    const inflated = (element) => {
        const packed = Uint8Array.from(atob(element.textContent), (c) => c.charCodeAt(0));
        return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
    };

    const loadViewer = async () => {
        const script = document.createElement("script");
        script.textContent = new TextDecoder().decode(await inflated(document.getElementById("viewer-program")));
        document.head.append(script);
        if (!globalThis.meshfolioViewer) throw new Error("the viewer was not run");
        return globalThis.meshfolioViewer;
    };

    /// Puts a button and a place for error messages at the head of `place`. `start(closed)` fills the page, or throws.
    const prepare = (place, words, failure, { start, opened = () => {}, closed = () => {} }) => {
        const button = document.createElement("button"), note = document.createElement("span");
        button.type = "button";
        button.className = "model-button turn";
        button.textContent = words;
        note.className = "model-note";
        note.setAttribute("role", "status");
        place.prepend(button, " ", note, " ");

        const ended = (byReader) => {
            closed();
            button.hidden = false;
            if (byReader) button.focus();
        };
        button.addEventListener("click", async () => {
            button.disabled = true;
            note.textContent = "";
            try {
                viewer = await (loading ??= loadViewer());
                await start(() => { button.hidden = true; opened(); }, ended);
            } catch {
                ended(false);
                note.textContent = failure;
            }
            button.disabled = false;
        });
        return button;
    };

    for (const block of document.querySelectorAll(".models[data-turnable]")) {
        const picture = block.previousElementSibling;
        prepare(block.querySelector(".files"), "Turn in 3D", "This browser cannot show it in three dimensions; the picture shows the same.", {
            async start(ready, closed) {
                const scripts = [...block.querySelectorAll('script[type="model/gltf-binary"]')];
                ready();
                await viewer.start(block, scripts.map((s) => ({ label: s.dataset.label, bytes: () => inflated(s) })), closed);
                block.querySelector(".model-panel").scrollIntoView({ block: "nearest" });
            },
            opened: () => picture.classList.add("behind-model"),
            closed: () => picture.classList.remove("behind-model"),
        });
    }

    /// A link that opens the laboratory of a question.
    const linkToLab = (question, words) => Object.assign(document.createElement("a"), { className: "model-button try", href: `#lab-${question}`, textContent: words });

    /// Makes the preview of a laboratory: a picture of the question and its button.
    const showStill = (block, button) => {
        const picture = block.closest("section").querySelector("figure.picture .plate img"), still = document.createElement("span");
        const words = Object.assign(document.createElement("span"), { textContent: "Try it: drag a slider, see the mesh change" });
        still.className = "plate";
        if (picture) still.append(Object.assign(new Image(), { src: picture.src, alt: "" }));
        button.prepend(still, words);
        button.classList.add("still");
    };

    /// Opens a laboratory from the contents or from the first page.
    const linkFromHead = (question) => {
        document.querySelector(`ol.attempted a[href="#${question}"]`)?.parentElement.querySelector("p")?.before(linkToLab(question, "Try it"), " ");
        const list = document.querySelector("#contents-list");
        if (!list || list.querySelector(".try")) return;
        const link = Object.assign(linkToLab(question, "Live laboratory"), { className: "try" });
        list.append(Object.assign(document.createElement("li"), { className: "try" }));
        list.lastChild.append(link);
    };

    // "#lab=q5,lambda=1.01,t=40" opens the laboratory of question 5.
    for (const block of document.querySelectorAll(".lab")) {
        const { question } = block.dataset;
        const data = document.querySelector(`script[type="application/x-meshfolio-lab"][data-questions~="${question}"]`);
        if (!data) continue;
        const button = prepare(block, "Open the live laboratory", "This browser cannot open the laboratory; the figures show such results.", {
            async start(ready, closed) {
                const bytes = await inflated(data);
                ready();
                await viewer.startLab(block, bytes, question, closed);
            },
        });
        if (block.closest("section")) showStill(block, button), linkFromHead(question);
        const openFromLink = () => {
            if (button.hidden) return;
            if (block.dataset.opens !== undefined) return button.click();   // the page has nothing else
            if (new RegExp(`^#lab(=|%3D|-)${question}(,|%2C|$)`, "i").test(location.hash)) {
                button.click();
                block.scrollIntoView();
            }
        };
        addEventListener("hashchange", openFromLink);
        openFromLink();
    }
}
