// The lessons: a task, a pupil's answer to it, and the module that marks it.
"use strict";

// Opens the lesson that the address names, and follows it. `theme` returns whether the page is light or dark.
function openLessons(module, theme) {
  const part = id => document.getElementById(id);
  const svg = part("board");
  const SIDES = { west: "left", north: "ahead", east: "right", south: "back" };
  const COMPASS = { north: "north", west: "west", east: "east", south: "south" };

  // ---------------------------------------------------------------- what was passed

  const KEPT = "tolman-lessons";
  let passed = new Set();
  try {
    passed = new Set(JSON.parse(localStorage.getItem(KEPT)) || []);
  } catch {
    // Without a store the marks last as long as the page is open.
  }

  function pass(name) {
    passed.add(name);
    try {
      localStorage.setItem(KEPT, JSON.stringify([...passed]));
    } catch {
      // As above.
    }
    drawPages();
  }

  const taskName = (lesson, task) => lesson + "." + task;
  const isDone = lesson => LESSONS[lesson - 1].tasks.every((_, task) => passed.has(taskName(lesson, task + 1)));

  // ---------------------------------------------------------------- the list of pages

  // Marks the page that is open and the lessons that are done.
  function drawPages() {
    [...part("pages").children].forEach((link, number) => {
      const words = number ? "Lesson " + number : "Playground";
      link.textContent = words + (number && isDone(number) ? " ✓" : "");
      if (number) link.title = LESSONS[number - 1].title;
      if (number === (at ? at.lesson : 0)) link.setAttribute("aria-current", "page");
      else link.removeAttribute("aria-current");
    });
  }

  // ---------------------------------------------------------------- a task

  // The task that is open: its lesson and number, the answer so far, and how often it failed.
  let at = null, player = null;

  const seed = () => Math.floor(Math.random() * 2 ** 32);

  function follow() {
    const [, lesson, task] = location.hash.match(/^#lesson-(\d)(?:-(\d))?$/) || [];
    const words = LESSONS[lesson - 1]?.tasks[(task || 1) - 1];
    closeFilm();
    at = words ? { lesson: Number(lesson), task: Number(task || 1), words, failures: 0 } : null;
    part("free").hidden = Boolean(at);
    part("lesson").hidden = !at;
    drawPages();
    document.title = at ? LESSONS[at.lesson - 1].title + " – tolman" : "tolman: a playground";
    if (!at) return;
    const { title, why, tasks } = LESSONS[at.lesson - 1];
    part("lesson-title").textContent = at.lesson + ". " + title;
    part("why").textContent = why;
    part("task-number").textContent = tasks.length > 1 ? `Task ${at.task} of ${tasks.length}` : "Task";
    part("task").textContent = words.text;
    part("check").textContent = words.check;
    part("rule").hidden = !words.rule;
    part("moves").hidden = !words.moves;
    part("board").dataset.tool = words.walls ? "wall" : words.cells ? "cell" : "none";
    part("hint").hidden = true;
    part("back-move").hidden = !words.moves || Boolean(words.drives);
    part("again").textContent = words.drives ? "Put it down elsewhere" : "Start again";
    part("again").hidden = Boolean(words.rule);
    if (words.moves) drawKeys(words.moves === "robot" ? SIDES : COMPASS);
    scrollTo(0, 0);
    restart();
  }

  function restart() {
    closeFilm();
    at.answer = { rule: ["north", "north", "north", "north"], walls: [], cells: [], moves: [], seed: seed() };
    for (const select of document.querySelectorAll("#rule select")) select.value = "north";
    at.way = [];
    tell("");
    look();
  }

  // Shows the task after another answer.
  function look() {
    closeFilm();
    at.view = JSON.parse(module.task_view(at.lesson, at.task, JSON.stringify(at.answer)));
    draw();
  }

  function tell(words, tone) {
    const line = part("mark");
    line.textContent = words;
    line.hidden = !words;
    line.dataset.tone = tone || "neutral";
    part("next").hidden = part("more").hidden = tone !== "good";
  }

  // Another answer: what was said of the last one holds no more.
  function change(act) {
    act(at.answer);
    at.way = [];
    tell("");
    look();
  }

  // ---------------------------------------------------------------- the maze

  const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

  function toggle(list, thing) {
    const found = list.findIndex(one => same(one, thing));
    if (found < 0) list.push(thing);
    else list.splice(found, 1);
  }

  function chooseCell(x, y) {
    const cell = { x, y }, kind = at.words.cells;
    change(answer => {
      if (kind === "one") answer.cells = [cell];
      else if (kind === "all") toggle(answer.cells, cell);
      else {
        // Whether a way leads there only the module knows: it shows where the mouse is.
        const [, here] = at.view.robots[0];
        if (Math.abs(here.x - x) + Math.abs(here.y - y) === 1 && isOpen(here, cell)) answer.cells.push(cell);
      }
    });
  }

  function isOpen(one, other) {
    const low = one.x + one.y < other.x + other.y ? one : other;
    const side = one.x === other.x ? "north" : "east";
    const wall = at.view.plan.walls.find(({ cell, side: its }) => cell[0] === low.x && cell[1] === low.y && its === side);
    return Boolean(wall) && !wall.stands;
  }

  const TURNS = { north: 0, east: 90, south: 180, west: 270 };

  function draw() {
    const { view, answer, words } = at, unknown = new Set(view.unknown.map(([{ x, y }, side]) => [x, y, side].join(" ")));
    drawMaze(svg, view.plan, {
      unknown,
      onWall: words.walls && (wall => change(({ walls }) => toggle(walls, [{ x: wall.cell[0], y: wall.cell[1] }, wall.side]))),
      onCell: words.cells && chooseCell,
      under: (shape, up) => {
        for (const { x, y } of words.cells === "path" ? [] : answer.cells) {
          shape("rect", { class: "chosen", x: x + 0.06, y: up(y) - 0.94, width: 0.88, height: 0.88, rx: 0.1 });
        }
        const trail = words.cells === "path" && view.plan.start ? [{ x: view.plan.start[0], y: view.plan.start[1] }, ...answer.cells] : [];
        const points = way => way.map(({ x, y }) => [x + 0.5, up(y) - 0.5].join(",")).join(" ");
        if (trail.length > 1) shape("polyline", { class: "trail", points: points(trail) });
        if (at.way.length > 1) shape("polyline", { class: "way", points: points(at.way) });
        for (const { x, y } of at.way.length === 1 ? at.way : []) shape("circle", { class: "way", cx: x + 0.5, cy: up(y) - 0.5, r: 0.36 });
        for (const [letter, { x, y }, heading] of view.robots) {
          const [cx, cy] = [x + 0.5, up(y) - 0.5];
          if (heading) shape("path", { class: "nose", d: "M -0.17 -0.24 L 0 -0.43 L 0.17 -0.24 Z", transform: `translate(${cx} ${cy}) rotate(${TURNS[heading]})` });
          shape("circle", { class: "robot", cx, cy, r: 0.27 });
          if (letter) shape("text", { class: "letter", x: cx, y: cy }).textContent = letter;
        }
      },
    });
    part("facts").replaceChildren(...view.facts.flatMap(([name, value]) => {
      const [term, fact] = [document.createElement("dt"), document.createElement("dd")];
      term.textContent = name;
      fact.textContent = value;
      return [term, fact];
    }));
    part("facts").hidden = !view.facts.length;
    drawSight(view.sight);
    drawMoves();
  }

  // What the robot sees of the cell in which it is: its left, ahead and right, and not what is behind it.
  function drawSight(sight) {
    part("seen").hidden = !sight;
    if (!sight) return;
    const eye = part("eye"), shape = (name, attributes) => svgShape(name, attributes, eye);
    eye.replaceChildren();
    [[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 1, 1]].forEach(([x1, y1, x2, y2], side) => {
      shape("line", { class: sight[side] ? "gap" : "wall", x1, y1, x2, y2 });
    });
    shape("line", { class: "unknown", x1: 0, y1: 1, x2: 1, y2: 1 });
    shape("path", { class: "nose", d: "M -0.17 -0.24 L 0 -0.43 L 0.17 -0.24 Z", transform: "translate(.5 .5)" });
    shape("circle", { class: "robot", cx: 0.5, cy: 0.5, r: 0.27 });
    part("eye-words").textContent = ["left", "ahead", "right"].map((side, i) => side + (sight[i] ? " open" : " wall")).join(", ");
  }

  // ---------------------------------------------------------------- moves and rules

  function drawKeys(names) {
    part("keys").replaceChildren(...Object.entries(names).map(([side, words]) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = words;
      button.dataset.move = side;
      button.addEventListener("click", () => change(answer => {
        answer.moves.push(side);
        // The cell in which the robot was believed to be is left.
        answer.cells = [];
      }));
      return button;
    }));
  }

  function drawMoves() {
    const { words, answer: { moves }, view: { sight } } = at;
    if (!words.moves) return;
    const names = words.moves === "robot" ? SIDES : COMPASS;
    part("made").textContent = moves.length ? moves.map(side => names[side]).join(", ") : "no move yet";
    part("made").hidden = Boolean(words.drives);
    part("back-move").disabled = !moves.length;
    const blocked = sight ? { west: !sight[0], north: !sight[1], east: !sight[2] } : {};
    for (const key of document.querySelectorAll("#keys button")) {
      key.disabled = blocked[key.dataset.move] || moves.length >= (words.most || Infinity);
    }
  }

  const ORDER = ["first try", "then", "then", "at last"];
  part("rule").replaceChildren(...ORDER.map((words, line) => {
    const label = document.createElement("label"), select = document.createElement("select");
    for (const [side, name] of Object.entries(SIDES)) select.append(new Option(name, side));
    select.dataset.line = line;
    select.addEventListener("change", () => change(({ rule }) => rule[line] = select.value));
    label.append(words + " ", select);
    return label;
  }));

  // ---------------------------------------------------------------- the mark

  function closeFilm() {
    if (player) player.close();
    player = null;
    part("film").hidden = part("to-maze").hidden = true;
    svg.removeAttribute("hidden");
  }

  function showFilm(replay) {
    svg.setAttribute("hidden", "");
    part("film").hidden = part("to-maze").hidden = false;
    // A player that grows leaves the address alone, which names the lesson here.
    player = TolmanReplay.open(part("film"), replay, { growing: true });
    player.growing = false;
    player.setTheme(theme());
    // The slowest speed at which it takes no more than twelve seconds.
    const { last, stepLength } = player.run;
    player.setSpeed([0.25, 0.5, 1, 2, 5, 10, 20].find(speed => last * stepLength / speed <= 12) || 50);
    player.play();
  }

  function check() {
    closeFilm();
    // Mazes that nobody has seen are drawn anew for each try.
    if (at.words.rule) at.answer.seed = seed();
    const mark = JSON.parse(module.mark_task(at.lesson, at.task, JSON.stringify(at.answer)));
    at.way = mark.way;
    draw();
    if (mark.passed) pass(taskName(at.lesson, at.task));
    else at.failures++;
    part("hint").hidden = mark.passed || at.failures < 2;
    part("hint-words").textContent = at.words.hint;
    part("more").textContent = at.words.more;
    const isLast = at.task === LESSONS[at.lesson - 1].tasks.length;
    part("next").textContent = !isLast ? "Next task" : at.lesson < LESSONS.length ? "Next lesson" : "To the playground";
    part("next").href = !isLast ? `#lesson-${at.lesson}-${at.task + 1}` : at.lesson < LESSONS.length ? "#lesson-" + (at.lesson + 1) : "#play";
    tell(mark.told, mark.passed ? "good" : "bad");
    if (mark.replay) showFilm(mark.replay);
    part("mark").scrollIntoView({ block: "nearest" });
  }

  part("check").addEventListener("click", check);
  part("again").addEventListener("click", restart);
  part("back-move").addEventListener("click", () => change(({ moves }) => moves.pop()));
  part("to-maze").addEventListener("click", closeFilm);
  addEventListener("hashchange", follow);
  follow();
  return { get at() { return at; }, get player() { return player; } };
}
