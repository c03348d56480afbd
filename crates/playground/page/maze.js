// The drawing of a maze: cells are counted from the south-west, while y goes down on the screen.
"use strict";

function svgShape(name, attributes, parent) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  parent.append(element);
  return element;
}

// Draws a plan of the module into an <svg class="maze">. `under` draws what lies below the walls. `onWall` and `onCell`
// are called with the wall or the place that was clicked.
function drawMaze(svg, plan, { onWall, onCell, under, unknown = new Set() }) {
  const { width, height } = plan;
  const up = y => height - y;
  const shape = (name, attributes) => svgShape(name, attributes, svg);
  svg.replaceChildren();
  svg.setAttribute("viewBox", [-0.15, -0.15, width + 0.3, height + 0.3].join(" "));
  shape("rect", { class: "floor", x: 0, y: 0, width, height });
  for (const [x, y] of plan.goals) {
    shape("rect", { class: "goal", x: x + 0.12, y: up(y) - 0.88, width: 0.76, height: 0.76, rx: 0.1 });
    shape("text", { x: x + 0.5, y: up(y) - 0.5 }).textContent = "G";
  }
  if (plan.start) {
    const [x, y] = plan.start;
    shape("circle", { class: "start", cx: x + 0.5, cy: up(y) - 0.5, r: 0.26 });
  }
  if (under) under(shape, up);
  const ends = { north: [0, 1, 1, 1], south: [0, 0, 1, 0], east: [1, 0, 1, 1], west: [0, 0, 0, 1] };
  const line = ({ cell: [x, y], side }, kind) => {
    const [x1, y1, x2, y2] = ends[side];
    return { class: kind, x1: x + x1, y1: up(y + y1), x2: x + x2, y2: up(y + y2) };
  };
  const named = wall => [...wall.cell, wall.side].join(" ");
  const order = plan.walls.filter(wall => !wall.stands).concat(plan.walls.filter(wall => wall.stands));
  for (const wall of order) shape("line", line(wall, wall.stands ? "wall" : unknown.has(named(wall)) ? "unknown" : "gap"));
  for (const wall of onWall ? plan.walls.filter(wall => !wall.is_border) : []) {
    const hit = shape("line", line(wall, "hit"));
    hit.addEventListener("click", () => onWall(wall));
    hit.dataset.wall = named(wall);
  }
  for (let x = 0; onCell && x < width; x++) {
    for (let y = 0; y < height; y++) {
      const cell = shape("rect", { class: "cell", x, y: up(y) - 1, width: 1, height: 1 });
      cell.addEventListener("click", () => onCell(x, y));
      cell.dataset.cell = x + " " + y;
    }
  }
}
