// The player of replays: TolmanReplay.open(element, data) shows what `tolman::replay::json` wrote.
//
// Plain JavaScript and a canvas, nothing else. In the order data flows: numbers come out of base64 (decode),
// the run is asked what holds at a step (model), a view says where metres lie on the screen, layers are drawn
// from the floor up, and the controls and the panel stand around them. Lines of comment and indentation are
// left out of the pages, so no text runs over several lines.
"use strict";
var TolmanReplay = (() => {

  // ---------------------------------------------------------------- decode

  function bytes(text) {
    const binary = atob(text);
    const array = new Uint8Array(binary.length);
    for (let i = 0; i < array.length; i++) array[i] = binary.charCodeAt(i);
    return array;
  }

  function view(text) {
    return new DataView(bytes(text).buffer);
  }

  function floats(text) {
    const from = view(text);
    return Float32Array.from({ length: from.byteLength / 4 }, (_, i) => from.getFloat32(4 * i, true));
  }

  // Seven bits a byte, lowest first; the last byte of a number has its top bit clear.
  function numbers(text) {
    const all = [];
    let number = 0, unit = 1;
    for (const byte of bytes(text)) {
      number += (byte & 127) * unit;
      unit *= 128;
      if (byte < 128) {
        all.push(number);
        number = 0;
        unit = 1;
      }
    }
    return all;
  }

  // Ascending steps, each written as what it adds to the one before.
  function steps(text) {
    const all = numbers(text);
    for (let i = 1; i < all.length; i++) all[i] += all[i - 1];
    return all;
  }

  // Whole numbers, each written as what it adds to the one before, with the sign in the lowest bit.
  function changes(text) {
    let value = 0;
    return numbers(text).map(number => value += number % 2 ? -(number + 1) / 2 : number / 2);
  }

  function decodePoses(track, box) {
    const [west, south, east, north] = box;
    const along = (text, from, to) => Float32Array.from(changes(text), share => from + (to - from) * share / 65535);
    const heading = Float32Array.from(changes(track.heading), turn => ((turn % 65536 + 65536) % 65536) / 65536 * 2 * Math.PI - Math.PI);
    return { x: along(track.x, west, east), y: along(track.y, south, north), heading, last: heading.length - 1 };
  }

  // Steps are left out where there is a value at each from the first on.
  function decodeSeries(series) {
    const values = series.whole !== undefined ? changes(series.whole) : floats(series.values);
    const at = typeof series.steps === "number" ? Array.from(values, (_, i) => series.steps + i) : steps(series.steps);
    return { name: series.name, unit: series.unit, steps: at, values };
  }

  function decodeScans(scans) {
    const from = view(scans.ranges);
    const share = i => from.getUint16(2 * i, true) / 65535;
    return { ring: scans.ring, steps: steps(scans.steps), range: (scan, beam) => share(scan * scans.ring.beams + beam) * scans.ring.reach };
  }

  function decodeMap(map) {
    const byId = new Map();
    for (const node of map.nodes) {
      node.visits = node.visits ? steps(node.visits) : [];
      node.labels = node.labels || (node.label ? [[node.born, node.label]] : []);
      byId.set(node.id, node);
    }
    const edges = map.edges.map(([a, b, kind, born, died, label, way]) => ({ a: byId.get(a), b: byId.get(b), kind, born, died, label, way: way || [] }));
    const changed = [...map.nodes, ...edges].flatMap(thing => [thing.born, thing.died ?? 0, ...[...thing.moves || [], ...thing.labels || []].map(change => change[0])]);
    return { name: map.name, nodes: map.nodes, edges, byId, changed: changed.sort((a, b) => a - b) };
  }

  function decodeField(field) {
    return { ...field, steps: steps(field.steps), cells: numbers(field.cells), values: floats(field.values) };
  }

  function decodeTrack(track, box) {
    return {
      name: track.name,
      body: track.body,
      ring: track.ring,
      scans: track.scans && decodeScans(track.scans),
      poses: decodePoses(track, box),
      lifts: new Set(track.lifts),
      maps: track.maps.map(decodeMap),
      beliefs: track.beliefs.map(({ name, entries }) => ({ name, steps: entries.map(e => e[0]), shapes: entries.map(e => e[1]) })),
      fields: track.fields.map(decodeField),
      series: track.series.map(decodeSeries),
      notes: track.notes.map(n => ({ name: n.name, texts: n.texts, steps: steps(n.steps), index: numbers(n.index) })),
      marks: track.marks.map(decodeMarks),
    };
  }

  function decodeMarks(marks) {
    return { kind: marks.kind, name: marks.name, steps: steps(marks.steps) };
  }

  function decode(replay) {
    const data = typeof replay === "string" ? JSON.parse(replay) : replay;
    if (data.format !== "tolman-replay" || ![1, 2].includes(data.version)) {
      throw new Error("not a replay of version 1 or 2: " + data.format + " " + data.version);
    }
    const tracks = data.tracks.map(track => decodeTrack(track, data.box));
    return {
      title: data.title,
      facts: data.facts,
      stepLength: data.step_s,
      chapters: (data.chapters || []).map(([from, caption]) => ({ from, caption })),
      box: data.box,
      walls: floats(data.walls),
      zones: data.zones.map(zone => ({ ...zone, corners: floats(zone.corners) })),
      doors: data.doors.map(door => ({ ...door, steps: door.shut.map(c => c[0]), states: door.shut.map(c => c[1] === 1) })),
      tracks,
      marks: gatherMarks(data.marks.map(decodeMarks), tracks),
      last: Math.max(...tracks.map(track => track.poses.last)),
    };
  }

  // One list for the time line: marks of one name and kind of all tracks together.
  function gatherMarks(common, tracks) {
    const gathered = new Map();
    for (const marks of [...tracks.flatMap(track => track.marks), ...common]) {
      if (marks.steps.length === 0) continue;
      const key = marks.kind + " " + marks.name;
      const before = gathered.get(key);
      const all = before ? [...new Set([...before.steps, ...marks.steps])].sort((a, b) => a - b) : marks.steps;
      gathered.set(key, { kind: marks.kind, name: marks.name, steps: all });
    }
    return [...gathered.values()];
  }

  // ---------------------------------------------------------------- model: what holds at a step

  // The index of the last of the ascending steps that is not after `step`; -1 if all are.
  function lastAt(steps, step) {
    let low = 0, high = steps.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (steps[middle] <= step) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  // A track that is over stays where it ended.
  function poseAt(track, step) {
    const { x, y, heading, last } = track.poses;
    const i = Math.min(step, last);
    return { x: x[i], y: y[i], heading: heading[i] };
  }

  function alive(thing, step) {
    return thing.born <= step && (thing.died == null || step < thing.died);
  }

  function placeOf(node, step) {
    if (node.moves) {
      for (let i = node.moves.length - 1; i >= 0; i--) {
        if (node.moves[i][0] <= step) return node.moves[i][1];
      }
    }
    return node.at;
  }

  // The label of a node at a step; empty for none.
  function labelOf(node, step) {
    const i = lastAt(node.labels.map(label => label[0]), step);
    return i < 0 ? "" : node.labels[i][1];
  }

  function isShut(door, step) {
    const i = lastAt(door.steps, step);
    return i >= 0 && door.states[i];
  }

  // Walls by place, so that a beam is tried only on those near by.
  class WallGrid {
    constructor(walls, box) {
      const count = walls.length / 4;
      this.walls = walls;
      this.cell = Math.max(box[2] - box[0], box[3] - box[1], 1e-3) / Math.max(1, Math.min(128, Math.sqrt(count)));
      this.west = box[0];
      this.south = box[1];
      this.columns = Math.ceil((box[2] - box[0]) / this.cell) + 1;
      this.rows = Math.ceil((box[3] - box[1]) / this.cell) + 1;
      this.cells = new Map();
      this.stamp = new Uint32Array(count);
      this.now = 0;
      for (let wall = 0; wall < count; wall++) {
        const [x0, y0, x1, y1] = walls.subarray(4 * wall, 4 * wall + 4);
        this.each(Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1), cell => {
          if (!this.cells.has(cell)) this.cells.set(cell, []);
          this.cells.get(cell).push(wall);
        });
      }
    }

    each(west, south, east, north, act) {
      const clamp = (value, most) => Math.max(0, Math.min(most - 1, Math.floor(value / this.cell)));
      const first = clamp(west - this.west, this.columns), last = clamp(east - this.west, this.columns);
      const top = clamp(north - this.south, this.rows);
      for (let row = clamp(south - this.south, this.rows); row <= top; row++) {
        for (let column = first; column <= last; column++) act(row * this.columns + column);
      }
    }

    // The walls within `reach` of a position and perhaps some more, four coordinates each.
    near(x, y, reach) {
      const found = [];
      this.now++;
      this.each(x - reach, y - reach, x + reach, y + reach, cell => {
        for (const wall of this.cells.get(cell) || []) {
          if (this.stamp[wall] === this.now) continue;
          this.stamp[wall] = this.now;
          for (let i = 0; i < 4; i++) found.push(this.walls[4 * wall + i]);
        }
      });
      return found;
    }
  }

  // How far a ray with this direction of length 1 goes before it meets a wall.
  function cast(walls, x, y, dx, dy, reach) {
    let range = reach;
    for (let i = 0; i < walls.length; i += 4) {
      const ax = walls[i] - x, ay = walls[i + 1] - y, bx = walls[i + 2] - x, by = walls[i + 3] - y;
      const a = dx * ay - dy * ax, b = dx * by - dy * bx;
      if (a * b > 0 || a === b) continue;
      const along = ((dx * ax + dy * ay) * b - (dx * bx + dy * by) * a) / (b - a);
      if (along >= 0 && along < range) range = along;
    }
    return range;
  }

  // The ranges of a track's beams at a step, read or cast; null for a robot without.
  function rangesAt(run, track, step) {
    if (track.scans) {
      const scan = lastAt(track.scans.steps, step);
      if (scan < 0) return null;
      return { ring: track.scans.ring, ranges: Array.from({ length: track.scans.ring.beams }, (_, beam) => track.scans.range(scan, beam)) };
    }
    if (!track.ring) return null;
    const { x, y, heading } = poseAt(track, step);
    const walls = run.wallGrid.near(x, y, track.ring.reach);
    for (const door of run.doors) {
      if (isShut(door, step)) walls.push(...door.ends);
    }
    const ranges = [];
    for (let beam = 0; beam < track.ring.beams; beam++) {
      const angle = heading + track.ring.first + beam * track.ring.spacing;
      ranges.push(cast(walls, x, y, Math.cos(angle), Math.sin(angle), track.ring.reach));
    }
    return { ring: track.ring, ranges };
  }

  // ---------------------------------------------------------------- view: metres to pixels

  // The whole of the box with a margin.
  function fitted(box, width, height) {
    const [west, south, east, north] = box;
    const margin = Math.min(28, 0.06 * Math.min(width, height));
    const scale = Math.min((width - 2 * margin) / Math.max(east - west, 1e-3), (height - 2 * margin) / Math.max(north - south, 1e-3));
    return { x: (west + east) / 2, y: (south + north) / 2, scale: Math.max(scale, 1e-3) };
  }

  function sameView(a, b) {
    return a && b && a.x === b.x && a.y === b.y && a.scale === b.scale;
  }

  // ---------------------------------------------------------------- drawing

  const COLOURS = {
    light: {
      floor: "#ffffff", wall: "#1b1f24", solid: "#e3e6ea", destination: "#bfe8cf", start: "#e8eef6", region: "#f0f1f4",
      beam: "#d98200", body: "#f5b800", outline: "#1b1f24", node: "#ffffff", edge: "#c4252b", relation: "#7a5bd0",
      known: "#0072b2", belief: "#8a3fc9", selected: "#0072b2", field: [210, 80, 48], series: "#0072b2",
      tracks: ["#0072b2", "#d55e00", "#009e73", "#c0629a", "#7a6a00"],
      trail: share => "hsl(" + (150 + 110 * share) + ",62%," + (58 - 4 * share) + "%)",
    },
    dark: {
      floor: "#181c21", wall: "#dfe3e8", solid: "#2b3138", destination: "#1d4630", start: "#222c3a", region: "#20252b",
      beam: "#f0b040", body: "#f5c518", outline: "#0d0f12", node: "#181c21", edge: "#ff6b6b", relation: "#b49bff",
      known: "#5cb3ee", belief: "#c792ff", selected: "#5cb3ee", field: [210, 80, 60], series: "#5cb3ee",
      tracks: ["#5cb3ee", "#ff8a4c", "#3ccaa0", "#e79bc7", "#d8cc5a"],
      trail: share => "hsl(" + (150 + 110 * share) + ",58%," + (52 + 10 * share) + "%)",
    },
  };

  const MARK_COLOURS = { bump: "#d98200", failure: "#d5384a", arrival: "#1f9d57", kidnapping: "#8a3fc9", difference: "#e0118a", event: "#6b7684" };

  // A canvas of its own for what is drawn once and shown often.
  function buffer(width, height, ratio) {
    const canvas = document.createElement("canvas");
    canvas.width = Math.max(1, Math.round(width * ratio));
    canvas.height = Math.max(1, Math.round(height * ratio));
    return canvas;
  }

  // Lets a context take metres. Lengths in pixels are divided by the scale.
  function toWorld(context, stage, at) {
    const k = at.scale * stage.ratio;
    context.setTransform(k, 0, 0, -k, stage.ratio * stage.width / 2 - at.x * k, stage.ratio * stage.height / 2 + at.y * k);
  }

  function toScreen(context, stage) {
    context.setTransform(stage.ratio, 0, 0, stage.ratio, 0, 0);
  }

  function screenOf(stage, at, x, y) {
    return [stage.width / 2 + (x - at.x) * at.scale, stage.height / 2 - (y - at.y) * at.scale];
  }

  function worldOf(stage, at, x, y) {
    return [at.x + (x - stage.width / 2) / at.scale, at.y - (y - stage.height / 2) / at.scale];
  }

  function drawScenery(context, stage, at, run, colours) {
    toScreen(context, stage);
    context.fillStyle = colours.floor;
    context.fillRect(0, 0, stage.width, stage.height);
    toWorld(context, stage, at);
    for (const { kind, corners } of run.zones) {
      context.beginPath();
      for (let i = 0; i < corners.length; i += 2) context.lineTo(corners[i], corners[i + 1]);
      context.fillStyle = context.strokeStyle = colours[kind];
      context.lineWidth = 1 / at.scale;
      context.closePath();
      context.fill();
      // So that no floor shines through between neighbours.
      if (kind === "solid") context.stroke();
    }
    context.beginPath();
    const { walls } = run;
    for (let i = 0; i < walls.length; i += 4) {
      context.moveTo(walls[i], walls[i + 1]);
      context.lineTo(walls[i + 2], walls[i + 3]);
    }
    context.strokeStyle = colours.wall;
    context.lineCap = "round";
    context.lineWidth = wallWidth(run, at) / at.scale;
    context.stroke();
  }

  // Strong in a small maze, thin in a large one; pixels.
  function wallWidth(run, at) {
    return Math.max(0.7, Math.min(3.5, at.scale * 0.06));
  }

  // The colours of a trail along its time.
  const TRAIL_SHADES = 48;

  // The trail is drawn once and then only carried on: at most so many poses a frame, so that long runs stay smooth.
  const POSES_PER_FRAME = 5000;

  // Beyond so many poses the trail leaves some out.
  const POSES_DRAWN = 200000;

  // The robots' ways up to a step, on a canvas of their own that is carried on from frame to frame.
  class Trail {
    constructor(run) {
      this.run = run;
      this.stride = Math.max(1, Math.ceil(run.last / POSES_DRAWN));
      this.interval = Math.max(1000, Math.ceil(run.last / 10));
      this.forget();
    }

    // Nothing of what was drawn holds any more.
    forget() {
      this.current = null;
      this.stale = null;
    }

    // Brings the trail up to `step` as far as one frame allows; whether it is there.
    update(stage, at, step, style) {
      if (!this.current || !sameView(this.current.at, at)) {
        // While the new one is on its way the old one is shown, moved into place.
        if (this.current && this.current.done) this.stale = this.current;
        this.current = { canvas: buffer(stage.width, stage.height, stage.ratio), at: { ...at }, upTo: 0, saved: [], done: false };
      }
      const trail = this.current;
      if (step < trail.upTo) this.goBack(trail, step);
      const to = Math.min(step, trail.upTo + POSES_PER_FRAME * this.stride);
      if (to > trail.upTo) this.carryOn(trail, stage, to, style);
      trail.done = trail.upTo >= step;
      if (trail.done) this.stale = null;
      return trail.done;
    }

    // Takes up the last state that was saved before `step`.
    goBack(trail, step) {
      const context = trail.canvas.getContext("2d");
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, trail.canvas.width, trail.canvas.height);
      while (trail.saved.length && trail.saved[trail.saved.length - 1].upTo > step) trail.saved.pop();
      const saved = trail.saved[trail.saved.length - 1];
      if (saved) context.drawImage(saved.canvas, 0, 0);
      trail.upTo = saved ? saved.upTo : 0;
    }

    carryOn(trail, stage, to, style) {
      const context = trail.canvas.getContext("2d");
      toWorld(context, stage, trail.at);
      context.lineCap = "round";
      context.lineJoin = "round";
      context.lineWidth = 2 / trail.at.scale;
      this.run.tracks.forEach((track, number) => {
        if (style.shown(number)) this.segments(context, track, number, trail.upTo, to, style);
      });
      const before = Math.floor(trail.upTo / this.interval);
      trail.upTo = to;
      if (Math.floor(to / this.interval) > before) {
        const canvas = buffer(stage.width, stage.height, stage.ratio);
        canvas.getContext("2d").drawImage(trail.canvas, 0, 0);
        trail.saved.push({ canvas, upTo: to });
      }
    }

    segments(context, track, number, from, to, style) {
      const { x, y, last } = track.poses, end = Math.min(to, last);
      const shade = step => Math.min(TRAIL_SHADES - 1, Math.floor(step * TRAIL_SHADES / Math.max(1, this.run.last)));
      let open = -1;
      for (let step = from; step < end; step += this.stride) {
        const next = Math.min(step + this.stride, end);
        if (open !== shade(step)) {
          if (open >= 0) context.stroke();
          open = shade(step);
          context.strokeStyle = style.colour(number, open / (TRAIL_SHADES - 1));
          context.beginPath();
          context.moveTo(x[step], y[step]);
        }
        if (track.lifts.has(next)) context.moveTo(x[next], y[next]);
        else context.lineTo(x[next], y[next]);
      }
      if (open >= 0) context.stroke();
    }

    draw(context, stage, at) {
      const shown = this.stale || this.current;
      if (!shown) return;
      const k = at.scale / shown.at.scale;
      const [left, top] = screenOf(stage, at, shown.at.x, shown.at.y);
      toScreen(context, stage);
      context.globalAlpha = 0.8;
      context.drawImage(shown.canvas, left - k * stage.width / 2, top - k * stage.height / 2, k * stage.width, k * stage.height);
      context.globalAlpha = 1;
    }
  }

  // The values of a field at a step; carried on from the step asked before.
  class FieldState {
    constructor(field) {
      this.field = field;
      this.reset();
    }

    reset() {
      this.upTo = 0;
      this.values = new Map();
    }

    at(step) {
      const { steps, cells, values } = this.field;
      if (this.upTo > 0 && steps[this.upTo - 1] > step) this.reset();
      for (; this.upTo < steps.length && steps[this.upTo] <= step; this.upTo++) this.values.set(cells[this.upTo], values[this.upTo]);
      return this.values;
    }
  }

  function drawField(context, stage, at, state, step, colours) {
    const { origin, pitch, columns, range } = state.field;
    const [hue, saturation, lightness] = colours.field;
    const digits = pitch * at.scale > 26;
    toWorld(context, stage, at);
    const written = [];
    for (const [cell, value] of state.at(step)) {
      if (Number.isNaN(value)) continue;
      const x = origin[0] + (cell % columns) * pitch, y = origin[1] + Math.floor(cell / columns) * pitch;
      const share = Math.max(0, Math.min(1, (value - range[0]) / (range[1] - range[0] || 1)));
      context.fillStyle = "hsla(" + hue + "," + saturation + "%," + lightness + "%," + (0.04 + 0.4 * share) + ")";
      context.fillRect(x, y, pitch, pitch);
      if (digits) written.push([value, x + pitch / 2, y + pitch / 2]);
    }
    if (!written.length) return;
    toScreen(context, stage);
    context.fillStyle = colours.wall;
    context.globalAlpha = 0.7;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (const [value, x, y] of written) context.fillText(figure(value), ...screenOf(stage, at, x, y));
    context.globalAlpha = 1;
  }

  function drawDoors(context, stage, at, run, step, colours) {
    toWorld(context, stage, at);
    context.lineCap = "butt";
    for (const door of run.doors) {
      const shut = isShut(door, step);
      context.beginPath();
      context.moveTo(door.ends[0], door.ends[1]);
      context.lineTo(door.ends[2], door.ends[3]);
      context.strokeStyle = shut ? colours.edge : colours.solid;
      context.lineWidth = 3 / at.scale;
      context.setLineDash(shut ? [] : [4 / at.scale, 4 / at.scale]);
      context.stroke();
    }
    context.setLineDash([]);
  }

  function drawBeams(context, stage, at, run, track, step, colours) {
    const seen = rangesAt(run, track, step);
    if (!seen) return;
    const { x, y, heading } = poseAt(track, step);
    toWorld(context, stage, at);
    context.beginPath();
    seen.ranges.forEach((range, beam) => {
      const angle = heading + seen.ring.first + beam * seen.ring.spacing;
      context.moveTo(x, y);
      context.lineTo(x + range * Math.cos(angle), y + range * Math.sin(angle));
    });
    context.strokeStyle = colours.beam;
    context.globalAlpha = 0.55;
    context.lineWidth = 0.9 / at.scale;
    context.stroke();
    context.globalAlpha = 1;
  }

  const EDGE_STYLES = {
    passage: { colour: "edge", width: 1.8, dash: [] },
    supposed: { colour: "edge", width: 1.2, dash: [3, 4] },
    wall: { colour: "known", width: 3, dash: [] },
    relation: { colour: "relation", width: 1.2, dash: [4, 3] },
  };

  // Edges one by one and nodes as stamps: one long path of them all takes ten times as long to fill.
  function drawMap(context, stage, at, map, step, colours, edgeColour) {
    toWorld(context, stage, at);
    for (const edge of map.edges) {
      if (!alive(edge, step)) continue;
      const style = EDGE_STYLES[edge.kind];
      context.strokeStyle = style.colour === "edge" ? edgeColour : colours[style.colour];
      context.lineWidth = style.width / at.scale;
      context.setLineDash(style.dash.map(length => length / at.scale));
      context.beginPath();
      context.moveTo(...placeOf(edge.a, step));
      for (let i = 0; i < edge.way.length; i += 2) context.lineTo(edge.way[i], edge.way[i + 1]);
      context.lineTo(...placeOf(edge.b, step));
      context.stroke();
    }
    context.setLineDash([]);
    toScreen(context, stage);
    const stamp = nodeStamp(stage, at, colours, edgeColour), half = stamp.width / stage.ratio / 2, labelled = [];
    for (const node of map.nodes) {
      if (!alive(node, step)) continue;
      const [left, top] = screenOf(stage, at, ...placeOf(node, step));
      context.drawImage(stamp, left - half, top - half, 2 * half, 2 * half);
      if (node.labels.length) labelled.push([labelOf(node, step), left, top]);
    }
    drawLabels(context, at, labelled, colours);
  }

  function nodeStamp(stage, at, colours, edgeColour) {
    const radius = nodeRadius(at), half = radius + 1.5, stamp = buffer(2 * half, 2 * half, stage.ratio);
    const context = stamp.getContext("2d");
    context.setTransform(stage.ratio, 0, 0, stage.ratio, stamp.width / 2, stamp.height / 2);
    context.beginPath();
    context.arc(0, 0, radius, 0, 2 * Math.PI);
    context.fillStyle = colours.node;
    context.strokeStyle = edgeColour;
    context.lineWidth = 1.6;
    context.fill();
    context.stroke();
    return stamp;
  }

  function drawSelected(context, stage, at, node, step, colours) {
    if (!node || !alive(node, step)) return;
    const [left, top] = screenOf(stage, at, ...placeOf(node, step));
    toScreen(context, stage);
    context.beginPath();
    context.arc(left, top, 1.9 * nodeRadius(at), 0, 2 * Math.PI);
    context.strokeStyle = colours.selected;
    context.lineWidth = 2.5;
    context.stroke();
  }

  function nodeRadius(at) {
    return Math.max(2.2, Math.min(5, at.scale * 0.12));
  }

  // Words only where there is room for them.
  function drawLabels(context, at, labelled, colours) {
    if (at.scale < 24 || labelled.length > 600) return;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "left";
    context.textBaseline = "bottom";
    context.fillStyle = colours.wall;
    for (const [label, left, top] of labelled) context.fillText(label, left + 6, top - 3);
  }

  // What changes now and then is drawn on a canvas of its own, anew when the view or its state is another.
  class Kept {
    constructor() {
      this.state = null;
    }

    show(context, stage, at, state, draw) {
      const fits = this.canvas && this.canvas.width === context.canvas.width && this.canvas.height === context.canvas.height;
      if (!fits || this.state !== state || !sameView(this.at, at)) {
        if (!fits) this.canvas = buffer(stage.width, stage.height, stage.ratio);
        const own = this.canvas.getContext("2d");
        own.setTransform(1, 0, 0, 1, 0, 0);
        own.clearRect(0, 0, this.canvas.width, this.canvas.height);
        draw(own);
        this.state = state;
        this.at = { ...at };
      }
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(this.canvas, 0, 0);
    }
  }

  function drawBelief(context, stage, at, belief, step, colours, nodeById) {
    const entry = lastAt(belief.steps, step);
    if (entry < 0) return;
    toWorld(context, stage, at);
    context.fillStyle = context.strokeStyle = colours.belief;
    const px = 1 / at.scale;
    for (const [kind, weight, ...what] of belief.shapes[entry]) {
      const strength = 0.25 + 0.75 * Math.max(0, Math.min(1, weight == null ? 1 : weight));
      context.globalAlpha = strength;
      context.lineWidth = 1.5 * px;
      context.beginPath();
      if (kind === "point") {
        context.arc(...what[0], (1.5 + 2.5 * strength) * px, 0, 2 * Math.PI);
        context.fill();
      } else if (kind === "pose") {
        const [[x, y], heading] = what;
        context.arc(x, y, 2.5 * px, 0, 2 * Math.PI);
        context.fill();
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x + 11 * px * Math.cos(heading), y + 11 * px * Math.sin(heading));
        context.stroke();
      } else if (kind === "node") {
        const node = nodeById(what[0]);
        if (!node) continue;
        context.arc(...placeOf(node, step), (nodeRadius(at) + 4) * px, 0, 2 * Math.PI);
        context.lineWidth = 3 * px;
        context.stroke();
      } else if (kind === "box") {
        const [[west, south], [east, north]] = what;
        context.rect(west, south, east - west, north - south);
        context.stroke();
        context.globalAlpha = 0.18 * strength;
        context.fill();
      } else if (kind === "ellipse") {
        const [[x, y], [a, b], heading] = what;
        context.ellipse(x, y, Math.max(0, a), Math.max(0, b), heading, 0, 2 * Math.PI);
        context.stroke();
        context.globalAlpha = 0.18 * strength;
        context.fill();
      }
    }
    context.globalAlpha = 1;
  }

  function drawRobot(context, stage, at, track, step, fill, colours) {
    const { x, y, heading } = poseAt(track, step);
    toWorld(context, stage, at);
    context.translate(x, y);
    context.rotate(heading);
    const px = 1 / at.scale;
    const radius = Math.max(bodyRadius(track.body), 5 * px);
    context.beginPath();
    if (track.body.corners && bodyRadius(track.body) > 5 * px) {
      for (let i = 0; i < track.body.corners.length; i += 2) context.lineTo(track.body.corners[i], track.body.corners[i + 1]);
      context.closePath();
    } else {
      context.arc(0, 0, radius, 0, 2 * Math.PI);
    }
    context.globalAlpha = 0.92;
    context.fillStyle = fill;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = colours.outline;
    context.lineWidth = 1.8 * px;
    context.stroke();
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(radius * 1.15, 0);
    context.stroke();
  }

  function bodyRadius(body) {
    if (body.radius != null) return body.radius;
    let radius = 0;
    for (let i = 0; i < body.corners.length; i += 2) radius = Math.max(radius, Math.hypot(body.corners[i], body.corners[i + 1]));
    return radius;
  }

  // A scan as seen from above, north up: what the node stands for.
  function drawPolar(canvas, exemplar, colours) {
    const ratio = window.devicePixelRatio || 1, size = 170;
    canvas.width = canvas.height = size * ratio;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, -ratio, size / 2 * ratio, size / 2 * ratio);
    const { ring } = exemplar, ranges = bytes(exemplar.ranges), unit = (size / 2 - 6) / ring.reach;
    context.strokeStyle = colours.solid;
    for (const share of [0.5, 1]) {
      context.beginPath();
      context.arc(0, 0, share * ring.reach * unit, 0, 2 * Math.PI);
      context.stroke();
    }
    context.beginPath();
    ranges.forEach((range, beam) => {
      const angle = exemplar.heading + ring.first + beam * ring.spacing, length = range / 255 * ring.reach * unit;
      context.lineTo(length * Math.cos(angle), length * Math.sin(angle));
    });
    if (ring.beams * ring.spacing < 6.2) context.lineTo(0, 0);
    context.closePath();
    context.fillStyle = context.strokeStyle = colours.beam;
    context.globalAlpha = 0.25;
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1.4;
    context.stroke();
    context.beginPath();
    context.arc(0, 0, 3, 0, 2 * Math.PI);
    context.fillStyle = colours.wall;
    context.fill();
  }

  // ---------------------------------------------------------------- words and elements

  // An element with attributes and children; "data-part" is what tests and styles find it by.
  function make(tag, attributes, ...children) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes || {})) {
      if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
      else if (value !== false && value != null) element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
  }

  // A number in as few digits as say something.
  function figure(value) {
    if (Number.isInteger(value)) return String(value);
    const size = Math.abs(value);
    return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : 2);
  }

  function inUnit(value, unit) {
    if (unit === "%") return (100 * value).toFixed(1) + " %";
    return figure(value) + (unit ? " " + unit : "");
  }

  function seconds(value) {
    return value.toFixed(2) + " s";
  }

  // ---------------------------------------------------------------- the player

  const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
  const KEYS = "space play · ←/→ step · shift ±10 · home/end · +/− speed · [ ] marks · wheel zoom · drag pan · 0 fit";

  // How the legend shows a layer.
  const SIGNS = { trajectory: ["trail"], map: ["graph", "edge"], belief: ["dot", "belief"], beams: ["line", "beam"] };
  const ZONES = { start: "start", destination: "goal", solid: "no floor" };

  class Player {
    constructor(element, data, { growing = false, autoplay = false } = {}) {
      this.growing = growing;
      this.hasAddress = !growing;
      this.sceneryKept = new Kept();
      this.fieldsKept = new Kept();
      this.take(decode(data));
      this.trail = new Trail(this.run);
      this.step = 0;
      this.playing = false;
      this.speed = this.calmSpeed();
      this.at = null;
      this.frames = 0;
      this.frameMs = 0;
      this.selected = null;
      this.undo = [];
      this.build(element);
      this.listen();
      this.resize();
      this.seek(this.hasAddress && this.stepOfAddress() || 0);
      // The first picture is there at once, also where nobody asks for frames: in a tab behind others, on paper.
      this.frame(performance.now());
      const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
      if (autoplay && !isCalm && this.stepOfAddress() === null) this.play();
    }

    // Takes a run, or the same with more of it; layers that were switched off stay so.
    take(run) {
      const off = new Set((this.layers || []).filter(layer => !layer.on).map(layer => layer.key));
      this.run = run;
      run.wallGrid = new WallGrid(run.walls, run.box);
      this.mapsKept = new Kept();
      this.fields = run.tracks.map(track => track.fields.map(field => new FieldState(field)));
      this.layers = this.layerList();
      for (const layer of this.layers) {
        if (off.has(layer.key)) layer.on = false;
      }
    }

    // Goes on with a longer replay of the same run. Step, speed, view and layers stay as they are.
    extend(data) {
      const before = this.partNames(), { selected } = this;
      this.take(decode(data));
      this.trail.run = this.run;
      this.slider.max = this.run.last;
      if (this.partNames() === before) {
        const { scrollTop } = this.panel;
        this.panel.querySelector("[data-part=charts]").replaceWith(this.charts());
        this.panel.querySelector("[data-part=mark-list]").replaceWith(this.markList());
        this.panel.scrollTop = scrollTop;
      } else {
        this.buildPanel();
      }
      let again = null;
      this.eachShownMap(map => again = again || selected && map.byId.get(selected.id));
      if (again !== selected) this.select(again);
      this.drawMarks();
      this.drawCharts();
      this.ask();
    }

    // What the panel has a line or a box for.
    partNames() {
      const lists = this.run.tracks.flatMap(track => [...track.notes, ...track.series, ...track.maps]);
      return JSON.stringify([this.layers.map(layer => layer.key), lists.map(list => list.name)]);
    }

    // ---- parts

    // The first speed at which the whole run takes no more than a minute.
    calmSpeed() {
      const whole = this.run.last * this.run.stepLength;
      return SPEEDS.find(speed => speed >= 1 && whole / speed <= 60) || SPEEDS[SPEEDS.length - 1];
    }

    // What can be switched on and off: only what this run has.
    layerList() {
      const { tracks } = this.run, layers = [];
      const add = (key, name, on) => layers.push({ key, name, on });
      add("trajectory", "trajectory", true);
      const some = test => tracks.some(test);
      const each = (list, key) => {
        const names = new Set(tracks.flatMap(track => track[list].map(layer => layer.name)));
        for (const name of names) add(key + ":" + name, name, true);
      };
      each("maps", "map");
      each("beliefs", "belief");
      each("fields", "field");
      if (some(track => track.ring || track.scans)) add("beams", "range sensor", true);
      if (tracks.length > 1) tracks.forEach((track, number) => add("track:" + number, track.name, true));
      add("follow", "follow robot", false);
      return layers;
    }

    shows(key) {
      const layer = this.layers.find(layer => layer.key === key);
      return layer ? layer.on : true;
    }

    build(element) {
      const { run } = this;
      this.root = make("div", { class: "tolman-replay", tabindex: "-1", "data-part": "replay", "data-theme": this.preferredTheme(), "data-tracks": run.tracks.length > 1 && run.tracks.length });
      this.canvas = make("canvas", { "data-part": "canvas", "aria-label": "The world and the robots in it" });
      this.caption = make("p", { class: "caption", "data-part": "caption", hidden: "" });
      this.stageBox = make("div", { class: "stage", "data-part": "stage" }, this.canvas);
      this.playButton = make("button", { type: "button", "data-part": "play", title: "play or pause (space)", onclick: () => this.toggle() }, "▶");
      const back = make("button", { type: "button", class: "step", "data-part": "back", title: "one step back (←)", onclick: () => this.pauseAt(this.step - 1) }, "‹");
      const ahead = make("button", { type: "button", class: "step", "data-part": "ahead", title: "one step ahead (→)", onclick: () => this.pauseAt(this.step + 1) }, "›");
      this.speedBox = make("select", { "data-part": "speed", title: "speed (+ and −)", "aria-label": "speed", onchange: () => this.setSpeed(Number(this.speedBox.value)) });
      for (const speed of SPEEDS) this.speedBox.append(make("option", { value: speed }, speed + "×"));
      this.slider = make("input", { type: "range", min: 0, max: run.last, step: 1, "data-part": "slider", "aria-label": "step", oninput: () => this.seek(Number(this.slider.value)) });
      this.markStrip = make("canvas", { class: "marks", "data-part": "marks", title: "what happened when; click to go there", onclick: event => this.seekMarkNear(event) });
      this.clock = make("output", { "data-part": "time" });
      const theme = make("button", { type: "button", class: "quiet", "data-part": "theme", title: "light or dark (t)", onclick: () => this.toggleTheme() }, "◐");
      this.panel = make("aside", { "data-part": "panel" });
      this.root.append(
        make("header", {}, make("h1", { "data-part": "title" }, run.title), make("p", { class: "keys" }, KEYS), theme),
        this.stageBox,
        this.caption,
        this.panel,
        make("footer", {}, this.playButton, back, ahead, this.speedBox, make("div", { class: "time" }, this.slider, this.markStrip), this.clock),
      );
      this.buildPanel();
      element.replaceChildren(this.root);
      this.setSpeed(this.speed);
    }

    buildPanel() {
      this.panel.replaceChildren(this.layerBoxes(), this.valueTable(), this.charts(), this.markList(), this.factList());
      this.nodeBox = make("section", { "data-part": "node", hidden: "" });
      this.panel.insertBefore(this.nodeBox, this.panel.children[1]);
    }

    layerBoxes() {
      const box = make("section", { "data-part": "layers" }, make("h2", {}, "Layers"));
      this.signs = [];
      for (const layer of this.layers) {
        const input = make("input", { type: "checkbox", "data-layer": layer.key, onchange: () => this.setLayer(layer, input.checked) });
        input.checked = layer.on;
        const label = make("label", {}, input, " " + layer.name);
        if (layer.key.startsWith("track:")) label.append(this.swatch(Number(layer.key.slice(6))));
        else this.sign(label, SIGNS[layer.key.split(":")[0]]);
        box.append(label);
      }
      const zones = new Set(this.run.zones.map(zone => zone.kind));
      for (const kind of ["start", "destination", "solid"].filter(kind => zones.has(kind))) {
        const line = make("div", { "data-zone": kind }, ZONES[kind]);
        this.sign(line, ["zone", kind]);
        box.append(line);
      }
      return box;
    }

    // The legend: each layer and zone has a sign in the colours of the picture.
    sign(line, look) {
      if (!look) return;
      const [shape, colour] = look, sign = make("i", { class: "sign " + shape });
      const paint = () => sign.style.setProperty("--colour", this.colours()[colour]);
      paint();
      this.signs.push(paint);
      line.append(sign);
    }

    swatch(number) {
      return make("i", { class: "swatch track-" + number % 5 });
    }

    // What the robots know, a column for each.
    valueTable() {
      const { tracks } = this.run;
      const table = make("table", { "data-part": "values" });
      this.rows = [];
      if (tracks.length > 1) {
        const head = make("tr", {}, make("th", {}));
        tracks.forEach((track, number) => head.append(make("th", { class: "value" }, this.swatch(number), track.name)));
        table.append(head);
      }
      const row = (name, values) => {
        const cells = tracks.map(() => make("td", { class: "value", "data-value": name }));
        table.append(make("tr", {}, make("th", {}, name), ...cells));
        this.rows.push({ cells, values, texts: tracks.map(() => null) });
      };
      row("step", track => Math.min(this.step, track.poses.last) + " / " + track.poses.last);
      row("pose", track => {
        const { x, y, heading } = poseAt(track, this.step);
        return x.toFixed(2) + ", " + y.toFixed(2) + ", " + Math.round(heading * 180 / Math.PI) + "°";
      });
      if (tracks.some(track => track.maps.length)) {
        row("nodes", track => this.countAlive(track, "nodes"));
        row("edges", track => this.countAlive(track, "edges"));
      }
      this.namedRows(row, "notes", (notes, step) => {
        const i = lastAt(notes.steps, step);
        return i < 0 ? "–" : notes.texts[notes.index[i]];
      });
      this.namedRows(row, "series", (series, step) => {
        const i = lastAt(series.steps, step);
        return i < 0 ? "–" : inUnit(series.values[i], series.unit);
      });
      return make("section", {}, table);
    }

    namedRows(row, list, tell) {
      const names = new Set(this.run.tracks.flatMap(track => track[list].map(one => one.name)));
      for (const name of names) {
        row(name, track => {
          const one = track[list].find(one => one.name === name);
          return one ? tell(one, this.step) : "–";
        });
      }
    }

    countAlive(track, list) {
      return track.maps.reduce((sum, map) => sum + map[list].reduce((count, thing) => count + alive(thing, this.step), 0), 0);
    }

    // A curve for each series that has one; a click goes to that moment.
    charts() {
      const section = make("section", { "data-part": "charts" });
      this.chartList = [];
      const names = new Set(this.run.tracks.flatMap(track => track.series.map(series => series.name)));
      for (const name of names) {
        const lines = this.run.tracks.map((track, number) => ({ series: track.series.find(series => series.name === name), number, last: track.poses.last })).filter(line => line.series && line.series.steps.length > 1);
        if (lines.length === 0) continue;
        const canvas = make("canvas", {}), cursor = make("i", { class: "cursor" });
        const frame = make("div", { class: "chart", "data-chart": name, title: name, onpointerdown: event => this.seekInChart(event, frame) }, canvas, cursor);
        section.append(make("h3", {}, name), frame);
        this.chartList.push({ canvas, cursor, lines });
      }
      return section;
    }

    markList() {
      const section = make("section", { "data-part": "mark-list" });
      for (const marks of this.run.marks) {
        const go = by => () => this.pauseAt(this.markFrom([marks], by));
        section.append(make("div", { class: "mark", "data-mark": marks.kind },
          make("i", { class: "tick", style: "background:" + MARK_COLOURS[marks.kind] }),
          make("span", {}, marks.name), make("span", { class: "count" }, marks.steps.length),
          make("button", { type: "button", title: marks.name + " before", onclick: go(-1) }, "‹"),
          make("button", { type: "button", title: "next " + marks.name, onclick: go(1) }, "›")));
      }
      return section;
    }

    factList() {
      const list = make("dl", { "data-part": "facts" });
      for (const [name, value] of this.run.facts) list.append(make("dt", {}, name), make("dd", {}, value));
      return make("section", {}, list);
    }

    // ---- time

    seek(step) {
      const to = Math.max(0, Math.min(this.run.last, Math.round(step) || 0));
      if (to !== this.step) this.step = to;
      this.ask();
      if (!this.playing) this.writeAddress();
    }

    pauseAt(step) {
      this.pause();
      this.seek(step);
    }

    toggle() {
      if (this.playing) this.pause();
      else this.play();
    }

    play() {
      if (this.step >= this.run.last && !this.growing) this.step = 0;
      this.playing = true;
      this.since = null;
      this.ask();
    }

    pause() {
      if (!this.playing) return;
      this.playing = false;
      this.ask();
      this.writeAddress();
    }

    setSpeed(speed) {
      this.speed = speed;
      this.speedBox.value = String(speed);
      this.since = null;
    }

    // From where playing began at this speed, as many steps as the time since then holds.
    advance(now) {
      if (this.since === null) this.since = { now, step: this.step };
      const passed = (now - this.since.now) / 1000 * this.speed / this.run.stepLength;
      this.step = Math.min(this.run.last, this.since.step + Math.floor(passed));
      if (this.step < this.run.last) return;
      // More is to come: it waits for that.
      if (this.growing) this.since = null;
      else this.pause();
    }

    // The next mark after this step, or the last one before it.
    markFrom(lists, by) {
      let best = null;
      for (const { steps } of lists) {
        const i = by > 0 ? lastAt(steps, this.step) + 1 : lastAt(steps, this.step - 1);
        const step = steps[i];
        if (step !== undefined && (best === null || (by > 0 ? step < best : step > best))) best = step;
      }
      return best === null ? this.step : best;
    }

    // ---- links

    // "#t=120" is step 120; whatever else the address says is left as it is.
    stepOfAddress() {
      const t = new URLSearchParams(location.hash.slice(1)).get("t");
      return t === null || !(Number(t) >= 0) ? null : Number(t);
    }

    writeAddress() {
      if (!this.hasAddress) return;
      const parameters = new URLSearchParams(location.hash.slice(1));
      if (this.step === 0 && !parameters.has("t") || parameters.get("t") === String(this.step)) return;
      parameters.set("t", this.step);
      clearTimeout(this.writing);
      // Browsers allow only so many changes of the address in a time.
      this.writing = setTimeout(() => {
        try {
          history.replaceState(history.state, "", "#" + parameters.toString());
        } catch {
          // An address that cannot be changed is only not changed.
        }
      }, 150);
    }

    // ---- layers and theme

    setLayer(layer, on) {
      layer.on = on;
      if (layer.key === "trajectory" || layer.key.startsWith("track:")) this.trail.forget();
      this.ask();
    }

    preferredTheme() {
      return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    }

    toggleTheme() {
      this.setTheme(this.root.dataset.theme === "dark" ? "light" : "dark");
    }

    setTheme(theme) {
      this.root.dataset.theme = theme;
      this.trail.forget();
      for (const paint of this.signs) paint();
      this.drawMarks();
      this.drawCharts();
      this.showNode();
      this.ask();
    }

    colours() {
      return COLOURS[this.root.dataset.theme];
    }

    // ---- listening

    on(target, type, act, options) {
      target.addEventListener(type, act, options);
      this.undo.push(() => target.removeEventListener(type, act, options));
    }

    listen() {
      this.on(document, "keydown", event => this.key(event));
      this.on(window, "hashchange", () => {
        const step = this.stepOfAddress();
        if (this.hasAddress && step !== null && step !== this.step) this.pauseAt(step);
      });
      this.on(matchMedia("(prefers-color-scheme: dark)"), "change", () => this.setTheme(this.preferredTheme()));
      const observer = new ResizeObserver(() => this.resize());
      observer.observe(this.stageBox);
      observer.observe(this.markStrip);
      this.undo.push(() => observer.disconnect());
      this.listenToPointers();
    }

    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const { target } = event;
      const typing = target instanceof HTMLElement && (target.isContentEditable || /^(TEXTAREA|SELECT)$/.test(target.tagName) || target.tagName === "INPUT" && !this.root.contains(target));
      // A button or box in focus is pressed by the space bar as anywhere else.
      const pressed = event.key === " " && target instanceof HTMLElement && /^(BUTTON|INPUT)$/.test(target.tagName) && target !== this.slider;
      const act = typing || pressed ? null : this.actionOf(event);
      if (!act) return;
      event.preventDefault();
      act();
    }

    actionOf(event) {
      const by = event.shiftKey ? 10 : 1;
      switch (event.key) {
        case " ": return () => this.toggle();
        case "ArrowLeft": return () => this.pauseAt(this.step - by);
        case "ArrowRight": return () => this.pauseAt(this.step + by);
        case "Home": return () => this.pauseAt(0);
        case "End": return () => this.pauseAt(this.run.last);
        case "+": case "=": return () => this.changeSpeed(1);
        case "-": case "−": return () => this.changeSpeed(-1);
        case "[": return () => this.pauseAt(this.markFrom(this.run.marks, -1));
        case "]": return () => this.pauseAt(this.markFrom(this.run.marks, 1));
        case "0": return () => this.fit();
        case "t": return () => this.toggleTheme();
        default: return null;
      }
    }

    changeSpeed(by) {
      const now = SPEEDS.indexOf(this.speed);
      this.setSpeed(SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, now + by))]);
    }

    // Drag to pan, two fingers or the wheel to zoom, a click on a node to ask what it knows.
    listenToPointers() {
      const fingers = new Map();
      let moved = 0;
      const place = event => {
        const box = this.canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
      };
      const middle = () => {
        const [a, b] = [...fingers.values()];
        return b ? { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, gap: Math.hypot(a[0] - b[0], a[1] - b[1]) } : { x: a[0], y: a[1], gap: 0 };
      };
      this.on(this.canvas, "pointerdown", event => {
        this.canvas.setPointerCapture(event.pointerId);
        if (fingers.size === 0) moved = 0;
        fingers.set(event.pointerId, place(event));
      });
      this.on(this.canvas, "pointermove", event => {
        if (!fingers.has(event.pointerId)) {
          this.canvas.style.cursor = this.nodeAt(...place(event)) ? "pointer" : "";
          return;
        }
        const before = middle();
        fingers.set(event.pointerId, place(event));
        const now = middle();
        moved += Math.hypot(now.x - before.x, now.y - before.y);
        this.pan(now.x - before.x, now.y - before.y);
        if (before.gap > 0 && now.gap > 0) this.zoom(now.gap / before.gap, now.x, now.y);
      });
      const lift = event => {
        if (!fingers.delete(event.pointerId)) return;
        if (event.type === "pointerup" && fingers.size === 0 && moved < 5) this.select(this.nodeAt(...place(event)));
      };
      this.on(this.canvas, "pointerup", lift);
      this.on(this.canvas, "pointercancel", lift);
      this.on(this.canvas, "wheel", event => {
        event.preventDefault();
        this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...place(event));
      }, { passive: false });
    }

    // Where in the world a pointer is, m.
    worldAt(event) {
      const box = this.canvas.getBoundingClientRect();
      return worldOf(this.stage, this.at, event.clientX - box.left, event.clientY - box.top);
    }

    pan(dx, dy) {
      this.at = { ...this.at, x: this.at.x - dx / this.at.scale, y: this.at.y + dy / this.at.scale };
      this.moved = true;
      this.ask();
    }

    // Keeps the place under the pointer where it is.
    zoom(by, x, y) {
      const whole = fitted(this.run.box, this.stage.width, this.stage.height).scale;
      const scale = Math.max(0.3 * whole, Math.min(200 * whole, this.at.scale * by));
      const [wx, wy] = worldOf(this.stage, this.at, x, y);
      this.at = { scale, x: wx - (x - this.stage.width / 2) / scale, y: wy + (y - this.stage.height / 2) / scale };
      this.moved = true;
      this.ask();
    }

    fit() {
      this.at = fitted(this.run.box, this.stage.width, this.stage.height);
      this.moved = false;
      this.ask();
    }

    seekInChart(event, frame) {
      const box = frame.getBoundingClientRect();
      this.pauseAt((event.clientX - box.left) / box.width * this.run.last);
    }

    // The mark nearest to the place clicked.
    seekMarkNear(event) {
      const box = this.markStrip.getBoundingClientRect();
      const wanted = this.stepAtStrip(event.clientX - box.left, box.width);
      let best = null;
      for (const { steps } of this.run.marks) {
        const i = lastAt(steps, wanted);
        for (const step of [steps[i], steps[i + 1]]) {
          if (step !== undefined && (best === null || Math.abs(step - wanted) < Math.abs(best - wanted))) best = step;
        }
      }
      if (best !== null) this.pauseAt(best);
    }

    // ---- nodes

    eachShownMap(act) {
      this.run.tracks.forEach((track, number) => {
        if (!this.shows("track:" + number)) return;
        for (const map of track.maps) {
          if (this.shows("map:" + map.name)) act(map, number);
        }
      });
    }

    nodeAt(x, y) {
      let best = null, nearest = 14;
      this.eachShownMap(map => {
        for (const node of map.nodes) {
          if (!alive(node, this.step)) continue;
          const [left, top] = screenOf(this.stage, this.at, ...placeOf(node, this.step));
          const distance = Math.hypot(left - x, top - y);
          if (distance < nearest) {
            nearest = distance;
            best = node;
          }
        }
      });
      return best;
    }

    select(node) {
      this.selected = node;
      this.root.dataset.node = node ? node.id : "";
      this.showNode();
      this.ask();
    }

    showNode() {
      const node = this.selected;
      this.nodeBox.hidden = !node;
      this.nodeVisits = null;
      if (!node) return;
      const list = make("dl", {});
      const tell = (name, ...value) => list.append(make("dt", {}, name), make("dd", {}, ...value));
      tell("born", this.stepLink(node.born));
      if (node.died != null) tell("gone", this.stepLink(node.died));
      this.nodeVisits = make("span", {});
      if (node.visits.length) tell("visits", this.nodeVisits);
      for (const [name, value] of node.facts || []) tell(name, value);
      for (const edge of this.edgesOf(node)) {
        tell(edge.a === node ? "→ " + this.nameOf(edge.b) : "← " + this.nameOf(edge.a), edge.label || edge.kind);
      }
      this.nodeBox.replaceChildren(make("h2", {}, this.nameOf(node)), list);
      if (node.exemplar) {
        const canvas = make("canvas", { class: "polar", "data-part": "polar", title: "the scan it stands for, north up" });
        drawPolar(canvas, node.exemplar, this.colours());
        this.nodeBox.append(canvas);
      }
      this.tellVisits();
    }

    nameOf(node) {
      return labelOf(node, this.step) || "node " + node.id;
    }

    // Those worth telling: all that are alive, up to a dozen.
    edgesOf(node) {
      const found = [];
      this.eachShownMap(map => {
        for (const edge of map.edges) {
          if ((edge.a === node || edge.b === node) && alive(edge, this.step) && found.length < 12) found.push(edge);
        }
      });
      return found;
    }

    stepLink(step) {
      return make("button", { type: "button", class: "link", onclick: () => this.pauseAt(step) }, "step " + step);
    }

    tellVisits() {
      if (!this.nodeVisits || !this.selected) return;
      const count = lastAt(this.selected.visits, this.step) + 1, all = this.selected.visits.length;
      const text = count + " of " + all;
      if (this.nodeVisits.textContent !== text) this.nodeVisits.textContent = text;
    }

    // ---- frames

    // A frame is drawn only when something has changed.
    ask() {
      if (!this.asked && !this.closed) this.asked = requestAnimationFrame(now => this.frame(now));
    }

    frame(now) {
      this.asked = 0;
      if (this.playing) this.advance(now);
      const begun = performance.now();
      const complete = this.draw();
      this.tell();
      this.frameMs = performance.now() - begun;
      this.frames++;
      if (this.playing || !complete) this.ask();
    }

    resize() {
      const width = this.stageBox.clientWidth, height = this.stageBox.clientHeight, ratio = window.devicePixelRatio || 1;
      if (width === 0 || height === 0) return;
      if (!this.stage || this.stage.width !== width || this.stage.height !== height || this.stage.ratio !== ratio) {
        this.stage = { width, height, ratio };
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        this.trail.forget();
        if (!this.moved) this.at = fitted(this.run.box, width, height);
        // A canvas of another size is empty.
        this.draw();
      }
      this.drawMarks();
      this.drawCharts();
      this.ask();
    }

    // Draws everything; whether nothing is left for the next frame.
    draw() {
      const { stage, run, step } = this;
      if (!stage) return true;
      if (this.shows("follow") && this.layers.some(layer => layer.key === "follow" && layer.on)) this.keepInSight();
      const { at } = this, colours = this.colours(), context = this.canvas.getContext("2d");
      this.drawKept(context, colours);
      let complete = true;
      if (this.shows("trajectory")) {
        complete = this.trail.update(stage, at, step, this.trailStyle(colours));
        this.trail.draw(context, stage, at);
      }
      drawDoors(context, stage, at, run, step, colours);
      this.drawMaps(context, colours);
      run.tracks.forEach((track, number) => {
        if (this.shows("track:" + number)) this.drawTrack(context, track, number, colours);
      });
      return complete;
    }

    drawTrack(context, track, number, colours) {
      const { stage, at, run, step } = this;
      if (this.shows("beams")) drawBeams(context, stage, at, run, track, step, colours);
      const nodeById = id => track.maps.map(map => map.byId.get(id)).find(node => node);
      for (const belief of track.beliefs) {
        if (this.shows("belief:" + belief.name)) drawBelief(context, stage, at, belief, step, colours, nodeById);
      }
      const fill = run.tracks.length > 1 ? colours.tracks[number % colours.tracks.length] : colours.body;
      drawRobot(context, stage, at, track, step, fill, colours);
    }

    // Walls and zones change only with the view, fields only now and then.
    drawKept(context, colours) {
      const { stage, at, run, step } = this, theme = this.root.dataset.theme;
      this.sceneryKept.show(context, stage, at, theme, own => drawScenery(own, stage, at, run, colours));
      const shown = this.shownFields();
      if (shown.length === 0) return;
      const state = [theme, ...shown.map(field => field.field.name + lastAt(field.field.steps, step))].join();
      this.fieldsKept.show(context, stage, at, state, own => {
        for (const field of shown) drawField(own, stage, at, field, step, colours);
      });
    }

    shownFields() {
      return this.run.tracks.flatMap((track, number) => this.shows("track:" + number) ? this.fields[number].filter(field => this.shows("field:" + field.field.name)) : []);
    }

    drawMaps(context, colours) {
      const { stage, at, step } = this, shown = [];
      this.eachShownMap((map, number) => shown.push([map, number]));
      if (shown.length === 0) return;
      const several = this.run.tracks.length > 1;
      const state = [this.root.dataset.theme, ...shown.map(([map, number]) => number + map.name + lastAt(map.changed, step))].join();
      this.mapsKept.show(context, stage, at, state, own => {
        for (const [map, number] of shown) drawMap(own, stage, at, map, step, colours, several ? colours.tracks[number % colours.tracks.length] : colours.edge);
      });
      drawSelected(context, stage, at, this.selected, step, colours);
    }

    // One robot's way tells time by its colour; several are told apart by it.
    trailStyle(colours) {
      const several = this.run.tracks.length > 1;
      return {
        shown: number => this.shows("track:" + number),
        colour: (number, share) => several ? colours.tracks[number % colours.tracks.length] : colours.trail(share),
      };
    }

    // Moves the view only when the first robot leaves its middle, so that what is drawn once holds for a while.
    keepInSight() {
      const { x, y } = poseAt(this.run.tracks[0], this.step);
      const [left, top] = screenOf(this.stage, this.at, x, y);
      const off = Math.max(Math.abs(left / this.stage.width - 0.5), Math.abs(top / this.stage.height - 0.5));
      if (off > 0.3) this.at = { ...this.at, x, y };
      this.moved = true;
    }

    // Brings all words up to the step.
    tell() {
      const { root, run, step } = this;
      root.dataset.step = step;
      root.dataset.playing = this.playing;
      this.playButton.textContent = this.playing ? "❚❚" : "▶";
      this.slider.value = step;
      this.slider.style.setProperty("--share", this.run.last ? step / this.run.last : 0);
      this.clock.textContent = seconds(step * this.run.stepLength);
      for (const row of this.rows) {
        row.cells.forEach((cell, number) => {
          const text = String(row.values(this.run.tracks[number]));
          if (row.texts[number] !== text) cell.textContent = row.texts[number] = text;
        });
      }
      for (const { cursor } of this.chartList) cursor.style.left = 100 * step / Math.max(1, this.run.last) + "%";
      const chapter = run.chapters[lastAt(run.chapters.map(chapter => chapter.from), step)];
      this.caption.hidden = !chapter;
      this.caption.textContent = chapter ? chapter.caption : "";
      this.tellVisits();
    }

    // ---- the time line

    // The middle of the slider's thumb runs from half its width to half its width before the end.
    stripOf(step, width) {
      return 8 + (width - 16) * step / Math.max(1, this.run.last);
    }

    stepAtStrip(x, width) {
      return (x - 8) / Math.max(1, width - 16) * this.run.last;
    }

    drawMarks() {
      const ratio = window.devicePixelRatio || 1, canvas = this.markStrip;
      const width = canvas.clientWidth, height = canvas.clientHeight;
      canvas.width = Math.max(1, width * ratio);
      canvas.height = Math.max(1, height * ratio);
      const context = canvas.getContext("2d");
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      // What is rarer lies above.
      const lists = [...this.run.marks].sort((a, b) => b.steps.length - a.steps.length);
      for (const { kind, steps } of lists) {
        context.fillStyle = MARK_COLOURS[kind];
        const wide = kind === "difference" ? 4 : 2;
        for (const step of steps) context.fillRect(this.stripOf(step, width) - wide / 2, 0, wide, height);
      }
    }

    drawCharts() {
      const colours = this.colours(), ratio = window.devicePixelRatio || 1;
      for (const { canvas, lines } of this.chartList) {
        const width = canvas.clientWidth, height = canvas.clientHeight;
        canvas.width = Math.max(1, width * ratio);
        canvas.height = Math.max(1, height * ratio);
        const context = canvas.getContext("2d");
        const all = lines.flatMap(line => Array.from(line.series.values));
        const extreme = pick => all.reduce((a, b) => pick(a, b));
        const low = Math.min(0, extreme(Math.min)), high = extreme(Math.max);
        const x = step => step / Math.max(1, this.run.last) * width;
        const y = value => height - 3 - (height - 6) * (value - low) / (high - low || 1);
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.lineWidth = 2;
        for (const { series, number, last } of lines) {
          context.strokeStyle = this.run.tracks.length > 1 ? colours.tracks[number % colours.tracks.length] : colours.series;
          context.beginPath();
          series.steps.forEach((step, i) => {
            if (i > 0) context.lineTo(x(step), y(series.values[i - 1]));
            context.lineTo(x(step), y(series.values[i]));
          });
          context.lineTo(x(last), y(series.values[series.values.length - 1]));
          context.stroke();
        }
      }
    }

    // ---- the end

    close() {
      this.closed = true;
      cancelAnimationFrame(this.asked);
      clearTimeout(this.writing);
      for (const undo of this.undo) undo();
      this.root.remove();
      if (window.tolmanReplay === this) window.tolmanReplay = null;
    }
  }

  // Shows a replay in `element` in place of what is there. The player that comes back has step, playing, speed,
  // frames and frameMs (how long the last frame took to draw) and seek(), play(), pause(), fit() and close(); the
  // one opened last is window.tolmanReplay. With { growing: true } it waits at the end for extend(data), a longer
  // replay of the same run, until growing is set to false, and leaves the address alone. With { autoplay: true } it
  // begins to play, unless the address names a step or motion is not wanted.
  function open(element, data, options) {
    if (window.tolmanReplay) window.tolmanReplay.close();
    window.tolmanReplay = new Player(element, data, options);
    return window.tolmanReplay;
  }

  return { open };
})();
