// Runs only in browsers without modules, so it is written for them.
document.getElementById("old-browser").hidden = false;
