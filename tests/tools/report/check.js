// Checks a report of pbrt-converge in a browser: append this script to a copy of its index.html and
// load it. The document's title becomes PASS or FAIL, and its element "check" lists what failed.
// What is expected comes from the constant `report`, by other ways than the report's own.
'use strict';

const failures = [];
addEventListener('error', (event) => failures.push(`script error: ${event.message}`));
function expect(condition, what) {
  if (!condition) failures.push(what);
}
const all = (selector, within = document) => [...within.querySelectorAll(selector)];
const tell = (node, kind, init = {}) =>
    node.dispatchEvent(new Event(kind, {bubbles: true, cancelable: true, ...init}));
const point = (node, kind, x, y) =>
    node.dispatchEvent(new PointerEvent(kind, {bubbles: true, clientX: x, clientY: y}));
const key = (node, kind, name) =>
    node.dispatchEvent(new KeyboardEvent(kind, {bubbles: true, cancelable: true, key: name}));
function choose(select, value) {
  select.value = value;
  tell(select, 'change');
}
const variantsOf = (scene) =>
    report.variants.filter((v) => v.scene === scene.querySelector('h2').textContent);

// The pixels on the page of logarithms along one axis, from the lines of its grid.
function gridMap(plot, horizontal) {
  const lines = all('.grid', plot).flatMap((line) => {
    const box = line.getBoundingClientRect();
    if ((box.width < box.height) !== horizontal) return [];
    const pixel = horizontal ? box.left + box.width / 2 : box.top + box.height / 2;
    return [{log: Number(line.dataset.log), pixel}];
  });
  const a = lines[0], b = lines.at(-1), scale = (b.pixel - a.pixel) / (b.log - a.log);
  expect(lines.some((line) => Number.isInteger(line.log)), 'an axis without a power of ten');
  expect(horizontal ? scale > 0 : scale < 0, 'an axis grows the wrong way');
  return {scale, at: (log) => a.pixel + (log - a.log) * scale};
}

function checkCurves(scene, metric, axis) {
  const name = `${metric} against ${axis}`, plot = scene.querySelector('.plot');
  if (!variantsOf(scene).some((v) => v.snapshots.some((s) => s[axis] > 0 && s[metric] > 0))) {
    return expect(!plot.querySelector('[data-variant] .mark'), `${name}: points of nothing`);
  }
  const x = gridMap(plot, true), y = gridMap(plot, false);
  variantsOf(scene).forEach((variant, i) => {
    const shown = variant.snapshots.filter((s) => s[axis] > 0 && s[metric] > 0);
    const marks = all(`[data-variant="${i}"] .mark`, plot);
    expect(marks.length === shown.length, `${name}: ${variant.label}: number of points`);
    marks.forEach((mark, k) => {
      const {e, f} = mark.getScreenCTM();
      const off =
          Math.hypot(e - x.at(Math.log10(shown[k][axis])), f - y.at(Math.log10(shown[k][metric])));
      expect(off < 0.5, `${name}: ${variant.label}: point ${k} is ${off} pixels off`);
      const bar = mark.previousElementSibling.getBoundingClientRect();
      const up = y.at(Math.log10(shown[k][metric] + (shown[k][`${metric}Error`] ?? 0)));
      expect(Math.abs(bar.top - up) < 2, `${name}: ${variant.label}: bar ${k} ends off`);
    });
  });
  const guide = plot.querySelector('.guide:not(.legend *)');
  if (guide) {
    const box = guide.getBBox(), slope = -(box.height / y.scale) / -(box.width / x.scale);
    const law = {rmse: -0.5, relMse: -1, mae: -0.5}[metric];
    expect(Math.abs(slope - law) < 1e-3, `${name}: the guide's slope is ${slope}`);
  }
  expect((metric === 'flip') === !guide, `${name}: a guide where there is none, or none`);
}

