"use strict";
// Algorithm 1 and its rivals on a condensed problem: overlaps s = sFree - C q, forces q = w p, a law p(s), walls at tau.
const OPEN = 0, LAW = 1, WALL = 2;

function problemOf(name, data) {
  // the confined block: one point, a spring of stiffness M/L per area; else the block of the paper's test, condensed
  if (name == "block") {
    const k = 100 * 0.7 / (1.3 * 0.4) / 20;
    return { name, n: 1, x: [0], w: [1], C: [Float64Array.of(1 / k)], gap: [2], d0: -0.25 };
  }
  const { x, w, c } = data[name], n = x.length;
  const C = x.map(() => new Float64Array(n));
  for (let i = 0, at = 0; i < n; i++) for (let j = 0; j <= i; j++, at++) C[i][j] = C[j][i] = c[at];
  return { name, n, x, w, C, gap: x.map(v => 2.5 - 0.5 - (10 - Math.sqrt(100 - v * v))), d0: -0.25 };
}

const power = (kappa, m) => ({
  p: s => s > 0 ? kappa * s ** m : 0,
  slope: s => s > 0 ? kappa * m * s ** (m - 1) : 0,
  inverse: p => p > 0 ? (p / kappa) ** (1 / m) : 0,
});

function graphPoint(law, k, tau, s, p) {
  // the law's point, with its wall, on the line p + k s = const
  const c = p + k * s;
  if (c <= 0) return { s: c / k, p: 0, state: OPEN };
  if (c >= law.p(tau) + k * tau) return { s: tau, p: c - k * tau, state: WALL };
  let low = 0, high = Math.min(tau, c / k, law.inverse(c)), at = high;
  for (let it = 0; it < 100; it++) {
    const f = law.p(at) + k * at - c;
    if (f > 0) high = at; else low = at;
    let next = at - f / (law.slope(at) + k);
    if (!(next > low && next < high)) next = low > 0 ? Math.sqrt(low * high) : high / 2;
    if (Math.abs(next - at) <= 1e-16 * at || next == at) break;
    at = next;
  }
  return { s: at, p: c - k * at, state: LAW };
}

function solveSystem(C, A, diagonal, right) {
  // (C_AA + diagonal) q = right by Cholesky's factors; null where it is not positive definite
  const n = A.length, L = [];
  for (let i = 0; i < n; i++) {
    const row = L[i] = new Float64Array(i + 1), own = C[A[i]];
    for (let j = 0; j <= i; j++) {
      let sum = own[A[j]] + (i == j ? diagonal[i] : 0);
      const other = L[j];
      for (let k = 0; k < j; k++) sum -= row[k] * other[k];
      if (i == j) { if (!(sum > 0)) return null; row[i] = Math.sqrt(sum); }
      else row[j] = sum / other[j];
    }
  }
  const y = Float64Array.from(right);
  for (let i = 0; i < n; i++) { for (let k = 0; k < i; k++) y[i] -= L[i][k] * y[k]; y[i] /= L[i][i]; }
  for (let i = n - 1; i >= 0; i--) { for (let k = i + 1; k < n; k++) y[i] -= L[k][i] * y[k]; y[i] /= L[i][i]; }
  return y;
}

