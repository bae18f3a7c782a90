import { element } from "./dom.mjs";

async function copyText(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = element("textarea", { class: "unseen" });
  area.value = text;
  document.body.append(area);
  area.select();
  document.execCommand("copy");
  area.remove();
}

/** A command line with a button that copies it. */
export function commandLine(command) {
  const button = element("button.small", { type: "button", "aria-label": "Copy the command" }, "Copy");
  button.addEventListener("click", async () => {
    try {
      await copyText(command);
      button.textContent = "Copied";
    } catch {
      button.textContent = "Select and copy it";
    }
    setTimeout(() => {
      button.textContent = "Copy";
    }, 2000);
  });
  return element("div.command", {}, element("code", {}, command), button);
}
