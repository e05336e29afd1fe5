// Joined to report.js where the page has models to turn or a laboratory. Nothing of the viewer is parsed before the first of them is
// started: it lies in the page as data, like the models, and becomes a script whose hash the page's policy lists.
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

    /// Puts a button and a place for what goes wrong at the head of `place`. `start(closed)` fills the page, or throws.
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
                const models = await Promise.all(scripts.map(async (s) => ({ label: s.dataset.label, bytes: await inflated(s) })));
                ready();
                await viewer.start(block, models, closed);
            },
            opened: () => picture.classList.add("behind-model"),
            closed: () => picture.classList.remove("behind-model"),
        });
    }

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
        const openFromLink = () => {
            if (button.hidden) return;
            if (block.dataset.opens !== undefined) return button.click();   // the page has nothing else
            if (new RegExp(`^#lab(=|%3D)${question}(,|%2C|$)`, "i").test(location.hash)) {
                button.click();
                block.scrollIntoView();
            }
        };
        addEventListener("hashchange", openFromLink);
        openFromLink();
    }
}
