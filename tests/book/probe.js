// Errors of a page at the width of a phone. Run in every page of the book once it is loaded; what it returns
// is judged by tests/book/page_check.py. With a page's text and address it shows that page first, in the frame of the page that is
// loaded: its contents in place of the others, and links as from its own address.
(async (page, address) => {
  const all = (selector) => [...document.querySelectorAll(selector)];
  if (page !== null) {
    const other = new DOMParser().parseFromString(page, "text/html");
    const base = document.querySelector("base") ?? document.head.appendChild(document.createElement("base"));
    base.href = address;
    for (const part of ["doc-content", "nav-path"]) {
      const here = document.getElementById(part), there = other.getElementById(part);
      if (here && there) here.innerHTML = there.innerHTML;
    }
  } else if (window.MathJax?.Hub) {
    await new Promise((done) => MathJax.Hub.Queue(done));
  }
  if (page === null) await new Promise((done) => setTimeout(done, 0)); // what the pages do after their formulas

  const findings = [];
  const text_of = (value) => (typeof value === "string" ? value : (value?.baseVal ?? "")); // SVG has objects
  for (const image of all("img[src]")) {
    if (image.complete && image.naturalWidth === 0) findings.push(["image", image.getAttribute("src")]);
  }

  const code = "pre, code, script, style, textarea, noscript, .fragment";
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { data, parentElement } = texts.currentNode;
    if (/\\[()[\]]|\\f[$[\]{}]|\$\$/.test(data) && !parentElement.closest(code)) findings.push(["formula", data.trim().slice(0, 80)]);
  }
  const refused = all(".MathJax_Error, .MathJax_SVG_Error, merror, [data-mathml*='<merror']");
  for (const formula of refused) findings.push(["formula", formula.textContent.trim().slice(0, 80) || "a formula that MathJax refuses"]);

  // A list that does not begin with 1 is a number with a full stop at the start of a line; a blank before a full stop has lost one.
  for (const list of all(".contents ol[start]:not([start='1'])")) findings.push(["number", `a list begins with ${list.start}`]);
  for (const words of all(".contents p, .contents li, .contents figcaption")) {
    const lost = words.textContent.match(/\{\{.*|.{0,40}[a-z]\s+[.,;](?=\s|$)/);
    if (lost && !words.querySelector(".MathJax_SVG, .MathJax_Preview, code, img")) findings.push(["number", lost[0].trim()]);
  }

  // A brief description that Doxygen has cut at the full stop of an abbreviation leaves a bracket open.
  for (const brief of all("td.mdescRight, td.desc")) {
    const text = brief.textContent.replace(/More\.\.\.\s*$/, "").trim();
    if ((text.match(/[([]/g) ?? []).length > (text.match(/[)\]]/g) ?? []).length) findings.push(["summary", text.slice(0, 80)]);
  }

  // Boxes that scroll by themselves are allowed; the page, and the column that it scrolls in, must not.
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
    findings.push(["width", `${column.scrollWidth} px in ${column.clientWidth} (${name})`]);
    break;
  }

  return {
    findings,
    links: [...new Set(all("a[href], area[href], link[href]").map((e) => text_of(e.href)))],
    anchors: [...new Set(all("[id], a[name]").flatMap((e) => [e.id, e.getAttribute("name") ?? ""]).filter(Boolean))],
    friends: all("tr:has(.mlabel)")
      .filter((row) => [...row.querySelectorAll(".mlabel")].some((label) => label.textContent === "friend"))
      .flatMap((row) => [...row.querySelectorAll("a[href]")].map((e) => text_of(e.href))),
    explains: all("table.markdownTable, figure").length > 0, // and not lists declarations alone
  };
})
