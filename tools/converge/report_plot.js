// First half of the report's script: elements, numbers, and the plot of error against run time.
// Strings of the report become text or attributes, never markup.
'use strict';

const METRICS = {
  // The guide line is Monte Carlo's: an error falls as n^(-1/2), its square as n^(-1).
  rmse: {name: 'RMSE', guide: -1 / 2, guideName: 'slope −1/2'},
  relMse: {name: 'relMSE', guide: -1, guideName: 'slope −1 (a squared error)'},
  mae: {name: 'MAE', guide: -1 / 2, guideName: 'slope −1/2'},
  flip: {name: 'FLIP'},
};
const AXES = {
  seconds: 'render seconds',
  cpuSeconds: 'CPU seconds',
  samples: 'samples per pixel',
  rays: 'rays',
};

// Elements

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value != null) node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}
const html = (tag, attributes = {}, ...children) =>
    fill(document.createElement(tag), attributes, children);
const svg = (tag, attributes = {}, ...children) =>
    fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
const options = (names) =>
    Object.entries(names).map(([value, name]) => html('option', {value}, name));

// Numbers: three significant digits, a dash for what is missing

const known = (value) => value !== null && value !== undefined;
const minus = (text) => text.replace('-', '−');
const count = (value) => known(value) ? value.toLocaleString('en') : '–';
const powerOfTen = (exponent) =>
    '10' + [...String(exponent)].map((c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]).join('');
function scientific(value, digits) {
  const [mantissa, exponent] = value.toExponential(digits).split('e');
  return minus(`${mantissa}×${powerOfTen(Number(exponent))}`);
}
function number(value, digits = 3, least = 1e-3) {
  if (!known(value)) return '–';
  const size = Math.abs(value);
  if (size !== 0 && (size < least || size >= 1e6)) return scientific(value, digits - 1);
  return minus(size < 10 ** (digits - 1) ? value.toPrecision(digits) : count(Math.round(value)));
}
const plusMinus = (error) => known(error) ? `±${number(error, 2, 1e-6)}` : '';
const measured = (value, error) => `${number(value)} ${plusMinus(error)}`.trimEnd();

// Plots

// About eight units across, drawn about the point. Their number, that of the dashes and that of
// the colours have no common divisor: no two of 280 curves look the same.
const MARKS = [
  'M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z',
  'M-3.5-3.5h7v7h-7z',
  'M0-5 4.6 3.4h-9.2z',
  'M0-5 5 0 0 5-5 0z',
  'M0 5 4.6-3.4h-9.2z',
  'M-4-4 4 4M4-4-4 4',
  'M0-5V5M-5 0H5',
];
const DASHES = [null, '8 3', '2 3', '9 3 2 3', '14 4'];
const color = (index) => `color: var(--c${index % 8})`;
const curve = (index, d) =>
    svg('path', {class: 'curve', d, 'stroke-dasharray': DASHES[index % DASHES.length]});
const mark = (index, x, y) =>
    svg('path', {class: 'mark', d: MARKS[index % MARKS.length], transform: `translate(${x} ${y})`});

// The decimal logarithms of the least and the greatest value, with a margin, a decade apart at
// least, so that one power of ten is always in it.
function logRange(values) {
  const logs = values.map(Math.log10);
  const low = Math.min(...logs), high = Math.max(...logs);
  const margin = Math.max(0.05 * (high - low), (1 - (high - low)) / 2);
  return [low - margin, high + margin];
}

// {log, text} at 1 to 9 times each power of ten; text only where there is room to label it.
function ticks([low, high]) {
  const labelled = high - low < 2 ? [1, 2, 5] : [1];
  const result = [];
  for (let decade = Math.floor(low); decade <= high; ++decade) {
    for (let digit = 1; digit < 10; ++digit) {
      const log = decade + Math.log10(digit);
      if (log < low || log > high) continue;
      const plain = decade >= -3 && decade < 5;
      const text = plain ? count(Number((digit * 10 ** decade).toPrecision(1))) :
                           (digit > 1 ? `${digit}×` : '') + powerOfTen(decade);
      result.push({log, major: digit === 1, text: labelled.includes(digit) ? text : ''});
    }
  }
  return result;
}

