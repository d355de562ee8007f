// SPDX-License-Identifier: BSD-3-Clause
// A button on every block of code that copies it; also on pages that are opened as files.

// What is typed at a console: its lines behind the prompt, without the prompt and without the output.
const typed = (pre) => {
  const lines = pre.textContent.split("\n");
  const isTyped = (k) => lines[k].startsWith("$ ") || (k > 0 && lines[k - 1].endsWith("\\") && isTyped(k - 1));
  return lines
    .filter((_, k) => isTyped(k))
    .map((line) => line.replace(/^\$ /, ""))
    .join("\n");
};

document.addEventListener("DOMContentLoaded", () => {
  for (const block of document.querySelectorAll("div.highlight")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      const pre = block.querySelector("pre");
      const text = block.closest(".highlight-console") ? typed(pre) : pre.textContent;
      const copied = await navigator.clipboard.writeText(text).then(
        () => true,
        () => false,
      );
      button.textContent = copied ? "Copied" : "Not allowed";
      setTimeout(() => (button.textContent = "Copy"), 1500);
    });
    block.append(button);
  }
});
