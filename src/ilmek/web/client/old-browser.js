// Shows a notice in a browser that lacks what the page needs. It runs before the page, in every browser, so it is
// written for old ones.
(function () {
  var css = window.CSS && window.CSS.supports;
  var modern =
    "noModule" in document.createElement("script") &&
    window.structuredClone &&
    window.ResizeObserver &&
    window.HTMLDialogElement &&
    css &&
    window.CSS.supports("color", "color-mix(in srgb, red, blue)") &&
    window.CSS.supports("height", "1dvh") &&
    window.CSS.supports("selector(:has(a))");

  function show() {
    document.getElementById("old-browser").hidden = false;
  }

  if (!modern) show();
  window.addEventListener("error", function (event) {
    if (/SyntaxError/.test(event.message)) show();
  });
})();
