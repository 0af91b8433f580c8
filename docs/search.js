// The search of the book: the text of its pages, then names of the library. The index is a script, read at the first use, for
// pages that are opened from the file system may not fetch. Written by scripts/book/search.py: window.book_index.
"use strict";

const most_sections = 12, most_of_a_page = 3, most_names = 8;
const index_file = new URL("search_index.js", document.currentScript.src);

let index = null;
function read_index() {
  index ??= new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = index_file;
    script.onload = () => resolve(window.book_index);
    script.onerror = () => reject(new Error("the index of the search cannot be read"));
    document.head.append(script);
  });
  return index;
}

// Where words begin with this text, whatever the case.
function beginning(text) {
  return new RegExp(`(?<![\\p{L}\\p{N}])${text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&").replace(/\s+/g, "\\s+")}`, "giu");
}

const times = (pattern, text) => [...text.matchAll(pattern)].length;

// Lists of evidence hold every word of the chapters: they come after the pages that explain.
const lists = /^(reproduction|completeness|claims|errata|bench|ratios|randomised)\.html/;

// Sections in which every word begins another one, best first: what stands in a title counts most, then the words in their order;
// rows of a table repeat a word without saying more of it.
function find_sections(sections, query) {
  const whole = beginning(query), words = query.split(/\s+/).map(beginning);
  const found = [];
  for (const [href, page, title, text, rows] of sections) {
    const titles = `${title}\n${page}`, all = `${titles}\n${text}\n${rows}`;
    if (!words.every((word) => times(word, all) > 0)) continue;
    const score = 30 * (times(whole, title) > 0) + 20 * (times(whole, page) > 0) + 3 * words.filter((word) => times(word, titles)).length +
      6 * Math.min(times(whole, text), 3) + Math.log(1 + times(words[0], text));
    const seen = [whole, words[0]].map((pattern) => [text, rows].map((part) => [pattern, part])).flat()
      .find(([pattern, part]) => times(pattern, part) > 0) ?? [words[0], text];
    found.push({ href, page, title, text: seen[1], score: lists.test(href) ? score / 4 : score, pattern: seen[0] });
  }
  found.sort((a, b) => b.score - a.score);
  const of_page = new Map();
  return found.filter(({ page }) => {
    of_page.set(page, (of_page.get(page) ?? 0) + 1);
    return of_page.get(page) <= most_of_a_page;
  }).slice(0, most_sections);
}

// Names that hold all words; those that begin with the first come first, short ones before long ones.
function find_names(names, query) {
  const words = query.toLowerCase().split(/\s+/);
  const begins = ([name]) => name.toLowerCase().startsWith(words[0]);
  return names.filter(([name, , scope]) => words.every((word) => `${scope} ${name}`.toLowerCase().includes(word)) &&
                                           name.toLowerCase().includes(words.at(-1)))
    .sort((a, b) => begins(b) - begins(a) || a[0].length - b[0].length).slice(0, most_names);
}

function element(kind, text, ...inside) {
  const made = document.createElement(kind);
  made.append(text, ...inside);
  return made;
}

// The words around the first place, which is marked.
function excerpt(text, pattern) {
  const [place] = text.matchAll(pattern);
  if (!place) return element("p", text.slice(0, 140));
  const from = text.lastIndexOf(" ", Math.max(place.index - 60, 0)) + 1, to = place.index + place[0].length;
  return element("p", (from > 0 ? "\u2026 " : "") + text.slice(from, place.index), element("mark", place[0]), text.slice(to, to + 90));
}

function link(href, ...inside) {
  const made = element("a", "", ...inside);
  made.href = href;
  return element("li", made);
}

function show(list, sections, names) {
  list.replaceChildren(
    ...sections.map((s) => link(s.href, element("strong", s.title || s.page), s.title ? element("span", s.page) : "", excerpt(s.text, s.pattern))),
    ...names.map(([name, href, scope]) => link(href, element("code", scope ? `${scope}::${name}` : name))));
  if (!list.children.length) list.append(element("li", "Nothing was found."));
}

function connect(box) {
  const field = box.querySelector("input"), list = box.querySelector("ol");
  const hide = () => { list.hidden = true; };
  const search = async () => {
    const query = field.value.trim();
    if (query.length < 2) return hide();
    const { sections, names } = await read_index();
    if (query !== field.value.trim()) return;  // typed on meanwhile
    show(list, find_sections(sections, query), find_names(names, query));
    list.style.top = `${field.getBoundingClientRect().bottom + 6}px`;
    list.hidden = false;
  };
  field.addEventListener("focus", search);
  field.addEventListener("input", search);
  document.addEventListener("pointerdown", (event) => { if (!box.contains(event.target)) hide(); });
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape") hide();
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step || list.hidden) return;
    event.preventDefault();
    const stops = [field, ...list.querySelectorAll("a")];
    stops[(stops.indexOf(document.activeElement) + step + stops.length) % stops.length].focus();
  });
}

connect(document.getElementById("book-search"));
