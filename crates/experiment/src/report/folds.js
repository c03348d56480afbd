// Opens the folds around what an address or a link names, and all of them for paper.
(() => {
  "use strict";
  function reveal() {
    const named = document.getElementById(location.hash.slice(1));
    if (!named) return;
    for (let at = named; at; at = at.parentElement) if (at.matches("details")) at.open = true;
    for (const fold of named.querySelectorAll(":scope > details")) fold.open = true;
    named.scrollIntoView();
  }
  addEventListener("hashchange", reveal);
  // The same link again changes no address.
  for (const link of document.querySelectorAll("nav a[href^='#']")) {
    link.addEventListener("click", () => setTimeout(reveal));
  }
  const opened = [];
  addEventListener("beforeprint", () => {
    for (const fold of document.querySelectorAll("main details:not([open])")) { fold.open = true; opened.push(fold); }
  });
  addEventListener("afterprint", () => { while (opened.length) opened.pop().open = false; });
  reveal();
})();
