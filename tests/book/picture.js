// Words of a picture that its frame cuts off. Run in an SVG that is opened by itself.
(() => {
  const svg = document.documentElement, box = svg.viewBox.baseVal, findings = [];
  const frame = box?.width ? box : { x: 0, y: 0, width: svg.width.baseVal.value, height: svg.height.baseVal.value };
  const back = svg.getScreenCTM().inverse();
  for (const text of document.querySelectorAll("text")) {
    const place = text.getBoundingClientRect();
    if (!text.textContent.trim() || place.width === 0) continue;
    const low = new DOMPoint(place.left, place.top).matrixTransform(back);
    const high = new DOMPoint(place.right, place.bottom).matrixTransform(back);
    const beyond = Math.max(frame.x - low.x, frame.y - low.y, high.x - frame.x - frame.width, high.y - frame.y - frame.height);
    if (beyond > 1) findings.push(["picture", `${text.textContent.trim().slice(0, 60)}: ${Math.ceil(beyond)} px beyond the frame`]);
  }
  return findings;
})()
