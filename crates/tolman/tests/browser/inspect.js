// What a reader would hold against the page as it lies in the window: a list of sentences.
// Closed folds are not looked at; whoever wants to know opens them first.
(() => {
  "use strict";
  const faults = new Map();
  const complain = (kind, what) => {
    if (!faults.has(kind)) faults.set(kind, new Set());
    faults.get(kind).add(what);
  };
  const quoted = text => "“" + text.trim().replace(/\s+/g, " ").slice(0, 60) + "”";
  const shown = element => element.checkVisibility({ visibilityProperty: true, opacityProperty: true });
  const styles = new Map();
  const style = element => {
    if (!styles.has(element)) styles.set(element, getComputedStyle(element));
    return styles.get(element);
  };

  // ---- colours: red, green, blue from 0 to 1, and how much they cover

  function colour(text) {
    const numbers = (text.match(/-?[\d.]+(e-?\d+)?%?/g) || []).map(part =>
      part.endsWith("%") ? parseFloat(part) / 100 : parseFloat(part));
    if (text.startsWith("rgb")) return [...numbers.slice(0, 3).map(part => part / 255), numbers[3] ?? 1];
    if (text.startsWith("color(srgb")) return [...numbers.slice(0, 3), numbers[3] ?? 1];
    return [0, 0, 0, 0];
  }
  const over = (above, below) => [0, 1, 2].map(i => above[i] * above[3] + below[i] * (1 - above[3])).concat(1);
  const faded = (of, share) => [of[0], of[1], of[2], of[3] * share];
  function lightness(of) {
    const linear = of.slice(0, 3).map(part => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
  }
  function contrast(a, b) {
    const [high, low] = [lightness(a), lightness(b)].sort((x, y) => y - x);
    return (high + 0.05) / (low + 0.05);
  }
  function opacity(element) {
    let share = 1;
    for (let at = element; at; at = at.parentElement) share *= Number(style(at).opacity);
    return share;
  }
  // What lies behind an element of the page.
  function ground(element) {
    const layers = [];
    for (let at = element; at; at = at.parentElement) {
      const layer = colour(style(at).backgroundColor);
      if (layer[3] > 0) layers.push(layer);
      if (layer[3] === 1) break;
    }
    const dark = style(document.documentElement).colorScheme.includes("dark");
    return layers.reduceRight((below, above) => over(above, below), dark ? [0.07, 0.07, 0.07, 1] : [1, 1, 1, 1]);
  }

  // ---- pictures

  // The corners of what ink a line of text has: less than its box, which holds the tallest letters there are.
  function corners(text) {
    const box = text.getBBox(), to = text.getScreenCTM();
    const [top, bottom] = [box.y + 0.2 * box.height, box.y + 0.88 * box.height];
    return [[box.x, top], [box.x + box.width, top], [box.x + box.width, bottom], [box.x, bottom]]
      .map(([x, y]) => [to.a * x + to.c * y + to.e, to.b * x + to.d * y + to.f]);
  }
  // By how many pixels two rectangles overlap in the direction in which they do so least.
  function overlap(one, other) {
    let least = Infinity;
    for (const [a, b] of [[one[0], one[1]], [one[1], one[2]], [other[0], other[1]], [other[1], other[2]]]) {
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
      const axis = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
      const span = points => points.map(point => point[0] * axis[0] + point[1] * axis[1]);
      const [p, q] = [span(one), span(other)];
      least = Math.min(least, Math.min(Math.max(...p), Math.max(...q)) - Math.max(Math.min(...p), Math.min(...q)));
    }
    return least;
  }

  const SLACK = 1;
  for (const svg of document.querySelectorAll("svg")) {
    if (!shown(svg)) continue;
    const name = svg.id || svg.getAttribute("class") || "svg";
    const texts = [...svg.querySelectorAll("text")].filter(text => text.textContent.trim() && shown(text));
    if (!texts.length) continue;
    const frame = svg.getBoundingClientRect();
    const placed = texts.map(text => ({ text, corners: corners(text) }));
    for (const { text, corners } of placed) {
      const out = corners.some(([x, y]) => x < frame.left - SLACK || x > frame.right + SLACK
        || y < frame.top - SLACK || y > frame.bottom + SLACK);
      if (out) complain("cut off by its picture", `${name}: ${quoted(text.textContent)}`);
    }
    for (let i = 0; i < placed.length; i++) {
      for (let j = 0; j < i; j++) {
        if (overlap(placed[i].corners, placed[j].corners) > SLACK) {
          complain("labels overlap", `${name}: ${quoted(placed[i].text.textContent)} and ${quoted(placed[j].text.textContent)}`);
        }
      }
    }
    const shapes = [...svg.querySelectorAll("rect, circle, ellipse, path, polygon")]
      .filter(shape => style(shape).fill !== "none" && shown(shape))
      .map(shape => ({ shape, box: shape.getBoundingClientRect() }));
    for (const { text, corners } of placed) {
      const middle = [0, 1].map(axis => corners.reduce((sum, corner) => sum + corner[axis], 0) / 4);
      const own = style(text);
      let behind = ground(svg);
      for (const { shape, box } of shapes) {
        if (box.left > middle[0] || box.right < middle[0] || box.top > middle[1] || box.bottom < middle[1]) continue;
        if (!(shape.compareDocumentPosition(text) & Node.DOCUMENT_POSITION_FOLLOWING)) continue;
        const at = new DOMPoint(...middle).matrixTransform(shape.getScreenCTM().inverse());
        if (!shape.isPointInFill(at)) continue;
        behind = over(faded(colour(style(shape).fill), Number(style(shape).fillOpacity) * opacity(shape)), behind);
      }
      if (own.paintOrder.startsWith("stroke") && parseFloat(own.strokeWidth) >= 2) {
        behind = over(colour(own.stroke), behind);
      }
      legible(faded(colour(own.fill), Number(own.fillOpacity) * opacity(text)), behind, `${name}: ${quoted(text.textContent)}`);
    }
  }
  function legible(ink, behind, what) {
    const ratio = contrast(over(ink, behind), behind);
    if (ratio < 4.45) complain("hard to read", `${what} at ${ratio.toFixed(1)} to 1`);
  }

  // ---- words of the page

  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  while (walker.nextNode()) {
    const node = walker.currentNode, element = node.parentElement;
    if (!node.data.trim() || element.closest("svg, script, style, :disabled") || !shown(element)) continue;
    legible(faded(colour(style(element).color), opacity(element)), ground(element), quoted(node.data));
    range.selectNodeContents(node);
    const box = range.getBoundingClientRect();
    if (!box.width) continue;
    for (let at = element; at !== document.documentElement; at = at.parentElement) {
      const { overflowX, textOverflow, position } = style(at);
      // What scrolls can be had, and an ellipsis says that there is more.
      if (overflowX === "auto" || overflowX === "scroll" || textOverflow === "ellipsis") break;
      const edge = at.getBoundingClientRect();
      if ((overflowX === "hidden" || overflowX === "clip") && edge.width > 1 && at !== document.body
        && (box.right > edge.right + SLACK || box.left < edge.left - SLACK)) {
        complain("cut off", quoted(node.data));
        break;
      }
      if (position === "fixed" || at === document.body) {
        if (box.right > document.documentElement.clientWidth + SLACK || box.left < -SLACK) complain("beyond the window", quoted(node.data));
        break;
      }
    }
  }
  const wide = Math.max(document.documentElement.scrollWidth, document.body.scrollWidth) - document.documentElement.clientWidth;
  if (wide > 0) complain("scrolls sideways", `by ${wide} px`);
  return [...faults].map(([kind, whats]) => {
    const few = [...whats].slice(0, 6).join("; ");
    return `${kind} (${whats.size}): ${few}`;
  });
})()
