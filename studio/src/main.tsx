import { render } from "preact";
import { App } from "./app/app";
import { applySettings } from "./app/settings";
import "./ui/style.css";
import "./app/app.css";

const place = document.getElementById("studio");
if (place !== null) {
  await applySettings();
  render(<App />, place);
}
