import { render } from "preact";
import { connect } from "./api/events";
import { App } from "./app/app";
import { applySettings } from "./app/settings";
import { follow } from "./project";
import "./ui/tokens.css";
import "./ui/parts.css";
import "./ui/style.css";
import "./app/app.css";

const place = document.getElementById("studio");
if (place !== null) {
  connect();
  await applySettings();
  follow();
  render(<App />, place);
}
