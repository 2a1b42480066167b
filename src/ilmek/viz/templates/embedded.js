// Runs a part of the client that the page holds, compressed. An old browser keeps the figures that stand still.
async function runClient(id) {
  const held = document.getElementById(id);
  if (held === null || typeof DecompressionStream === "undefined") return;
  const bytes = Uint8Array.from(atob(held.textContent.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const script = document.createElement("script");
  script.textContent = await new Response(stream).text();
  document.body.append(script);
}
runClient("figures-client");
