// Formulas, and the folded document when a link leads into it.
"use strict";
(() => {
  for (const element of document.querySelectorAll(".math")) {
    const latex = element.textContent;
    try {
      katex.render(latex, element, { displayMode: element.classList.contains("block"), throwOnError: true });
      element.classList.add("rendered");
    } catch (error) {
      element.textContent = latex; // which can be read, too
      element.title = error.message;
    }
  }
  const unfold = () => {
    const target = location.hash ? document.getElementById(decodeURIComponent(location.hash.slice(1))) : null;
    const folded = target && target.closest("details");
    if (folded && !folded.open) {
      folded.open = true;
      target.scrollIntoView();
    }
  };
  addEventListener("hashchange", unfold);
  unfold();
})();
