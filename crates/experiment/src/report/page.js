// The page of results: sorts tables, tells what a dot is, opens replays, turns the light on and off.
//
// Every dot is one run. A plot is one stop of the tab key; the arrow keys go from dot to dot, Enter opens.
(() => {
  "use strict";
  const data = JSON.parse(document.getElementById("report-data").textContent);
  const byId = id => document.getElementById(id);
  const root = document.documentElement;

  // ---- light and dark

  const schemeOfReader = matchMedia("(prefers-color-scheme: dark)");
  const theme = () => root.dataset.theme || (schemeOfReader.matches ? "dark" : "light");
  const themeButton = byId("theme");
  const tellTheme = () => themeButton.setAttribute("aria-pressed", theme() === "dark");
  themeButton.addEventListener("click", () => {
    root.dataset.theme = theme() === "dark" ? "light" : "dark";
    tellTheme();
  });
  schemeOfReader.addEventListener("change", tellTheme);
  tellTheme();

  // ---- sorting

  // Rows stay with their metric. The third click gives back the order of the table.
  const NEXT = { none: "ascending", ascending: "descending", descending: "none" };

  function valueOf(row, column) {
    const cell = row.querySelector(`[data-column="${column}"]`);
    return cell ? cell.dataset.value : undefined;
  }

  function compare(a, b) {
    if (a === undefined || b === undefined) return (a === undefined) - (b === undefined);
    const numbers = Number(a) - Number(b);
    return Number.isNaN(numbers) ? a.localeCompare(b) : numbers;
  }

  function sort(header, order) {
    const table = header.closest("table"), column = header.dataset.sort;
    for (const other of table.querySelectorAll("th[data-sort]")) {
      other.setAttribute("aria-sort", other === header ? order : "none");
    }
    for (const body of table.tBodies) {
      const rows = [...body.querySelectorAll("tr[data-place]")];
      const place = row => Number(row.dataset.place);
      rows.sort((a, b) => {
        if (order === "none") return place(a) - place(b);
        const [x, y] = [valueOf(a, column), valueOf(b, column)];
        // What has no value stays last whichever way the others go.
        const missing = (x === undefined) - (y === undefined);
        const by = missing || (order === "ascending" ? compare(x, y) : compare(y, x));
        return by || place(a) - place(b);
      });
      body.append(...rows);
    }
  }

  for (const header of document.querySelectorAll("th[data-sort]")) {
    header.querySelector("button").addEventListener("click", () => sort(header, NEXT[header.getAttribute("aria-sort")]));
  }

  // ---- dots

  const replays = new Map();
  const key = (table, row, run) => JSON.stringify([table, row, Number(run)]);
  for (const script of document.querySelectorAll("script[data-replay]")) {
    replays.set(key(script.dataset.table, script.dataset.row, script.dataset.run), script);
  }

  const groupOf = dot => dot.closest("[data-table]");
  const plotOf = dot => dot.closest("svg.drawing");
  function about(dot) {
    const { table, row } = groupOf(dot).dataset, { run, seed, value } = dot.dataset;
    return { table, row, run: Number(run), seed, value };
  }
  const opensAtOnce = dot => {
    const { table, row, run } = about(dot);
    return replays.has(key(table, row, run));
  };
  const recorded = dot => data.tables[groupOf(dot).dataset.table]?.recorded;

  const tip = byId("tip");
  function showTip(dot) {
    const { row, run, seed, value } = about(dot);
    const act = !recorded(dot) ? "" : opensAtOnce(dot) ? " · click to replay" : " · click for the command that replays it";
    tip.textContent = `${row}, run ${run}: ${value} · seed ${seed}${act}`;
    tip.hidden = false;
    const at = dot.getBoundingClientRect(), box = tip.getBoundingClientRect();
    const left = Math.max(8, Math.min(innerWidth - box.width - 8, at.left + at.width / 2 - box.width / 2));
    const above = at.top - box.height - 8;
    tip.style.left = left + "px";
    tip.style.top = (above > 4 ? above : at.bottom + 8) + "px";
  }
  const hideTip = () => { tip.hidden = true; };

  // Fingers are wider than dots.
  const REACH = 14;
  function nearest(dots, x, y) {
    let best = null, least = REACH * REACH;
    for (const dot of dots) {
      const box = dot.getBoundingClientRect();
      const dx = box.left + box.width / 2 - x, dy = box.top + box.height / 2 - y;
      const distance = dx * dx + dy * dy;
      if (distance < least) [best, least] = [dot, distance];
    }
    return best;
  }

  // The dot the tab key leads to, one in each plot.
  function makeCurrent(plot, dot) {
    const before = plot.querySelector("[data-run][tabindex]");
    if (before && before !== dot) before.removeAttribute("tabindex");
    const { row, run, value } = about(dot);
    dot.setAttribute("tabindex", "0");
    dot.setAttribute("role", recorded(dot) ? "button" : "img");
    dot.setAttribute("aria-label", `${row}, run ${run}: ${value}`);
  }

  function focusDot(plot, dot) {
    if (!dot) return;
    makeCurrent(plot, dot);
    dot.focus();
  }

  const number = dot => Number(dot.dataset.value);

  // Up and down: the next value of the row. Left and right: the like value of the next row.
  function neighbour(plot, dot, key) {
    const groups = [...plot.querySelectorAll("[data-table]")].filter(group => group.querySelector("[data-run]"));
    const sorted = group => [...group.querySelectorAll("[data-run]")].sort((a, b) => number(a) - number(b) || a.dataset.run - b.dataset.run);
    const group = groups.indexOf(groupOf(dot)), dots = sorted(groups[group]), at = dots.indexOf(dot);
    const like = other => other && sorted(other).reduce((best, next) =>
      Math.abs(number(next) - number(dot)) < Math.abs(number(best) - number(dot)) ? next : best);
    switch (key) {
      case "ArrowUp": return dots[at + 1];
      case "ArrowDown": return dots[at - 1];
      case "ArrowLeft": return like(groups[group - 1]);
      case "ArrowRight": return like(groups[group + 1]);
      case "Home": return dots[0];
      case "End": return dots[dots.length - 1];
      default: return undefined;
    }
  }

  const KEYS = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Home", "End"];

  for (const plot of document.querySelectorAll("svg.drawing")) {
    const dots = plot.querySelectorAll("[data-run]");
    if (dots.length === 0) continue;
    plot.setAttribute("role", "group");
    const someOpen = [...dots].some(opensAtOnce);
    if (someOpen && ![...dots].every(opensAtOnce)) {
      for (const dot of dots) if (opensAtOnce(dot)) dot.classList.add("open");
    }
    makeCurrent(plot, dots[0]);
    plot.addEventListener("pointermove", event => {
      const dot = nearest(dots, event.clientX, event.clientY);
      plot.style.cursor = dot && recorded(dot) ? "pointer" : "";
      if (dot) showTip(dot); else hideTip();
    });
    plot.addEventListener("pointerleave", hideTip);
    plot.addEventListener("click", event => {
      const dot = event.detail === 0 ? event.target.closest("[data-run]") : nearest(dots, event.clientX, event.clientY);
      if (dot) { focusDot(plot, dot); open(dot); }
    });
    plot.addEventListener("focusin", event => {
      // Browsers may give the plot itself the focus.
      if (event.target.matches("[data-run]")) showTip(event.target);
    });
    plot.addEventListener("focusout", hideTip);
    plot.addEventListener("keydown", event => {
      const dot = event.target.closest("[data-run]");
      if (!dot || event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === "Enter" || event.key === " ") {
        event.preventDefault();
        open(dot);
      } else if (KEYS.includes(event.key)) {
        event.preventDefault();
        focusDot(plot, neighbour(plot, dot, event.key));
      } else if (event.key === "Escape") {
        hideTip();
      }
    });
  }
  addEventListener("scroll", hideTip, { passive: true });

  // ---- replays

  const dialog = byId("replay-dialog"), stage = byId("replay-stage"), absent = byId("replay-absent");
  const title = byId("replay-title"), command = byId("replay-command"), link = byId("replay-link");
  let player = null, opener = null, shown = null;

  // The address names the run that is open: #table=…&row=…&run=…, and the player adds t=….
  function writeAddress(run) {
    const parameters = new URLSearchParams(location.hash.slice(1));
    const sameRun = run && parameters.get("table") === run.table && parameters.get("row") === run.row && parameters.get("run") === String(run.run);
    for (const name of ["table", "row", "run"]) run ? parameters.set(name, run[name]) : parameters.delete(name);
    if (!sameRun) parameters.delete("t");
    const hash = parameters.toString();
    try {
      history.replaceState(history.state, "", hash ? "#" + hash : location.pathname + location.search);
    } catch {
      // A page that may not change its address does without.
    }
  }

  function open(dot) {
    if (!recorded(dot)) return;
    opener = dot;
    show(about(dot));
  }

  function show(run) {
    const table = data.tables[run.table];
    const row = table?.rows[run.row];
    if (!row || !(run.run >= 0 && run.run < data.runs)) return;
    shown = run;
    closePlayer();
    hideTip();
    writeAddress(run);
    title.textContent = `${run.row} in table ${run.table}, run ${run.run}`;
    dialog.dataset.run = run.run;
    const script = replays.get(key(run.table, run.row, run.run));
    stage.hidden = !script;
    absent.hidden = !!script;
    byId("replay-before").disabled = run.run === 0;
    byId("replay-after").disabled = run.run + 1 >= data.runs;
    if (!dialog.open) dialog.showModal();
    if (script) {
      player = TolmanReplay.open(stage, JSON.parse(script.textContent));
      if (root.dataset.theme) player.setTheme(root.dataset.theme);
      // The space bar plays, and does not press a button of the bar.
      stage.firstElementChild.focus();
    } else {
      const file = `replays/${table.number}-${row.number}-${run.run}.html`;
      command.textContent = `${data.command} --replay ${table.shell} ${row.shell} ${run.run}`;
      link.textContent = link.href = file;
      byId("replay-copy").focus();
    }
  }

  function closePlayer() {
    if (player) player.close();
    player = null;
    stage.replaceChildren();
  }

  function closed() {
    closePlayer();
    writeAddress(null);
    if (opener) opener.focus();
    opener = shown = null;
  }

  function step(by) {
    if (!shown) return;
    const next = { table: shown.table, row: shown.row, run: shown.run + by };
    const all = [...document.querySelectorAll(`[data-run="${next.run}"]`)];
    opener = all.find(dot => dot.closest("svg.drawing") && groupOf(dot).dataset.table === next.table
      && groupOf(dot).dataset.row === next.row && (!opener || plotOf(dot) === plotOf(opener))) || opener;
    if (opener && plotOf(opener)) makeCurrent(plotOf(opener), opener);
    show(next);
  }

  dialog.addEventListener("close", closed);
  // A click beside the dialog closes it.
  dialog.addEventListener("click", event => { if (event.target === dialog) dialog.close(); });
  byId("replay-close").addEventListener("click", () => dialog.close());
  byId("replay-before").addEventListener("click", () => step(-1));
  byId("replay-after").addEventListener("click", () => step(1));
  byId("replay-copy").addEventListener("click", async event => {
    const button = event.currentTarget;
    try {
      await navigator.clipboard.writeText(command.textContent);
      button.textContent = "copied";
    } catch {
      getSelection().selectAllChildren(command);
      button.textContent = "selected";
    }
    setTimeout(() => { button.textContent = "copy"; }, 1500);
  });

  function showAddress() {
    const parameters = new URLSearchParams(location.hash.slice(1));
    const [table, row, run] = ["table", "row", "run"].map(name => parameters.get(name));
    if (!table || !data.tables[table]?.recorded) return;
    if (shown && shown.table === table && shown.row === row && String(shown.run) === run) return;
    show({ table, row, run: Number(run) });
  }
  addEventListener("hashchange", showAddress);
  showAddress();
})();
