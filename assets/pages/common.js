const $ = id => document.getElementById(id);
const NS = 'http://www.w3.org/2000/svg';
function svg(name, attributes, parent, text) {
  const e = document.createElementNS(NS, name);
  for (const k in attributes) e.setAttribute(k, attributes[k]);
  if (text !== undefined) e.textContent = text;
  if (parent) parent.append(e);
  return e;
}
function html(name, properties, parent) {
  const e = Object.assign(document.createElement(name), properties);
  if (parent) parent.append(e);
  return e;
}
function cells(parent, values) {
  const tr = html('tr', {}, parent);
  for (const [text, name] of values) html('td', {textContent: text, className: name || ''}, tr);
  return tr;
}
const digits = (x, n) => x >= 100 ? x.toFixed(0) : x.toPrecision(n);
const ms = x => digits(x, 3) + ' ms';
const number = x => +x.toPrecision(6) + '';
const focusText = d => d <= 0 ? 'infinity' : 1 / d < 1 ? (100 / d).toFixed(0) + ' cm' : (1 / d).toFixed(1 / d < 100 ? 2 : 0) + ' m';
function niceTicks(low, high, log, most) {
  const ticks = [];
  if (log) {
    for (const steps of [[1, 2, 5], [1, 3], [1]]) {
      ticks.length = 0;
      for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
        for (const s of steps) { const t = s * 10 ** e; if (t >= low * .999 && t <= high * 1.001) ticks.push(t); }
      if (ticks.length <= most) break;
    }
    return ticks;
  }
  let step = 10 ** Math.floor(Math.log10((high - low) / most));
  for (const s of [1, 2, 5, 10]) if ((high - low) / (step * s) <= most) { step *= s; break; }
  for (let t = Math.ceil(low / step) * step; t <= high + 1e-9; t += step) ticks.push(t);
  return ticks;
}
/* The tip, filled, beside a place of the window. */
function placeTip(x, y) {
  const tip = $('tip');
  tip.hidden = false;
  const b = tip.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(x + 14, innerWidth - b.width - 8)) + 'px';
  tip.style.top = (y + 14 + b.height > innerHeight ? Math.max(4, y - b.height - 14) : y + 14) + 'px';
}
function hideTip() { $('tip').hidden = true; }
function machineText(data) {
  return `${data.renderer}, ${data.version}; ${data.cpu}, ${data.cores} cores, ${(data.memory_bytes / 2 ** 30).toFixed(0)} GiB; ${data.system}; Dioptre ${data.program}, commit ${data.commit}; ${data.date}.`;
}
function warnOfLoad(data) {
  if (data.load <= data.cores * .5) return;
  $('load').hidden = false;
  $('load').textContent = `The machine was busy when this began (load ${data.load.toFixed(1)} on ${data.cores} cores): times are too long, and spread.`;
}