function checkPlots(scenes) {
  const axes = ['seconds', 'cpuSeconds', 'samples', 'rays'];
  for (const metric of ['relMse', 'mae', 'flip', 'rmse']) {
    for (const axis of axes.toReversed()) {
      choose(document.getElementById('metric'), metric);
      choose(document.getElementById('axis'), axis);
      for (const scene of scenes) checkCurves(scene, metric, axis);
    }
  }
  for (const scene of scenes) {
    const plot = scene.querySelector('.plot'), picture = plot.querySelector('svg');
    const tip = plot.querySelector('.tip'), variants = variantsOf(scene);
    if (!plot.querySelector('[data-variant] .mark')) continue;
    const own = report.references[variants[0].reference].rmse > 0;
    expect(own === !!plot.querySelector('.own:not(.legend *)'), 'line of the reference itself');
    expect(all('.legend button', plot).length === variants.length, 'entries of the legend');
    const button = () => plot.querySelector('.legend button');
    const curves = () => all('[data-variant]', plot).length;
    button().click();
    expect(button().getAttribute('aria-pressed') === 'false', 'a click leaves the legend pressed');
    expect(document.activeElement === button(), 'a click on the legend loses the focus');
    expect(curves() === variants.length - 1, 'a click on the legend leaves the curve');
    expect(!plot.querySelector('[data-variant="0"]'), 'a click hides the wrong curve');
    button().click();
    expect(curves() === variants.length, 'a second click does not bring the curve back');

    const {e, f} = plot.querySelector('[data-variant="0"] .mark').getScreenCTM();
    point(picture, 'pointermove', e, f);
    expect(tip.textContent.startsWith(variants[0].label), 'no numbers near a point');
    expect(all('.mark.near', plot).length === 1, 'no point stands out');
    point(picture, 'pointerleave', 0, 0);
    expect(tip.textContent === '' && !plot.querySelector('.near'), 'numbers stay');
    key(picture, 'keydown', 'ArrowRight');
    const first = tip.textContent;
    key(picture, 'keydown', 'ArrowRight');
    const lone = all('[data-variant] .mark', plot).length === 1;
    expect(first && (tip.textContent === first) === lone, 'arrow keys do not walk');
    tell(picture, 'blur');
    expect(tip.textContent === '', 'numbers stay after the focus has gone');
  }
}

function checkTable(scene) {
  const variants = variantsOf(scene), heads = all('thead th', scene);
  const column = (name) => heads.findIndex((head) => head.firstChild.textContent === name);
  const text = (row, name) => row.children[column(name)].firstChild.textContent;
  const parsed = (shown) => Number(shown.replace('−', '-').replaceAll(',', '').replace(
      /×10(.*)/,
      (_, digits) =>
          'e' + [...digits].map((c) => '-0123456789'['⁻⁰¹²³⁴⁵⁶⁷⁸⁹'.indexOf(c)]).join('')));
  const checkCell = (row, name, value) => {
    const shown = text(row, name);
    const right = value === null ? shown === '–' :
                                   Math.abs(parsed(shown) - value) <= 0.00501 * Math.abs(value);
    expect(right, `table: ${name} of ${value} shows ${shown}`);
  };
  all('tbody:not(.snapshots)', scene).forEach((body, i) => {
    const button = body.querySelector('button'), more = body.nextElementSibling;
    const {snapshots, slope, parseSeconds} = variants[i], rows = all('tr', more);
    expect(more.hidden, 'snapshots are open from the start');
    button.click();
    expect(!more.hidden && button.getAttribute('aria-expanded') === 'true', 'snapshots stay shut');
    expect(rows.length === snapshots.length + 1, 'rows of snapshots');
    expect(rows[0].textContent === variants[i].statements, 'statements of the variant');
    checkCell(body.rows[0], 'slope', slope && slope.value);
    checkCell(body.rows[0], 'parse', parseSeconds);
    [...rows.slice(1), body.rows[0]].forEach((row, k) => {
      const s = snapshots[Math.min(k, snapshots.length - 1)];
      expect(parsed(text(row, 'samples')) === s.samples, 'table: samples are rounded');
      checkCell(row, 'render', s.seconds);
      checkCell(row, 'CPU', s.cpuSeconds);
      checkCell(row, 'rays / s', s.seconds > 0 ? s.rays / s.seconds / 1e6 : null);
      checkCell(row, 'RMSE', s.rmse);
      checkCell(row, 'relMSE', s.relMse);
      checkCell(row, 'MAE', s.mae);
      checkCell(row, 'FLIP', s.flip);
      checkCell(row, 'efficiency', s.efficiency);
      const relative = row.lastChild.textContent.replace('× ', ''), shownFor = parsed(relative);
      const ratio = s.efficiency / variants[0].snapshots.at(-1).efficiency;
      expect(
          s.efficiency === null || Math.abs(shownFor / ratio - 1) < 0.006,
          `table: relative efficiency ${ratio} shows ${relative}`);
    });
    button.click();
    expect(more.hidden, 'snapshots stay open');
  });
}