function solve(problem, settings, method) {
  // every step: {model, s, p, tau, state, residual}; what stood at the start first. method: "paper", "newton", "proximal"
  const { n, w, C, gap, d0 } = problem, { kappa, m, T0, tol } = settings, eps = 1e-4;
  const law = power(kappa, m), sFree = gap.map(g => g - d0);
  const k = C.map((row, i) => 1 / (row[i] * w[i]));
  const tau = new Float64Array(n).fill(method == "paper" ? Math.max(T0 - d0, 0) : Infinity);
  let s = Float64Array.from(sFree), p = new Float64Array(n), state = new Uint8Array(n);
  const steps = [], force = () => p.reduce((sum, v, i) => sum + v * w[i], 0);
  const keep = (model, residual) => steps.push({ model, residual, s: s.slice(), p: p.slice(), tau: tau.slice(), state: state.slice(), force: force() });
  function linear(A, diagonal, right) {
    const q = solveSystem(C, A, diagonal, right);
    if (!q) return false;
    p.fill(0);
    A.forEach((i, at) => p[i] = q[at] / w[i]);
    for (let i = 0; i < n; i++) {
      let sum = 0;
      const row = C[i];
      for (let at = 0; at < A.length; at++) sum += row[A[at]] * q[at];
      s[i] = sFree[i] - sum;
    }
    return true;
  }
  function residualNow() {
    let off = 0, all = 0;
    for (let i = 0; i < n; i++) {
      const at = graphPoint(law, k[i], tau[i], s[i], p[i]);
      off += (w[i] * (p[i] - at.p)) ** 2;
      all += (w[i] * p[i]) ** 2;
    }
    return off == 0 ? 0 : Math.sqrt(off / Math.max(all, 1e-300));
  }
  const done = (models, converged) => ({ steps, models, newton: steps.length - 1, converged, force: force() });
  const most = 200;
  for (let model = 1; ; model++) {
    for (let i = 0; i < n; i++) state[i] = s[i] > tau[i] ? WALL : s[i] > 0 ? LAW : OPEN;
    if (model == 1) keep(1, NaN);
    for (let residual = 1, changes = 1; residual > tol || changes > 0;) {
      if (steps.length > most) return done(model, false);
      const A = [], diagonal = [], right = [];
      for (let i = 0; i < n; i++) {
        let at = s[i], value = law.p(at), slope = law.slope(at), walled = state[i] == WALL;
        if (method == "proximal") {
          const point = graphPoint(law, k[i], tau[i], s[i], p[i]);
          [at, value, slope] = [point.s, point.p, point.state == OPEN ? 0 : law.slope(point.s)];
        }
        if (walled) { A.push(i); diagonal.push(0); right.push(sFree[i] - tau[i]); }
        else if (slope > 0) { A.push(i); diagonal.push(1 / (slope * w[i])); right.push(sFree[i] - at + value / slope); }
      }
      if (!linear(A, diagonal, right)) return done(model, false);
      changes = 0;
      for (let i = 0; i < n; i++) {
        const share = state[i] == WALL ? p[i] - law.p(tau[i]) : 0;
        const now = share + 100 * (s[i] - tau[i]) > 0 ? WALL : s[i] > 0 ? LAW : OPEN;
        changes += (now == WALL) != (state[i] == WALL);
        state[i] = now;
      }
      residual = residualNow();
      keep(model, residual);
    }
    let error = 0;
    for (let i = 0; i < n; i++) if (state[i] == WALL) {
      const next = Math.max(tau[i], law.inverse(p[i]));
      error = Math.max(error, (next - tau[i]) / next);
      tau[i] = next;
    }
    if (error < eps) return done(model, true);
  }
}

// ------------------------------------------------------------------ the page

const METHODS = { paper: "the paper's scheme", newton: "plain Newton", proximal: "proximal Newton" };
const INK = { paper: "#0072b2", newton: "#a83f00", proximal: "#00664a" };
const $ = id => document.getElementById(id);
const SLIDERS = ["kappa", "m", "T0", "tol"], SEEN = ["problem", ...SLIDERS, "step"];
let problem, settings, runs, step = 0;

const short = v => v == 0 ? "0" : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-3 ? v.toExponential(1).replace(".0e", "e").replace("e+", "e") : String(+v.toPrecision(4));
const signed = v => short(v).replace("-", "−");

const PROBLEMS = {};
const named = name => PROBLEMS[name] ??= problemOf(name, DATA);
const chosen = values => ({ kappa: 10 ** values.kappa, m: values.m, T0: values.T0, tol: 10 ** values.tol });

