/** The English texts of the frame and of the first view; those of the others are in `views`. */
import app from "./app";
import carpet from "./carpet";
import figure from "./figure";
import project from "./project";
import ui from "./ui";

export const en = { app, carpet, figure, project, ui };