function checkComparison(scene) {
  const compare = scene.querySelector('.compare');
  if (!variantsOf(scene)[0].picture) return expect(!compare, 'a comparison with nothing');
  if (!compare) return expect(false, 'no comparison');
  const [left, right, mode, zoom] = all('select', compare), stage = compare.querySelector('.stage');
  const [a, b] = all('img', stage), [slider, flip] = all('input, button', stage);
  const variants = variantsOf(scene), reference = report.references[variants[0].reference];
  expect(a.src === variants[0].picture && b.src === reference.picture, 'first pair compared');
  for (const value of [0, 25, 100]) {
    slider.value = value;
    tell(slider, 'input');
    const box = stage.getBoundingClientRect();
    const divider = stage.querySelector('.divider').getBoundingClientRect();
    const place = (divider.left + divider.width / 2 - box.left) / box.width;
    expect(Math.abs(place - value / 100) < 0.01, `the divider stands at ${place}`);
    expect(b.style.clipPath.includes(`${value}%`), 'the picture is cut off elsewhere');
  }
  choose(mode, 'flip');
  const shown = () => getComputedStyle(b).display === 'none' ? 'a' : 'b';
  const clock = performance.now;
  let time = 0;
  performance.now = () => time;
  const press = (down, up, milliseconds) => {
    down();
    const during = shown();
    time += milliseconds;
    up();
    return during + shown();
  };
  const pointer = [() => point(flip, 'pointerdown', 0, 0), () => point(flip, 'pointerup', 0, 0)];
  const space = [() => key(flip, 'keydown', ' '), () => key(flip, 'keyup', ' ')];
  for (const [down, up] of [pointer, space]) {
    expect(shown() === 'a', 'a flip begins with the wrong picture');
    expect(press(down, up, 50) === 'bb', 'a short press does not flip');
    expect(press(down, up, 50) === 'aa', 'a second short press does not flip back');
    expect(press(down, up, 2000) === 'ba', 'a long press does not flip for as long as it lasts');
  }
  performance.now = clock;
  choose(mode, 'slide');
  expect(shown() === 'b' && !slider.hidden && flip.hidden, 'no way back to the slider');
  const other = variants.length - 1;
  choose(left, other);
  expect(a.src === variants[other].picture, 'another picture on the left');
  choose(right, left.options.length - 1);
  expect(b.src === variants[other].errorMap, 'an error map on the right');
  choose(zoom, 4);
  expect(Math.abs(stage.clientWidth - 4 * reference.width) < 1, 'four-fold zoom');
  expect(getComputedStyle(a).imageRendering === 'pixelated', 'zoomed pixels are blurred');
}

function check() {
  const scenes = all('section.scene');
  expect(scenes.length === new Set(report.variants.map((v) => v.scene)).size, 'number of scenes');
  expect(document.getElementById('title').textContent === report.title, 'title');
  expect(document.getElementById('command').textContent === report.command, 'command');
  expect(all('#notes li').map((li) => li.textContent).join() === report.notes.join(), 'notes');
  expect(!document.querySelector('link, script[src], iframe, object'), 'a part lies elsewhere');
  for (const image of all('img')) {
    expect(image.src.startsWith('data:'), `a picture lies elsewhere: ${image.src}`);
    expect(image.complete && image.naturalWidth > 0, `a picture does not show: ${image.alt}`);
    expect(image.hasAttribute('alt'), 'a picture without a name');
  }
  checkPlots(scenes);
  for (const scene of scenes) {
    const thumbnails = variantsOf(scene).flatMap((v) => v.snapshots).length;
    expect(all('.strip img', scene).length === thumbnails, 'number of thumbnails');
    checkTable(scene);
    checkComparison(scene);
  }
  expect(document.documentElement.scrollWidth <= innerWidth, 'the page scrolls sideways');
}

addEventListener('load', () => {
  try {
    check();
  } catch (error) {
    failures.push(`the check itself: ${error.stack}`);
  }
  document.title = failures.length ? 'FAIL' : 'PASS';
  const result = document.createElement('pre');
  result.id = 'check';
  result.append([document.title, ...failures].join('\n'));
  document.body.prepend(result);
});
