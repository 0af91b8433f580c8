// Run in every page of the book once it is loaded; what it returns is judged by tests/book/page_check.cpp.
(async () => {
  if (window.MathJax?.Hub) await new Promise((done) => MathJax.Hub.Queue(done));
  await new Promise((done) => setTimeout(done, 0)); // what the pages do after their formulas

  const text_of = (value) => (typeof value === "string" ? value : (value?.baseVal ?? "")); // SVG has objects
  const all = (selector) => [...document.querySelectorAll(selector)];

  const code = "pre, code, script, style, textarea, noscript, .fragment";
  const tex = [];
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { data, parentElement } = texts.currentNode;
    if (/\\[()[\]]|\\f[$[\]{}]|\$\$/.test(data) && !parentElement.closest(code)) tex.push(data.trim().slice(0, 80));
  }
  const refused = all(".MathJax_Error, .MathJax_SVG_Error, merror, [data-mathml*='<merror']");
  for (const formula of refused) tex.push(formula.textContent.trim().slice(0, 80) || "a formula that MathJax refuses");

  // Boxes that scroll by themselves are allowed; the page, and the column that it scrolls in, must not.
  const wide = [];
  const columns = [document.documentElement, document.getElementById("doc-content")].filter(Boolean);
  for (const column of columns) {
    if (column.scrollWidth <= column.clientWidth + 1) continue;
    const scrolls = (element) => {
      for (let e = element.parentElement; e && e !== column; e = e.parentElement) {
        if (getComputedStyle(e).overflowX !== "visible") return true;
      }
      return false;
    };
    const edge = column.getBoundingClientRect().left + column.clientWidth + 1;
    const widest = all("body *").filter((e) => column.contains(e) && e.getBoundingClientRect().right > edge && !scrolls(e)).at(-1);
    const name = widest ? `${widest.localName}.${text_of(widest.className)}: ${widest.textContent.trim().slice(0, 50)}` : "";
    wide.push(`${column.scrollWidth} px in ${column.clientWidth} (${name})`);
    break;
  }

  return {
    links: [...new Set(all("a[href], area[href], link[href]").map((e) => text_of(e.href)))],
    anchors: [...new Set(all("[id], a[name]").flatMap((e) => [e.id, e.getAttribute("name") ?? ""]).filter(Boolean))],
    friends: all("tr:has(.mlabel)")
      .filter((row) => [...row.querySelectorAll(".mlabel")].some((label) => label.textContent === "friend"))
      .flatMap((row) => [...row.querySelectorAll("a[href]")].map((e) => text_of(e.href))),
    images: all("img[src]").filter((e) => e.complete && e.naturalWidth === 0).map((e) => e.getAttribute("src")),
    tex,
    wide,
  };
})();
