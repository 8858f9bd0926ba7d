// Formulas of the pages, drawn by KaTeX; what it cannot read stays text, as everything does without scripts.
document.addEventListener("DOMContentLoaded", () => {
  for (const formula of document.querySelectorAll(".formula")) {
    try {
      katex.render(formula.textContent, formula, {displayMode: formula.tagName === "DIV"});
    } catch (error) {
      console.error(error.message);
    }
  }
});
