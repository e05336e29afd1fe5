// Joined to report.js where the page has models to turn. Nothing of the viewer is parsed before the first of them is started: it lies in
// the page as data, like the models, and becomes a script whose hash the page's policy lists.
{
    const failure = "This browser cannot show it in three dimensions; the picture shows the same.";
    let viewer = null;

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

    const prepare = (block) => {
        const picture = block.previousElementSibling, files = block.querySelector(".files");
        const button = document.createElement("button"), note = document.createElement("span");
        button.type = "button";
        button.className = "model-button turn";
        button.textContent = "Turn in 3D";
        note.className = "model-note";
        note.setAttribute("role", "status");
        files.prepend(button, " ", note, " ");

        const closed = (byReader) => {
            picture.classList.remove("behind-model");
            button.hidden = false;
            if (byReader) button.focus();
        };
        button.addEventListener("click", async () => {
            button.disabled = true;
            note.textContent = "";
            try {
                viewer ??= await loadViewer();
                const scripts = [...block.querySelectorAll('script[type="model/gltf-binary"]')];
                const models = await Promise.all(scripts.map(async (s) => ({ label: s.dataset.label, bytes: await inflated(s) })));
                button.hidden = true;
                picture.classList.add("behind-model");
                await viewer.start(block, models, closed);
            } catch {
                closed(false);
                note.textContent = failure;
            }
            button.disabled = false;
        });
    };
    for (const block of document.querySelectorAll(".models[data-turnable]")) prepare(block);
}
