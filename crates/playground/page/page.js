// The playground: a maze that is drawn, a robot that learns it, and the player of replays that shows how.
//
// The maze, the robot and all that it knows are in the module that Rust was compiled to (PlaygroundPage); here are only
// the drawing under the pointer, the buttons, and the clock that lets the robot run a little ahead of the player.
"use strict";
(async () => {
  const part = id => document.getElementById(id);
  const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

  // ---------------------------------------------------------------- the module

  const zipped = new Blob([Uint8Array.from(atob(part("module").textContent), letter => letter.charCodeAt(0))]);
  const bytes = zipped.stream().pipeThrough(new DecompressionStream("gzip"));
  await wasm_bindgen({ module_or_path: new Response(bytes, { headers: { "Content-Type": "application/wasm" } }) });
  const page = new wasm_bindgen.PlaygroundPage(MAZE);

  // ---------------------------------------------------------------- words

  function tell(told, tone) {
    const line = part("told");
    if (line.textContent !== told) line.textContent = told;
    line.dataset.tone = tone || "neutral";
  }

  // Does what may be refused, and says why.
  function attempt(act) {
    try {
      return act();
    } catch (refusal) {
      tell(typeof refusal === "string" ? "This does not go: " + refusal + "." : "The program failed: " + refusal, "bad");
      if (typeof refusal !== "string") throw refusal;
      return undefined;
    }
  }

  // ---------------------------------------------------------------- the drawing

  const svg = part("sketch");

  function draw() {
    const plan = JSON.parse(page.plan());
    drawMaze(svg, plan, {
      onWall: wall => change(() => page.set_wall(...wall.cell, wall.side, !wall.stands)),
      onCell: (x, y) => change(() => tool() === "start" ? page.set_start(x, y) : page.set_goal(x, y)),
    });
    svg.dataset.tool = tool();
    part("text").value = page.text();
    part("start").disabled = plan.fault !== null;
    if (plan.fault) tell("No robot can be sent into this maze: " + plan.fault + ".", "bad");
    else tell("Click on edges to build or remove walls, then press Start.");
  }

  const tool = () => document.querySelector("[name=tool]:checked").value;

  function change(act) {
    if (attempt(() => (act(), true))) draw();
  }

  function redraw() {
    const family = part("family").value, size = Number(part("size").value), number = Number(part("number").value);
    change(() => {
      if (family === "demo") page.read(MAZE);
      else if (family === "empty") page.clear(size);
      else page.draw(family, Math.max(5, Math.min(16, size)), number);
    });
    part("size").disabled = family === "demo";
    part("number").disabled = family === "demo" || family === "empty";
  }

  function option(select, value, words) {
    const element = document.createElement("option");
    element.value = value;
    element.textContent = words;
    select.append(element);
  }

  option(part("family"), "demo", "the demo's");
  option(part("family"), "empty", "empty");
  for (const [name] of JSON.parse(wasm_bindgen.PlaygroundPage.families())) option(part("family"), name, name);
  for (const id of ["family", "size", "number"]) part(id).addEventListener("change", redraw);
  for (const radio of document.querySelectorAll("[name=tool]")) radio.addEventListener("change", () => svg.dataset.tool = tool());
  part("read").addEventListener("click", () => change(() => page.read(part("text").value)));

  // ---------------------------------------------------------------- the robot

  const systems = JSON.parse(wasm_bindgen.PlaygroundPage.systems());
  for (const is_paper of [false, true]) {
    const group = document.createElement("optgroup");
    group.label = is_paper ? "as the paper has it" : "better";
    for (const system of systems.filter(system => system.is_paper === is_paper)) option(group, system.name, system.name);
    part("system").append(group);
  }
  function describe() {
    part("about").textContent = systems.find(system => system.name === part("system").value).about + ".";
  }
  part("system").addEventListener("change", describe);
  describe();

  // What is shown of the session: its player, what it said after which step, and the step its task began at.
  let run = null;

  function begin() {
    const state = attempt(() => JSON.parse(page.begin(part("system").value, Number(part("seed").value))));
    if (!state) return;
    svg.setAttribute("hidden", "");
    part("player").hidden = part("driving").hidden = part("redraw").hidden = false;
    part("drawing").hidden = true;
    part("start").textContent = "Start again";
    const player = TolmanReplay.open(part("player"), page.replay(), { growing: true });
    run = { player, state, said: [], extended: 0, isShort: false };
    note(state);
    player.setTheme(document.documentElement.dataset.theme);
    new MutationObserver(() => setTheme(player.root.dataset.theme)).observe(player.root, { attributeFilter: ["data-theme"] });
    player.canvas.addEventListener("pointerdown", putDown, { capture: true });
    // An e-puck makes a thousand time steps in a cell, a Pioneer six.
    player.setSpeed(state.step_s < 0.05 ? 50 : 5);
    player.play();
    // On a phone the floor lies below the buttons.
    if (innerWidth < 768) part("driving").scrollIntoView();
    follow();
  }

  function end() {
    if (run) run.player.close();
    run = null;
    part("player").hidden = part("driving").hidden = part("redraw").hidden = true;
    part("drawing").hidden = false;
    part("start").textContent = "Start";
    svg.removeAttribute("hidden");
    lifting(false);
    draw();
  }

  function note(state) {
    run.state = state;
    run.said.push({ step: state.steps, told: state.told, tone: state.tone });
  }

  // Most milliseconds that the robot may think in one frame, more if the player waits for it, and least between two
  // pictures of its map.
  const THINK_MS = 20, WAITED_FOR_MS = 60, PICTURE_MS = 300;

  // Lets the robot run ahead of what is shown by a second of the player's time.
  function think() {
    const { player } = run, begun = performance.now();
    const ahead = Math.max(3, player.speed / run.state.step_s);
    const until = player.step + ahead, starved = player.step >= player.run.last;
    while (run.state.is_busy && run.state.steps < until && performance.now() - begun < (starved ? WAITED_FOR_MS : THINK_MS)) {
      note(JSON.parse(page.advance(1)));
      run.isShort = true;
    }
    if (run.isShort && (begun - run.extended > PICTURE_MS || starved && begun - run.extended > 60)) extend();
  }

  function extend() {
    const { player } = run;
    player.growing = run.state.is_busy;
    player.extend(page.replay());
    run.extended = performance.now();
    run.isShort = false;
  }

  // Once a frame: more of the run, and words for what is shown.
  function follow() {
    const mine = run;
    if (!mine) return;
    const { player } = mine;
    if ((mine.state.is_busy || mine.isShort) && player.playing) attempt(think);
    const isOver = !mine.state.is_busy && player.step >= player.run.last && !mine.isShort;
    const said = isOver ? mine.said.at(-1) : mine.said.findLast(said => said.step <= player.step && said.tone === "neutral") || mine.said[0];
    if (part("player").hasAttribute("data-lifting")) tell("Click where the robot is to be put.");
    else tell(said.told, said.tone);
    part("player").dataset.over = isOver;
    part("pause").textContent = player.playing ? "Pause" : "Go on";
    part("pause").disabled = isOver;
    part("step").disabled = isOver;
    part("home").disabled = mine.state.is_busy || !isOver;
    const speed = SPEEDS.indexOf(player.speed);
    part("speed").value = speed;
    part("factor").textContent = player.speed + "×";
    requestAnimationFrame(follow);
  }

  // From where the robot is: whatever is shown of its past is skipped.
  function goOn(act) {
    const state = attempt(() => JSON.parse(act()));
    if (!state) return;
    const { player } = run, from = run.state.steps;
    note(state);
    if (state.is_busy) note(JSON.parse(page.advance(1)));
    extend();
    player.seek(from);
    if (state.is_busy) player.play();
  }

  function lifting(is) {
    part("lift").setAttribute("aria-pressed", is);
    part("player").toggleAttribute("data-lifting", is);
  }

  function putDown(event) {
    if (part("lift").getAttribute("aria-pressed") !== "true") return;
    event.stopImmediatePropagation();
    event.preventDefault();
    lifting(false);
    const [x, y] = run.player.worldAt(event);
    goOn(() => page.put_down(x, y));
  }

  function putAnywhere() {
    const [west, south, east, north] = run.player.run.box;
    goOn(() => page.put_down(west + Math.random() * (east - west), south + Math.random() * (north - south)));
  }

  function stepOn() {
    const { player } = run;
    player.pause();
    if (player.step >= player.run.last && run.state.is_busy) {
      note(JSON.parse(page.advance(1)));
      extend();
    }
    player.seek(player.step + 1);
  }

  part("start").addEventListener("click", begin);
  part("redraw").addEventListener("click", end);
  part("pause").addEventListener("click", () => run.player.toggle());
  part("step").addEventListener("click", () => attempt(stepOn));
  part("home").addEventListener("click", () => goOn(() => page.go_home()));
  part("lift").addEventListener("click", () => lifting(part("lift").getAttribute("aria-pressed") !== "true"));
  part("chance").addEventListener("click", putAnywhere);
  part("speed").addEventListener("input", () => run.player.setSpeed(SPEEDS[part("speed").value]));

  // ---------------------------------------------------------------- light and dark

  function setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    const player = run ? run.player : lessons?.player;
    if (player && player.root.dataset.theme !== theme) player.setTheme(theme);
  }
  let lessons = null;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
  part("theme").addEventListener("click", () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"));
  setTheme(dark.matches ? "dark" : "light");

  redraw();
  lessons = openLessons(wasm_bindgen, () => document.documentElement.dataset.theme);
  // For tests, and for the curious.
  window.tolmanPlayground = { page, lessons, get run() { return run; } };
})();