// The variants of one scene as curves; draw() reads the chosen metric and axis.
class Plot {
  constructor(variants, references) {
    this.variants = variants;
    this.references = references;
    this.hidden = new Set();
    this.legend = html('ul', {class: 'legend'});
    this.tip = html('div', {class: 'tip', role: 'status'});
    this.picture = svg('svg', {tabindex: 0, role: 'group'});
    this.node = html('div', {class: 'plot'}, this.picture, this.legend, this.tip);
    this.picture.addEventListener('pointermove', (event) => this.point(event));
    this.picture.addEventListener('pointerleave', () => this.show(-1));
    this.picture.addEventListener('blur', () => this.show(-1));
    this.picture.addEventListener('keydown', (event) => {
      const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
      if (!step || !this.points.length) return;
      event.preventDefault();
      this.show(Math.min(Math.max(this.near + step, 0), this.points.length - 1));
    });
  }

  // The snapshots that have a place on logarithmic axes.
  plotted(variant) {
    return variant.snapshots.filter((s) => s[this.axis] > 0 && s[this.metric] > 0);
  }

  draw(metric, axis) {
    Object.assign(this, {metric, axis, points: [], near: -1});
    this.tip.replaceChildren();
    this.drawLegend();
    const curves = this.variants.map((variant) => this.plotted(variant));
    const all = curves.flat();
    const whole = Math.max(this.node.clientWidth, 300);
    const width = Math.max(whole < 720 ? whole : whole - 280, 260),
          height = whole < 720 ? 340 : 440;
    const left = 62, top = 10, w = width - left - 14, h = height - top - 46;
    fill(
        this.picture, {
          viewBox: `0 0 ${width} ${height}`,
          width,
          height,
          'aria-label': `${METRICS[metric].name} against ${AXES[axis]}, logarithmic; ` +
              'left and right arrow keys walk the points',
        },
        []);
    if (!all.length)
      return this.picture.replaceChildren(svg('text', {x: left, y: 30}, 'no values'));

    // The reference's own error may lie far below all curves; then it is left to the legend.
    const errors = all.flatMap((s) => [s[metric], s[metric] + (s[`${metric}Error`] ?? 0)]);
    const own = metric === 'rmse' ? this.references.map((r) => r.rmse).filter((e) => e > 0) : [];
    const least = Math.min(...errors);
    const xs = logRange(all.map((s) => s[axis]));
    const ys = logRange([...errors, ...own.filter((error) => error > least / 10)]);
    const x = (value) => (Math.log10(value) - xs[0]) / (xs[1] - xs[0]) * w;
    const y = (value) => (ys[1] - Math.log10(value)) / (ys[1] - ys[0]) * h;
    const inner = svg('svg', {x: left, y: top, width: w, height: h});  // clips what it holds
    this.picture.replaceChildren(
        ...this.drawAxes(xs, ys, left, top, w, h), inner,
        svg('text', {class: 'name', x: left + w / 2, y: height - 6, 'text-anchor': 'middle'},
            AXES[axis]),
        svg('text', {
          class: 'name',
          transform: `translate(13 ${top + h / 2}) rotate(-90)`,
          'text-anchor': 'middle'
        },
            METRICS[metric].name));
    for (const error of own) inner.append(svg('path', {class: 'own', d: `M0 ${y(error)}H${w}`}));

    // The guide passes a little below the first curve in sight, to be compared with all of them.
    const first = curves.find((snapshots, i) => snapshots.length && !this.hidden.has(i));
    const {guide} = METRICS[metric];
    if (first && guide) {
      const at = (log) => y(0.6 * first[0][metric] * (10 ** log / first[0][axis]) ** guide);
      inner.append(svg('path', {class: 'guide', d: `M0 ${at(xs[0])}L${w} ${at(xs[1])}`}));
    }
    curves.forEach((snapshots, i) => {
      if (this.hidden.has(i)) return;
      const group = svg('g', {style: color(i), 'data-variant': i});
      const line = snapshots.map((s) => `${x(s[axis])} ${y(s[metric])}`).join('L');
      if (line) group.append(curve(i, `M${line}`));
      for (const s of snapshots) {
        const px = x(s[axis]), py = y(s[metric]);
        // A bar that reaches below zero has no lower end on a logarithmic axis: it leaves the plot.
        const ends =
            (value, error, place,
             none) => [value > error ? place(value - error) : none, place(value + error)];
        const [y0, y1] = ends(s[metric], s[`${metric}Error`] ?? 0, y, h);
        const [x0, x1] = ends(s[axis], s[`${axis}Error`] ?? 0, x, 0);
        const symbol = mark(i, px, py);
        group.append(
            svg('path', {class: 'bar', d: `M${px} ${y0}V${y1}M${x0} ${py}H${x1}`}), symbol);
        this.points.push({variant: this.variants[i], s, symbol, x: left + px, y: top + py});
      }
      inner.append(group);
    });
  }

