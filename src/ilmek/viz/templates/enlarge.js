for (const button of document.querySelectorAll("button.zoom")) {
  button.addEventListener("click", () => {
    const dialog = document.getElementById("enlarged");
    const picture = button.querySelector("img").cloneNode();
    const times = Number(button.dataset.times || 1);
    picture.removeAttribute("style");
    picture.style.width = Math.round(Number(button.dataset.width) * times) + "px";
    picture.style.height = Math.round(Number(button.dataset.height) * times) + "px";
    dialog.replaceChildren(picture);
    dialog.showModal();
  });
}
document.getElementById("enlarged").addEventListener("click", (event) => event.currentTarget.close());
