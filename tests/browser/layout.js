/* What is wrong with the layout of a page: text that is cut or lies over other text. A list of sentences. */
(() => {
  const wrong = [];
  const seen = element => {
    for (let up = element; up instanceof Element; up = up.parentElement) {
      const style = getComputedStyle(up);
      if (style.display === "none" || style.visibility === "hidden" || style.opacity === "0") return false;
      if (up.tagName === "DETAILS" && !up.open && !element.closest("summary")) return false;
    }
    return true;
  };
  const scrolls = element => {  // within something that a reader can move sideways
    for (let up = element.parentElement; up; up = up.parentElement)
      if (["auto", "scroll"].includes(getComputedStyle(up).overflowX)) return true;
    return false;
  };
  /* What of a box can be seen of what it stands in, which may be moved sideways. */
  const shown = (box, element) => {
    let {left, right} = box;
    for (let up = element; up; up = up.parentElement)
      if (["auto", "scroll"].includes(getComputedStyle(up).overflowX)) {
        const edge = up.getBoundingClientRect();
        left = Math.max(left, edge.left);
        right = Math.min(right, edge.right);
      }
    return new DOMRect(left, box.top, Math.max(right - left, 0), box.height);
  };
  const words = node => node.textContent.trim().replace(/\s+/g, " ").slice(0, 50);
  const boxes = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const width = document.documentElement.clientWidth;
  while (walk.nextNode()) {
    const node = walk.currentNode, parent = node.parentElement;
    if (!node.textContent.trim() || ["SCRIPT", "STYLE", "OPTION", "TITLE"].includes(parent.tagName) || !seen(parent)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const whole of range.getClientRects()) {
      const box = shown(whole, parent);
      if (box.width < 1 || box.height < 1) continue;
      boxes.push({box, node});
      if (!scrolls(parent) && (box.right > width + 1 || box.left < -1)) wrong.push(`cut at the edge: "${words(node)}" (${Math.round(box.right)} of ${width})`);
      const drawing = parent.closest("svg");
      if (drawing) {
        const edge = drawing.getBoundingClientRect();
        if (getComputedStyle(drawing).overflow !== "visible" && (box.right > edge.right + 2 || box.left < edge.left - 2 || box.bottom > edge.bottom + 2 || box.top < edge.top - 2))
          wrong.push(`cut in a drawing: "${words(node)}"`);
      }
    }
  }
  // Lines of letters are higher than the letters; a third of the height is air.
  const tight = ({left, right, top, bottom, height}) => ({left: left + 1, right: right - 1, top: top + height / 5, bottom: bottom - height / 5});
  boxes.sort((a, b) => a.box.top - b.box.top);
  for (let i = 0; i < boxes.length; ++i) {
    const a = tight(boxes[i].box);
    for (let j = i + 1; j < boxes.length && boxes[j].box.top < boxes[i].box.bottom; ++j) {
      if (boxes[i].node === boxes[j].node) continue;
      const b = tight(boxes[j].box);
      if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom)
        wrong.push(`one over the other: "${words(boxes[i].node)}" and "${words(boxes[j].node)}"`);
    }
  }
  // What answers is seen without moving it sideways.
  for (const table of document.querySelectorAll("table.outcome,table.influence,table.figures"))
    if (seen(table) && Math.max(table.getBoundingClientRect().width, table.scrollWidth) > table.parentElement.clientWidth + 1) wrong.push(`wider than its place: table "${words(table)}"`);
  for (const place of document.querySelectorAll(".drawing-place"))
    if (seen(place) && !place.querySelector("svg path")) wrong.push(`nothing drawn: "${place.getAttribute("aria-label")}"`);
  return wrong;
})()
