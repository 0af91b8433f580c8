// Errors of a page with figures and tables, at the width of the window: length of a chapter, hidden parts of tables,
// alternative texts of pictures.
(() => {
  const all = (selector) => [...document.querySelectorAll(selector)];
  const findings = [];
  const wide = innerWidth >= 1000;

  const most_screens = 40, screen = 900;
  const height = document.querySelector(".contents")?.scrollHeight ?? 0;
  if (wide && /^chapter_/.test(location.pathname.split("/").at(-1)) && height > most_screens * screen)
    findings.push(["length", `${Math.ceil(height / screen)} screens of ${screen} px`]);

  // A table scrolls in a box of its own where it must; what it says of a row, a verdict or an effect, is seen without.
  const folds = all("details:not([open])");
  folds.forEach((fold) => { fold.open = true; });
  for (const box of all(".scroll")) {
    const headings = [...box.querySelectorAll("th")], edges = box.getBoundingClientRect();
    const name = headings.map((heading) => heading.textContent.trim()).join(" | ").slice(0, 80);
    const width = Math.max(...[box, ...box.querySelectorAll("table, tbody")].map((e) => e.scrollWidth)); // each can scroll
    if (wide && width > box.clientWidth + 1) findings.push(["table", `${width} px in ${box.clientWidth}: ${name}`]);
    for (const heading of headings.filter((h) => /^(verdict|effect)$/.test(h.textContent.trim()))) {
      const place = heading.getBoundingClientRect();
      if (place.right > edges.right + 1 || place.left < edges.left - 1)
        findings.push(["table", `${heading.textContent.trim()} is out of sight at ${innerWidth} px: ${name}`]);
    }
  }
  folds.forEach((fold) => { fold.open = false; });

  const least_words = 8;
  for (const image of wide ? all("figure img") : []) {
    const words = image.alt.trim(), caption = image.closest("figure").querySelector("figcaption")?.textContent.trim();
    if (words.split(/\s+/).length < least_words || words === caption || words === document.title)
      findings.push(["alternative", `${image.getAttribute("src")}: "${words}"`]);
  }
  return findings;
})()