function read() {
  problem = named($("problem").value);
  settings = chosen(Object.fromEntries(SLIDERS.map(id => [id, +$(id).value])));
  for (const id of SLIDERS) for (const at of [id, id + "Here"]) if ($(at)) {
    const words = id == "T0" && settings.T0 == -0.25 ? "−0.25 = d0" : signed(settings[id]);
    $(at).value = $(id).value;
    $(at + "Said").textContent = words;
    $(at).setAttribute("aria-valuetext", words);
  }
  runs = Object.fromEntries(Object.keys(METHODS).map(method => [method, solve(problem, settings, method)]));
  const last = Math.max(...Object.values(runs).map(run => run.newton));
  $("step").max = last;
  step = Math.min(step, last);
}

// ------------------------------------------------------------------ the state in the address

function address() { return "#" + SEEN.map(id => `${id}=${id == "step" ? step : $(id).value}`).join("&"); }

function write() {
  $("link").href = address();
  history.replaceState(null, "", address());
}

function restore(hash) {
  // sets the sliders by an address; a part that is missing or no value of its slider leaves it as it is
  const given = new Map(hash.replace(/^#/, "").split("&").map(part => part.split("=")));
  if (!SEEN.some(id => given.has(id))) return false;
  const name = given.get("problem");
  if ([...$("problem").options].some(option => option.value == name)) $("problem").value = name;
  for (const id of SLIDERS) if (given.get(id) && Number.isFinite(+given.get(id))) $(id).value = given.get(id);
  read();
  if (Number.isFinite(+given.get("step"))) step = Math.round(Math.max(0, Math.min(+$("step").max, +given.get("step"))));
  return true;
}

function axes(box, xs, ys, xWords, yWords) {
  // an SVG's frame with ticks: {svg, X, Y}
  const [W, H, left, bottom] = [box.w, box.h, 46, 34], [x0, x1] = xs, [y0, y1] = ys;
  const X = v => left + (v - x0) / (x1 - x0) * (W - left - 8), Y = v => H - bottom - (v - y0) / (y1 - y0) * (H - bottom - 8);
  let svg = `<path class="axis" d="M${left} 8V${H - bottom}H${W - 8}"/>`;
  for (const v of ticks(x0, x1)) svg += `<text x="${X(v)}" y="${H - bottom + 14}" text-anchor="middle">${signed(v)}</text>`;
  for (const v of ticks(y0, y1)) svg += `<text x="${left - 5}" y="${Y(v) + 4}" text-anchor="end">${signed(v)}</text>`;
  svg += `<text x="${(left + W) / 2}" y="${H - 4}" text-anchor="middle">${xWords}</text>`;
  svg += `<text transform="translate(11 ${(H - bottom) / 2}) rotate(-90)" text-anchor="middle">${yWords}</text>`;
  return { svg, X, Y };
}

function ticks(low, high) {
  const raw = (high - low) / 4, size = 10 ** Math.floor(Math.log10(raw)), unit = [1, 2, 5, 10].find(f => f * size >= raw) * size;
  const found = [];
  for (let v = Math.ceil(low / unit) * unit; v <= high + 1e-9 * unit; v += unit) found.push(Math.abs(v) < 1e-9 * unit ? 0 : v);
  return found;
}

const line = (xs, ys, { X, Y }, look) =>
  `<polyline fill="none" ${look} points="${[...xs].map((v, i) => `${X(v).toFixed(1)},${Y(ys[i]).toFixed(1)}`).join(" ")}"/>`;

function drawThreshold() {
  // the law in d, the threshold and its wall, the point with the greatest pressure; the words to it
  const law = power(settings.kappa, settings.m), { T0 } = settings, d0 = problem.d0, end = runs.proximal.steps.at(-1);
  const most = end.p.indexOf(Math.max(...end.p)), p = end.p[most], d = end.s[most] + d0, atT = law.p(T0 - d0), top = 2 * p;
  const right = Math.max(T0, d, 0) + 0.15, { svg, X, Y } = axes({ w: 420, h: 240 }, [d0 - 0.1, right], [0, top], "overlap d", "pressure p");
  const s = Array.from({ length: 120 }, (_, i) => law.inverse(top * (i / 119) ** 2)), cut = T0 - d0;
  const curve = (values, look) => line(values.map(v => v + d0), values.map(law.p), { X, Y }, look);
  const below = s.filter(v => v < cut), beyond = s.filter(v => v >= cut);
  if (atT < top) { below.push(cut); beyond.unshift(cut); }
  let out = svg + line([d0 - 0.1, d0], [0, 0], { X, Y }, 'stroke="#57606a" stroke-width="3"') + curve(below, 'stroke="#57606a" stroke-width="3"');
  out += curve(beyond, 'stroke="#57606a" stroke-width="2" stroke-dasharray="2 4"');
  out += line([T0, T0], [0, top], { X, Y }, 'stroke="#1b1f24" stroke-dasharray="6 4"');
  if (atT < top) out += line([T0, T0], [atT, top], { X, Y }, `stroke="${INK.paper}" stroke-width="5"`);
  out += `<text x="${X(T0) + 7}" y="18">T⁰</text><circle cx="${X(d)}" cy="${Y(p)}" r="5" fill="#fff" stroke="#1b1f24" stroke-width="2"/>`;
  const first = runs.paper.steps.findLast(each => each.model == 1), at = first.p.indexOf(Math.max(...first.p));
  const share = first.state[at] == WALL ? 1 - law.p(first.tau[at]) / first.p[at] : 0;
  const words = share > 0 ? `In the first model the wall carries ${short(Math.round(1000 * share) / 10)} % of the greatest pressure.`
    : `The solution stays below the wall: its greatest overlap is ${signed(Math.round(1000 * d) / 1000)}.`;
  return [out, words];
}

function drawLaw(method, now, run = runs[method], set = settings) {
  // the law's curve, the points where the step left them, the walls
  const law = power(set.kappa, set.m), end = run.steps.at(-1);
  const top = 1.6 * Math.max(...end.p, 1e-9), least = 1.4 * law.inverse(top);
  const right = least * 2 ** Math.max(0, Math.ceil(Math.log2(Math.max(...now.s) / least)));
  const at = axes({ w: 300, h: 190 }, [-0.25 * right, right], [-0.08 * top, top], "s = d − d0", "pressure");
  let svg = at.svg;
  const curve = Array.from({ length: 80 }, (_, i) => law.inverse(top * (i / 79) ** 2));
  svg += line([-0.25 * right, 0, ...curve], [0, 0, ...curve.map(law.p)], at, 'stroke="#57606a" stroke-width="1.5"');
  for (const tau of new Set(now.tau)) if (tau <= right && law.p(tau) < top)
    svg += line([tau, tau], [law.p(tau), top], at, `stroke="${INK[method]}" stroke-opacity="0.5"`);
  let beyond = 0;
  now.s.forEach((s, i) => {
    if (s < -0.25 * right) return;
    const out = s > right || now.p[i] > top || now.p[i] < -0.08 * top;
    if (out) beyond++;
    const x = at.X(Math.min(s, right)), y = at.Y(Math.max(Math.min(now.p[i], top), -0.08 * top));
    svg += now.state[i] == WALL ? `<rect x="${x - 3}" y="${y - 3}" width="6" height="6" fill="${INK[method]}"/>`
      : `<circle cx="${x}" cy="${y}" r="3" fill="${out ? "#fff" : INK[method]}" stroke="${INK[method]}"/>`;
  });
  if (beyond) svg += `<text x="292" y="20" text-anchor="end">${beyond} beyond the picture</text>`;
  return svg;
}

function drawLine(method, now) {
  // overlap and threshold along x
  const d0 = problem.d0, end = runs[method].steps.at(-1), high = Math.max(...end.s) + d0;
  const top = Math.max(0.25, high + 0.15, settings.T0 + 0.05, Math.max(...now.s) + d0 + 0.05), bottom = -0.5;
  const x = problem.n == 1 ? [-1, 1] : problem.x, both = v => problem.n == 1 ? [v[0], v[0]] : [...v];
  const reach = problem.n == 1 ? 1 : 6;
  const at = axes({ w: 300, h: 170 }, [-reach, reach], [bottom, top], "x", "overlap d");
  const clip = v => Math.max(bottom, Math.min(top, v));
  let svg = at.svg + line([-reach, reach], [d0, d0], at, 'stroke="#c9d1d9"');
  const inside = both(x).map((v, i) => i).filter(i => Math.abs(x[i]) <= reach);
  const show = (v, look) => line(inside.map(i => x[i]), inside.map(i => clip(both(v)[i] + d0)), at, look);
  if (now.tau[0] < Infinity) svg += show(now.tau, 'stroke="#57606a" stroke-dasharray="5 3" stroke-width="1.5"');
  svg += show(now.s, `stroke="${INK[method]}" stroke-width="2"`);
  if (problem.n > 1) now.s.forEach((s, i) => {
    if (now.state[i] == WALL && Math.abs(x[i]) <= reach)
      svg += `<rect x="${at.X(x[i]) - 2.5}" y="${at.Y(clip(s + d0)) - 2.5}" width="5" height="5" fill="${INK[method]}"/>`;
  });
  return svg;
}

function drawResiduals() {
  const last = Math.max(2, +$("step").max), low = Math.log10(settings.tol) - 3;
  const at = axes({ w: 640, h: 200 }, [0, last], [low, 1], "Newton step", "log₁₀ residual");
  const { X, Y } = at;
  let svg = at.svg + line([0, last], Array(2).fill(Math.log10(settings.tol)), at, 'stroke="#57606a" stroke-dasharray="2 3"');
  svg += line([step, step], [low, 1], at, 'stroke="#e69f00" stroke-width="2"');
  for (const [method, run] of Object.entries(runs)) {
    const ys = run.steps.slice(1, step + 1).map(each => Math.min(1, Math.max(low, Math.log10(Math.max(each.residual, 1e-300)))));
    svg += line(ys.map((_, i) => i + 1), ys, at, `stroke="${INK[method]}" stroke-width="2"`);
    ys.forEach((y, i) => {
      const fresh = i == 0 || run.steps[i + 1].model != run.steps[i].model;
      svg += fresh && method == "paper" ? `<rect x="${X(i + 1) - 4}" y="${Y(y) - 4}" width="8" height="8" fill="${INK[method]}"/>`
        : `<circle cx="${X(i + 1)}" cy="${Y(y)}" r="3" fill="${INK[method]}"/>`;
    });
  }
  return svg;
}

function draw() {
  $("step").value = step;
  $("stepSaid").textContent = `${step} of ${$("step").max}`;
  const said = [];
  for (const method of Object.keys(METHODS)) {
    const run = runs[method], now = run.steps[Math.min(step, run.newton)], over = step >= run.newton;
    $(method + "Law").innerHTML = drawLaw(method, now);
    $(method + "Line").innerHTML = drawLine(method, now);
    const models = method == "paper" ? `${run.models} model${run.models > 1 ? "s" : ""}, ` : "";
    const end = over ? ending(method, run, problem) : "";
    const place = method == "paper" ? `model ${now.model}, ` : "";
    $(method + "Said").textContent = `${place}step ${Math.min(step, run.newton)}: residual ${now.residual >= 0 ? short(now.residual) : "–"}`;
    $(method + "End").textContent = end || "not at its end yet";
    if (over) said.push(`${METHODS[method]}: ${end}`);
  }
  const [svg, words] = drawThreshold();
  $("lawPicture").innerHTML = svg;
  $("lawSaid").textContent = words;
  $("residuals").innerHTML = drawResiduals();
  $("said").textContent = said.length ? said.join("; ") + "." : "";
  write();
}

function ending(method, run, of) {
  const models = method == "paper" ? `${run.models} model${run.models > 1 ? "s" : ""}, ` : "";
  const force = of.n == 1 ? short(20 * run.force) : run.force.toFixed(4);
  return run.converged ? `${models}${run.newton} steps, force ${force}` : `not converged in ${run.newton} steps`;
}

// ------------------------------------------------------------------ predict, then look

const STIFF = { problem: "disc41", kappa: 12, m: 3, T0: -0.25, tol: -6 }, SOFT = { ...STIFF, kappa: 3, T0: 0 };
const runOf = (state, method) => solve(named(state.problem), chosen(state), method);
const state = (words, at) => `<button type="button" data-state='${JSON.stringify(at)}'>${words}</button>`;

function pictures(method, at, run, places) {
  // embedded states: the law and the points after some steps, each with a button that takes the sliders there
  return `<div class="strip">${places.map(place => {
    const now = run.steps[place], words = `${method == "paper" ? `model ${now.model}, ` : ""}step ${place}`;
    return `<figure><svg viewBox="0 0 300 190" role="img" aria-label="${METHODS[method]}, ${words}: points and law">${drawLaw(method, now, run, chosen(at))}</svg>`
      + `<figcaption>${words}: greatest overlap ${signed(Math.max(...now.s) - 0.25)} ${state("go there", { ...at, step: place })}</figcaption></figure>`;
  }).join("")}</div>`;
}

function table(caption, head, rows) {
  const cells = (row, tag) => row.slice(1).map(cell => `<${tag} class="number"${tag == "th" ? ' scope="col"' : ""}>${cell}</${tag}>`).join("");
  return `<div class="scroll" role="region" tabindex="0" aria-label="${caption}"><table><caption>${caption}</caption><thead><tr><th scope="col">${head[0]}</th>${cells(head, "th")}</tr></thead>`
    + `<tbody>${rows.map(row => `<tr><th scope="row">${row[0]}</th>${cells(row, "td")}</tr>`).join("")}</tbody></table></div>`;
}

const near = (given, found) => Math.abs(given - found) <= 0.15 * found;
const QUESTIONS = {
  // each: [is the prediction right, the result in a sentence, what is shown]
  newton: given => {
    const run = runOf(STIFF, "newton"), all = run.newton, end = Math.max(...run.steps[all].s);
    const slow = run.steps.filter(each => Math.max(...each.s) > 2 * end).length;
    return [near(given, all), `Plain Newton takes ${all} steps.`,
      `<p>After ${slow - 1} of them the layer still overlaps by more than twice its overlap at the end. Far from the solution each step shrinks <i>d</i> − <i>d</i>0 by the factor 1 − 1/<i>m</i> = ${short(2 / 3)}, whatever <i>κ</i> is.</p>`
      + pictures("newton", STIFF, run, [1, Math.round(all / 2), all])];
  },
  wall: given => {
    const run = runOf(STIFF, "paper"), newton = runOf(STIFF, "newton").newton, ends = [];
    run.steps.forEach((each, place) => ends[each.model - 1] = place);
    return [near(given, run.newton), `The paper's scheme takes ${run.newton} steps in ${run.models} models, plain Newton ${newton}.`,
      `<p>The end of each model. A point at the wall is a square. In the next model its wall stands where the law carries its pressure.</p>` + pictures("paper", STIFF, run, ends)];
  },
  place: given => {
    const at = [-0.25, 0, 0.05, 0.4].map(T0 => [T0, runOf({ ...SOFT, T0 }, "paper")]), newton = runOf(SOFT, "newton").newton;
    const best = at.reduce((a, b) => b[1].newton < a[1].newton ? b : a)[0];
    return [given == best, `T⁰ = ${signed(best)} takes the fewest steps.`,
      table("The paper's scheme on the disc, κ = 1000", ["first threshold T⁰", "models", "steps"], [...at.map(([T0, run]) => [signed(T0), run.models, run.newton]), ["plain Newton", "–", newton]])
      + `<p>The best wall stands just beyond the greatest overlap of the solution. It cuts the overshoot off, and never has to move. ${state("Go there", { ...SOFT, T0: best, step: 0 })}</p>`];
  },
  stiff: given => {
    const rows = [3, 6, 9, 12].map(kappa => ["newton", "paper", "proximal"].map(method => runOf({ ...STIFF, kappa }, method).newton));
    const [first, last] = [rows[0][2], rows[3][2]], fact = last >= 2 * first ? "grow" : Math.abs(last - first) <= 3 ? "stay" : 2 * last <= first ? "fall" : "";
    return [given == fact, `Proximal Newton takes ${first} steps for κ = 1e3 and ${last} for κ = 1e12.`,
      table("Steps on the disc, T⁰ = d0", ["stiffness κ", "plain Newton", "paper's scheme", "proximal Newton"], rows.map((row, place) => [`1e${3 * place + 3}`, ...row]))
      + `<p>Plain Newton pays for each factor in <i>κ</i>, since each makes the overshoot greater. ${state("Go to κ = 1e12", { ...STIFF, step: 0 })}</p>`];
  },
};

function answered(form) {
  // a prediction first, whatever it is; then the result beside it
  const name = form.dataset.question, told = form.querySelector("[role=status]"), text = new FormData(form).get("answer") ?? "";
  const number = form.querySelector("input[type=text]");
  if (number ? !(+text.replace(",", ".") > 0) : !text) {
    told.className = "fail";
    told.textContent = number ? "Your prediction first: a number above 0." : "Your prediction first: choose one.";
    return;
  }
  const [well, words, shown] = QUESTIONS[name](number ? +text.replace(",", ".") : text);
  told.className = well ? "pass" : "fail";
  told.textContent = `${words} ${well ? "As you predicted." : number ? `You predicted ${text}.` : "You predicted something else."}`;
  $(name + "Result").innerHTML = shown;
  $(name + "Result").hidden = false;
}

function goTo(at) {
  for (const [id, value] of Object.entries(at)) if (id != "step") $(id).value = value;
  read();
  step = Math.min(at.step, +$("step").max);
  draw();
  $("allSteps").scrollIntoView();
  $("on").focus({ preventScroll: true });
}

function change() { read(); draw(); }
function go(to) { step = Math.max(0, Math.min(+$("step").max, to)); draw(); }

const TASKS = {
  factor: () => [Math.abs(+$("factor").value.replace(",", ".") - 0.75) < 0.006,
    "Yes: far above the solution s⁺ = s − s/m.", "No. Set the block, m = 4, κ = 1e12, and compare s of two steps of plain Newton."],
  gain: () => [problem.n > 1 && settings.kappa >= 0.99e12 && runs.paper.converged && 2 * runs.paper.newton <= runs.newton.newton,
    "Yes: the wall has to be met to help.", "Not yet: on the disc, with κ = 1e12, the paper's scheme is to take at most half of plain Newton's steps. Move T⁰."],
  one: () => [problem.n > 1 && Math.abs(settings.kappa / 1000 - 1) < 0.01 && Math.abs(settings.m - 3) < 0.01 && runs.paper.models == 1
    && runs.paper.newton < runs.newton.newton,
    "Yes: the wall cuts the overshoot off, and the solution stays below it.", "Not yet: disc, κ = 1000, m = 3: one model, and fewer steps than plain Newton. Where may the wall stand?"],
};

function begin() {
  for (const id of ["problem", ...SLIDERS]) $(id).addEventListener("input", change);
  for (const id of SLIDERS) if ($(id + "Here")) $(id + "Here").addEventListener("input", event => { $(id).value = event.target.value; change(); });
  $("step").addEventListener("input", () => go(+$("step").value));
  for (const [id, to] of [["first", () => 0], ["back", () => step - 1], ["on", () => step + 1], ["last", () => +$("step").max]])
    $(id).addEventListener("click", () => go(to()));
  for (const form of document.querySelectorAll("form.predict")) form.addEventListener("submit", event => { event.preventDefault(); answered(form); });
  document.addEventListener("click", event => { if (event.target.dataset?.state) goTo(JSON.parse(event.target.dataset.state)); });
  addEventListener("hashchange", () => { if (restore(location.hash)) draw(); });
  for (const [name, check] of Object.entries(TASKS)) $(name + "Check").addEventListener("click", () => {
    const [well, yes, no] = check();
    $(name + "Told").textContent = well ? yes : no;
    $(name + "Told").className = well ? "pass" : "fail";
  });
  if (!restore(location.hash)) read();
  draw();
  performance.mark("drawn");
}
begin();
