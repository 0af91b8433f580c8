// What the pages do: enlarge figures, let wide tables scroll, move snippets to the left margin, fit formulas,
// keep the chapters in sight. Without this script everything is still there: a figure's link opens its file.
"use strict";

// Snippets are cut out of functions and come with their indentation, and with blank lines at their ends.
function outdent(fragment) {
  const lines = [...fragment.querySelectorAll(":scope > .line")];
  const blank = (line) => line.textContent.trim() === "";
  const inked = lines.filter((line) => !blank(line));
  if (!inked.length) return;
  while (blank(lines[0])) lines.shift().remove();
  while (blank(lines.at(-1))) lines.pop().remove();
  const shift = Math.min(...inked.map((line) => line.textContent.search(/[^ ]/)));
  for (const line of lines) {
    const first = document.createTreeWalker(line, NodeFilter.SHOW_TEXT).nextNode();
    if (first) first.data = first.data.slice(Math.min(shift, first.data.match(/^ */)[0].length));
  }
}

// The picture of a link fills the window; Escape, the button or a click closes it, and the link has the focus
// again.
// A picture that answers is a document of its own there, and a click in it is its own.
function enlarge(link, dialog) {
  const answers = link.parentElement.querySelector("a.curves") !== null || link.classList.contains("curves");
  const large = document.createElement(answers ? "object" : "img");
  large[answers ? "data" : "src"] = link.href;
  if (answers) large.type = "image/svg+xml";
  else large.alt = link.querySelector("img").alt;
  dialog.firstElementChild.replaceWith(large);
  dialog.showModal();
}

function make_dialog() {
  const dialog = document.createElement("dialog");
  dialog.className = "enlarged";
  dialog.setAttribute("aria-label", "Figure, enlarged");
  dialog.innerHTML = '<img alt=""/><button type="button" autofocus>Close</button>';
  dialog.addEventListener("click", () => dialog.close());
  document.body.append(dialog);
  return dialog;
}

const verdicts = new Set([
  "reproduced", "reproduced, inferred reading", "better", "differs", "not stated", "context", "input",
  "not built",
]);

// Cells with sentences get room, short ones stay on one line, those with a verdict get its mark and stay in sight. Headings such
// as latitude_corrected_deg may break at their underscores.
function mark_cells(table) {
  for (const heading of table.querySelectorAll("th")) {
    if (!/[\\<]/.test(heading.innerHTML)) heading.innerHTML = heading.innerHTML.replaceAll("_", "_<wbr>");
  }
  for (const cell of table.querySelectorAll("td")) {
    const text = cell.textContent.trim();
    if (text.length > 50 && !text.includes("\\(")) cell.classList.add("prose");
    if (text.length < 13) cell.classList.add("short");
    if (verdicts.has(text)) cell.dataset.verdict = text;
  }
  const [heading, ...rows] = table.rows;
  const columns = heading?.cells.length ?? 0;
  for (const [name, more_than] of [["many", 5], ["crowded", 8], ["endless", 11]]) table.classList.toggle(name, columns > more_than);
  [...(heading?.cells ?? [])].forEach((cell, column) => {
    if (!/^(verdict|effect)$/.test(cell.textContent.trim())) return;
    for (const row of [heading, ...rows]) row.cells[column]?.classList.add("kept");
  });
}

// A table in a box of its own, which the keyboard reaches when there is something to scroll.
function box(table) {
  const div = document.createElement("div");
  div.className = "scroll";
  table.before(div);
  div.append(table);
  const reach = () => {
    if (div.scrollWidth > div.clientWidth) div.tabIndex = 0;
    else div.removeAttribute("tabindex");
  };
  new ResizeObserver(reach).observe(div);
}

// A formula that is too wide for the column is set smaller, down to what can still be read; beyond that it
// scrolls.
function fit_formulas() {
  for (const formula of document.querySelectorAll(".MathJax_SVG_Display")) {
    let percent = 100;
    formula.style.fontSize = "";
    while (formula.scrollWidth > formula.clientWidth && percent > 72) {
      const fits = Math.floor((percent * formula.clientWidth) / formula.scrollWidth);
      percent = Math.max(72, Math.min(percent - 1, fits));
      formula.style.fontSize = `${percent}%`;
    }
  }
  const inline = [...document.querySelectorAll(".contents p .MathJax_SVG, .contents li .MathJax_SVG")]
    .filter((formula) => !formula.closest(".MathJax_SVG_Display"));
  inline.forEach((formula) => formula.classList.remove("long"));
  const wide = inline.map((formula) => formula.getBoundingClientRect().width > formula.closest("p, li").clientWidth);
  inline.forEach((formula, i) => formula.classList.toggle("long", wide[i]));
}

// The sidebar opens only the branch of the page shown; the chapters shall always be seen. Doxygen fills the
// tree some time after the page is ready.
function open_chapters() {
  const tree = document.getElementById("nav-tree-contents");
  if (!tree) return;
  const watch = new MutationObserver(() => {
    const is_book = (item) => item.querySelector(".label")?.textContent === "Book";
    const book = [...tree.querySelectorAll(".item")].find(is_book);
    const arrow = book?.querySelector(".arrow");
    if (!arrow) return;
    watch.disconnect();
    if (arrow.textContent === "\u25ba") arrow.parentElement.click();
  });
  watch.observe(tree, { childList: true, subtree: true });
}

// On the map a box that is pointed at shows all that it stands on, down to the ground.
function connect_map(map) {
  const words = (element) => (element?.textContent ?? "").split(", ").filter(Boolean);
  const common = words(map.querySelector(".common"));
  const boxes = new Map([...map.querySelectorAll("li")].map((box) => [box.querySelector("a").textContent, box]));
  const uses = (box) => {
    const own = words(box.querySelector(".uses"));
    return box.parentElement.classList.contains("chapter-floor") ? own.concat(common) : own;
  };
  const mark = (box) => {
    if (!box || box.classList.contains("stands-under")) return;
    box.classList.add("stands-under");
    uses(box).forEach((name) => mark(boxes.get(name)));
  };
  const clear = () => {
    map.classList.remove("pointed");
    boxes.forEach((box) => box.classList.remove("stands-under"));
  };
  const point = (box) => {
    clear();
    map.classList.add("pointed");
    mark(box);
  };
  boxes.forEach((box) => {
    box.addEventListener("mouseenter", () => point(box));
    box.addEventListener("focusin", () => point(box));
    box.addEventListener("mouseleave", clear);
    box.addEventListener("focusout", clear);
  });
}

// A link to what is folded away opens it.
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const folds = [];
  for (let e = target?.closest("details"); e; e = e.parentElement.closest("details")) folds.push(e);
  folds.forEach((fold) => { fold.open = true; });
  if (folds.length) target.scrollIntoView();
}

open_chapters();
unfold();
window.addEventListener("hashchange", unfold);
document.querySelectorAll(".map").forEach(connect_map);
if (window.MathJax?.Hub) {
  MathJax.Hub.Queue(fit_formulas);
  window.addEventListener("resize", fit_formulas);
}
document.querySelectorAll(".contents .fragment").forEach(outdent);
document.querySelectorAll(".contents table.markdownTable").forEach((table) => {
  mark_cells(table);
  box(table);
});
const figures = document.querySelectorAll("figure.plate > a, figure.plate a.curves");
if (figures.length && window.HTMLDialogElement) {
  const dialog = make_dialog();
  figures.forEach((link) => {
    link.title = link.classList.contains("curves") ? "Point at a curve; switch curves off" : "Enlarge";
    link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;  // a new tab, as asked
      event.preventDefault();
      enlarge(link, dialog);
    });
  });
}