  // The slope was fitted to RMSE: said where the plot shows something else.
  slopeText({slope}) {
    if (!slope) return 'slope –';
    const same = this.metric === 'rmse' && this.axis === slope.against;
    const what = same ? '' : ` (RMSE against ${slope.against})`;
    return `slope ${measured(slope.value, slope.error)}${what}`;
  }

  drawAxes(xs, ys, left, top, w, h) {
    const nodes = [];
    const grid = (d, major, log) =>
        svg('path', {class: major ? 'grid major' : 'grid', d, 'data-log': log});
    for (const {log, major, text} of ticks(xs)) {
      const px = left + (log - xs[0]) / (xs[1] - xs[0]) * w;
      nodes.push(
          grid(`M${px} ${top}v${h}`, major, log),
          svg('text', {x: px, y: top + h + 17, 'text-anchor': 'middle'}, text));
    }
    for (const {log, major, text} of ticks(ys)) {
      const py = top + (ys[1] - log) / (ys[1] - ys[0]) * h;
      nodes.push(
          grid(`M${left} ${py}h${w}`, major, log),
          svg('text', {x: left - 7, y: py + 4, 'text-anchor': 'end'}, text));
    }
    return [...nodes, svg('rect', {class: 'frame', x: left, y: top, width: w, height: h})];
  }

  drawLegend() {
    const sample = (...nodes) => svg('svg', {viewBox: '0 -9 36 18', 'aria-hidden': true}, ...nodes);
    const key = (kind, text) => html(
        'li', {class: 'key'}, sample(svg('path', {class: kind, d: 'M0 0H36'})),
        html('span', {class: 'quiet'}, text));
    const entries = this.variants.map((variant, i) => {
      const swatch = sample(curve(i, 'M0 0H36'), mark(i, 18, 0));
      swatch.setAttribute('style', color(i));
      const button = html(
          'button', {type: 'button', 'aria-pressed': !this.hidden.has(i)}, swatch,
          html('span', {}, variant.label, html('small', {}, this.slopeText(variant))));
      button.addEventListener('click', () => {
        if (!this.hidden.delete(i)) this.hidden.add(i);
        this.draw(this.metric, this.axis);
        this.legend.querySelectorAll('button')[i].focus();
      });
      return html('li', {}, button);
    });
    const {guide, guideName} = METRICS[this.metric];
    if (guide) entries.push(key('guide', guideName));
    if (this.metric === 'rmse') {
      for (const {rmse} of this.references) {
        if (rmse > 0) entries.push(key('own', `error of the reference itself, ${number(rmse)}`));
      }
    }
    this.legend.replaceChildren(...entries);
  }

  point(event) {
    const box = this.picture.getBoundingClientRect();
    const scale = this.picture.viewBox.baseVal.width / box.width;
    const px = (event.clientX - box.left) * scale, py = (event.clientY - box.top) * scale;
    const distances = this.points.map((p) => Math.hypot(p.x - px, p.y - py));
    const least = Math.min(...distances);
    this.show(least < 30 ? distances.indexOf(least) : -1);
  }

  // Shows the numbers of a point; none with -1.
  show(index) {
    if (index === this.near) return;
    this.points[this.near]?.symbol.classList.remove('near');
    this.near = index;
    const p = this.points[index];
    if (!p) return this.tip.replaceChildren();
    p.symbol.classList.add('near');
    const {metric, axis} = this;
    const lines = [
      `\n${METRICS[metric].name} ${measured(p.s[metric], p.s[`${metric}Error`])}`,
      `\n${count(p.s.samples)} samples per pixel`,
      `\n${measured(p.s.seconds, p.s.secondsError)} render seconds`,
    ];
    if (axis === 'cpuSeconds') lines.push(`\n${number(p.s.cpuSeconds)} CPU seconds`);
    if (axis === 'rays') lines.push(`\n${number(p.s.rays)} rays`);
    this.tip.replaceChildren(html('strong', {}, p.variant.label), ...lines);
    const right = p.x + 14 + this.tip.offsetWidth < this.node.clientWidth;
    this.tip.style.left = `${Math.max(0, right ? p.x + 14 : p.x - 14 - this.tip.offsetWidth)}px`;
    this.tip.style.top = `${p.y + 10}px`;
  }
}
