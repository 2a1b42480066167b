// The loom in space is shown when its button is pressed: until then nothing of it is unpacked.
(() => {
  const button = document.getElementById("show-loom");
  const client = document.getElementById("loom-client");
  if (button === null || client === null) return;
  const sorry = (text) => {
    button.replaceWith(document.createTextNode(text));
  };
  button.addEventListener("click", async () => {
    if (typeof DecompressionStream === "undefined") return sorry("This browser is too old for the picture in space.");
    button.disabled = true;
    const bytes = Uint8Array.from(atob(client.textContent.trim()), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const script = document.createElement("script");
    script.textContent = await new Response(stream).text();
    button.remove();
    document.body.append(script);
  });
})();
